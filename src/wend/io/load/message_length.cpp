#include <wend/io/load/message_length.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace wend {
namespace {

/// Bytes of the beginning and the end. The longest list of known names is in the latter.
constexpr std::size_t kept_before = 500, kept_after = 1000;

/// Within a character of UTF-8, behind its first byte.
bool continues_character(char c) {
    return (static_cast<unsigned char>(c) & 0xc0U) == 0x80;
}

/// Moves a cut to the beginning of a character.
std::size_t cut_at(const std::string& text, std::size_t position) {
    while (position > 0 && position < text.size() && continues_character(text[position])) {
        --position;
    }
    return position;
}

bool is_control(char c) {
    return (static_cast<unsigned char>(c) < ' ' && c != '\n' && c != '\t') || c == '\x7f';
}

}  // namespace

std::string readable_message(std::string text) {
    if (text.size() > kept_before + kept_after) {
        const std::size_t from = cut_at(text, kept_before), to = cut_at(text, text.size() - kept_after);
        text = fmt::format("{}[... {} characters ...]{}", text.substr(0, from), to - from, text.substr(to));
    }
    std::replace_if(text.begin(), text.end(), is_control, '?');
    return text;
}

}  // namespace wend
