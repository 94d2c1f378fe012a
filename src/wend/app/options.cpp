#include <wend/app/options.h>

#include <wend/core/error.h>
#include <wend/core/parallel.h>
#include <wend/io/atomic_file.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>

namespace wend {

namespace {

/// What is wrong with a seed; empty: nothing. CLI11 takes what is too large for the largest number.
std::string seed_problem(const std::string& text) {
    std::uint64_t seed = 0;
    const char* const end = text.data() + text.size();
    const auto [read, error] = std::from_chars(text.data(), end, seed);
    return error == std::errc() && read == end ? "" : "'" + text + "' is not a whole number from 0 to 2^64 - 1";
}

/// What is wrong with a number of threads; empty: nothing.
std::string threads_problem(const std::string& text) {
    int threads = 0;
    if (!CLI::detail::lexical_cast(text, threads) || threads < 0 || threads > 4096) {
        return "'" + text + "' is not a number of threads from 0 (all) to 4096";
    }
    const int startable = startable_threads(threads);
    return startable < threads ? "the system starts no more than " + std::to_string(startable) + " threads" : "";
}

/// What is wrong with a name after --json; empty: nothing.
std::string json_target_problem(const std::string& name) {
    try {
        if (name != "-") {
            require_writable(name);
        }
        return {};
    } catch (const InputError& error) {
        return error.what();
    }
}

}  // namespace

void CommonOptions::add_to(CLI::App& command) {
    command.add_option("--json", json, "write the results as JSON to this file ('-': standard output)")
        ->check(json_target_problem);
    command.add_option("--seed", seed, "seed of the random numbers (default: the scene's if there is one, or 0)")
        ->check(seed_problem);
    command.add_option("--threads", threads, "number of threads (0: all); the result does not depend on it")
        ->check(threads_problem);
    command.add_flag("--quiet", quiet, "no progress and no notes");
}

void CommonOptions::note(const Streams& streams, const std::string& text) const {
    if (!quiet) {
        streams.err << text << '\n' << std::flush;
    }
}

void CommonOptions::write_json(const Streams& streams, const nlohmann::json& results) const {
    if (json.empty()) {
        return;
    }
    const std::string text = json_text(results, 2) + "\n";
    if (json == "-") {
        streams.out << text << std::flush;
    } else {
        write_atomically(json, text);
    }
}

std::string seconds_problem(const std::string& text) {
    double seconds = 0;
    const bool fits = CLI::detail::lexical_cast(text, seconds) && seconds >= 1e-3 && seconds <= 1e9;
    return fits ? "" : "'" + text + "' is not a number of seconds from 0.001 to 1e9";
}

std::pair<int, int> parse_resolution(const std::string& text) {
    int width = 0;
    int height = 0;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, width);
    if (first.ec == std::errc() && first.ptr != end && *first.ptr == 'x') {
        const auto second = std::from_chars(first.ptr + 1, end, height);
        if (second.ec == std::errc() && second.ptr == end && width > 0 && height > 0) {
            return {width, height};
        }
    }
    throw InputError("--resolution " + text + ": expected WIDTHxHEIGHT with positive numbers, such as 320x180");
}

void require_distinct(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
    const auto file_of = [](const std::string& name) {
        std::error_code error;
        return std::filesystem::weakly_canonical(behind_links(std::filesystem::absolute(name)), error);
    };
    std::set<std::filesystem::path> read, written;
    for (const std::string& name : inputs) {
        if (!name.empty()) {
            read.insert(file_of(name));
        }
    }
    for (const std::string& name : outputs) {
        if (name.empty() || name == "-" || is_device(name)) {
            continue;
        }
        const std::filesystem::path file = file_of(name);
        if (read.contains(file)) {
            throw InputError(Place{name}, "would be written over, but is read from");
        }
        if (!written.insert(file).second) {
            throw InputError(Place{name}, "would be written twice: choose another name for one of the outputs");
        }
    }
}

std::string failure_text(const std::exception& failure) {
    if (dynamic_cast<const std::bad_alloc*>(&failure)) {
        return "error: out of memory";
    }
    const bool names_a_place = dynamic_cast<const InputError*>(&failure) != nullptr;
    return (names_a_place ? "" : "error: ") + std::string(failure.what());
}

std::vector<std::string> split_list(const std::string& text) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (;;) {
        const std::size_t comma = text.find(',', begin);
        parts.push_back(text.substr(begin, comma - begin));
        if (comma == std::string::npos) {
            return parts;
        }
        begin = comma + 1;
    }
}

}  // namespace wend
