#include <wend/io/header_words.h>

#include <charconv>
#include <cmath>

namespace wend {
namespace {

constexpr std::string_view spaces = " \t\n\v\f\r";

}  // namespace

std::string_view HeaderWords::next(bool comments) {
    for (;;) {
        text_.remove_prefix(std::min(text_.find_first_not_of(spaces), text_.size()));
        if (!comments || !text_.starts_with('#')) {
            break;
        }
        text_.remove_prefix(std::min(text_.find('\n'), text_.size()));
    }
    const std::size_t end = std::min(text_.find_first_of(spaces), text_.size());
    if (end == 0) {
        throw InputError(place_, "the picture is truncated");
    }
    const std::string_view word = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    return word;
}

double HeaderWords::number(bool comments, double most) {
    const std::string_view word = next(comments);
    double value = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || stop != word.data() + word.size() || !(std::abs(value) <= most)) {
        throw InputError(place_, "the picture is damaged: its header holds no number where it should");
    }
    return value;
}

}  // namespace wend
