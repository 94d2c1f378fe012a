#include <wend/app/frames.h>

#include <wend/app/interrupt.h>
#include <wend/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <ostream>
#include <stdexcept>

namespace wend {
namespace {

constexpr int most_frames = 100000;

/// Takes a number of at most nine digits off the front of the text; -1 where there is none.
int take_number(std::string_view& text) {
    const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
    int number = -1;
    if (digits >= 1 && digits <= 9) {
        std::from_chars(text.data(), text.data() + digits, number);
        text.remove_prefix(digits);
    }
    return number;
}

/// Takes one character off the front of the text if it is this one.
bool take(std::string_view& text, char c) {
    const bool is_there = text.starts_with(c);
    text.remove_prefix(is_there ? 1 : 0);
    return is_there;
}

std::string list_of(const std::vector<std::string>& names) {
    constexpr std::size_t most = 20;
    std::string text;
    for (std::size_t i = 0; i < std::min(most, names.size()); ++i) {
        text += (i == 0 ? "" : ", ") + names[i];
    }
    return text + (names.size() > most ? ", ..." : "");
}

}  // namespace

std::vector<int> parse_frames(const std::string& text) {
    std::string_view rest = text;
    const int first = take_number(rest);
    const int last = take(rest, '-') ? take_number(rest) : first;
    const int step = last >= 0 && take(rest, 'x') ? take_number(rest) : 1;
    if (first < 0 || last < 0 || step < 1 || !rest.empty()) {
        throw InputError("--frames " + text +
                         ": expected FIRST-LAST, FIRST-LASTxSTEP or one number, each of at most nine digits, such as "
                         "1-48 or 1-48x2");
    }
    if (last < first) {
        throw InputError(fmt::format("--frames {}: the last frame, {}, comes before the first, {}", text, last, first));
    }
    const int count = (last - first) / step + 1;
    if (count > most_frames) {
        throw InputError(fmt::format("--frames {}: {} frames are more than {}", text, count, most_frames));
    }
    std::vector<int> frames;
    for (int i = 0; i < count; ++i) {
        frames.push_back(first + i * step);
    }
    return frames;
}

bool has_frame_number(const std::string& name) {
    return name.find('#') != std::string::npos;
}

std::string with_frame_number(const std::string& name, int frame) {
    const std::size_t begin = name.find('#');
    if (begin == std::string::npos) {
        return name;
    }
    const std::size_t end = std::min(name.find_first_not_of('#', begin), name.size());
    if (name.find('#', end) != std::string::npos) {
        throw InputError(Place{name}, "has two groups of #: the frame's number has one place");
    }
    return name.substr(0, begin) + fmt::format("{:0{}}", frame, end - begin) + name.substr(end);
}

void for_each_in_turn(const std::string& kind, const std::vector<std::string>& names, const Streams& streams,
                      const std::function<void(std::size_t)>& render) {
    std::vector<std::string> failed;
    bool is_input = false;
    for (std::size_t i = 0; i < names.size(); ++i) {
        try {
            render(i);
        } catch (const std::exception& error) {
            streams.err << kind << ' ' << names[i] << ": " << failure_text(error) << '\n' << std::flush;
            // Who ends one ends all, even where its picture could not be written.
            if (InterruptGuard::signal() != 0) {
                throw EndedBySignal{InterruptGuard::signal()};
            }
            if (failed.empty()) {
                is_input = dynamic_cast<const InputError*>(&error) != nullptr;
            }
            failed.push_back(names[i]);
        }
    }
    if (failed.empty()) {
        return;
    }
    const std::string text = fmt::format("{} of {} {}s failed: {}", failed.size(), names.size(), kind, list_of(failed));
    if (is_input) {
        throw InputError(text);
    }
    throw std::runtime_error(text);
}

}  // namespace wend
