// What all subcommands share.
#pragma once

#include <wend/io/json_text.h>

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <exception>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}

namespace wend {

/// Where a subcommand writes: results, and everything else.
struct Streams {
    std::ostream& out;
    std::ostream& err;
};

/// Options of every subcommand.
struct CommonOptions {
    std::string json;  ///< file for the results as JSON; "-" for standard output; empty: none
    std::optional<std::uint64_t> seed;
    int threads = 0;
    bool quiet = false;

    void add_to(CLI::App& command);
    /// Where progress and notes go: nowhere if quiet.
    void note(const Streams& streams, const std::string& text) const;
    /// Writes the results to where --json says.
    void write_json(const Streams& streams, const nlohmann::json& results) const;
};

/// What is wrong with a number of seconds after --time; empty: nothing. CLI::Range would let NaN pass.
std::string seconds_problem(const std::string& text);

/// "320x180" and the like. Throws InputError.
std::pair<int, int> parse_resolution(const std::string& text);

/// Throws InputError if two of the outputs are the same file, or one is an input. Empty names, "-" and devices are
/// none.
void require_distinct(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

/// What to say of a failure, as standard error has it.
std::string failure_text(const std::exception& failure);

/// Splits at commas.
std::vector<std::string> split_list(const std::string& text);

/// What a subcommand does once its arguments are known.
using Action = std::function<void(const Streams&)>;

}  // namespace wend
