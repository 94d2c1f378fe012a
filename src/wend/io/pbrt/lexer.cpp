#include <wend/io/pbrt/lexer.h>

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

namespace wend::pbrt {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

bool ends_word(char c) {
    return is_blank(c) || c == '"' || c == '[' || c == ']' || c == '#';
}

char unescaped(char c) {
    switch (c) {
        case 'b':
            return '\b';
        case 'f':
            return '\f';
        case 'n':
            return '\n';
        case 'r':
            return '\r';
        case 't':
            return '\t';
        case '\\':
            return '\\';
        case '\'':
            return '\'';
        case '"':
            return '"';
        default:
            return '\0';
    }
}

// std::from_chars knows no plus sign.
std::string_view without_plus(std::string_view text) {
    return text.size() > 1 && text[0] == '+' && text[1] != '-' ? text.substr(1) : text;
}

}  // namespace

std::string describe(const Token& token) {
    switch (token.kind) {
        case Token::Kind::open:
            return "'['";
        case Token::Kind::close:
            return "']'";
        case Token::Kind::end:
            return "the end of the file";
        default:
            break;
    }
    constexpr std::size_t longest = 40;
    std::string text(token.text.substr(0, longest));
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) > '~') {
            c = '?';
        }
    }
    return '"' + text + (token.text.size() > longest ? "..." : "") + '"';
}

Lexer::Lexer(std::string_view text, std::shared_ptr<const SourceFile> file)
    : file_(std::move(file)), position_(text.data()), end_(text.data() + text.size()), line_start_(position_) {
    if (text.starts_with("\xfe\xff") || text.starts_with("\xff\xfe")) {
        throw InputError(Location{file_, 1, 1}, "the file is UTF-16 text; save it as UTF-8");
    }
    if (text.starts_with("\xef\xbb\xbf")) {
        position_ += 3;
        line_start_ = position_;
    }
    ahead_ = scan();
}

Token Lexer::next() {
    const Token token = ahead_;
    if (token.kind != Token::Kind::end) {
        ahead_ = scan();
    }
    return token;
}

void Lexer::skip_blanks_and_comments() {
    while (position_ != end_) {
        if (*position_ == '\n') {
            ++line_;
            line_start_ = ++position_;
        } else if (is_blank(*position_)) {
            ++position_;
        } else if (*position_ == '#') {
            while (position_ != end_ && *position_ != '\n' && *position_ != '\r') {
                ++position_;
            }
        } else {
            return;
        }
    }
}

Token Lexer::scan() {
    skip_blanks_and_comments();
    Token token{Token::Kind::end, {}, line_, static_cast<int>(position_ - line_start_) + 1};
    if (position_ == end_) {
        return token;
    }
    const char* const start = position_++;
    switch (*start) {
        case '"':
            return scan_string(token);
        case '[':
            token.kind = Token::Kind::open;
            break;
        case ']':
            token.kind = Token::Kind::close;
            break;
        default:
            token.kind = Token::Kind::word;
            while (position_ != end_ && !ends_word(*position_)) {
                ++position_;
            }
    }
    token.text = {start, static_cast<std::size_t>(position_ - start)};
    return token;
}

Token Lexer::scan_string(Token token) {
    const char* const start = position_;
    for (; position_ != end_ && *position_ != '\n'; ++position_) {
        if (*position_ == '"') {
            token.kind = Token::Kind::string;
            token.text = {start, static_cast<std::size_t>(position_ - start)};
            ++position_;
            return token;
        }
        if (*position_ == '\\' && position_ + 1 != end_ && position_[1] != '\n') {
            ++position_;
        }
    }
    throw InputError(location(token), "the string has no closing quote on its line");
}

double Lexer::number(const Token& token) const {
    const std::string_view text = without_plus(token.text);
    const char* const last = text.data() + text.size();
    double value = 0;
    const auto [stop, error] = std::from_chars(text.data(), last, value);
    if (token.kind != Token::Kind::word || error == std::errc::invalid_argument || stop != last) {
        fail_expected("a number", token);
    }
    if (error == std::errc::result_out_of_range) {
        // Too large or too small: only strtod tells which.
        value = std::strtod(std::string(text).c_str(), nullptr);
    }
    if (!std::isfinite(value)) {
        fail_too_large("double", token);
    }
    return value;
}

float Lexer::float_number(const Token& token) const {
    const double value = number(token);
    if (std::abs(value) > std::numeric_limits<float>::max()) {
        fail_too_large("float", token);
    }
    return static_cast<float>(value);
}

int Lexer::integer(const Token& token) const {
    const std::string_view text = without_plus(token.text);
    const char* const last = text.data() + text.size();
    int value = 0;
    const auto [stop, error] = std::from_chars(text.data(), last, value);
    if (token.kind != Token::Kind::word || error == std::errc::invalid_argument || stop != last) {
        fail_expected("an integer", token);
    }
    if (error == std::errc::result_out_of_range) {
        fail_too_large("32-bit integer", token);
    }
    return value;
}

std::string Lexer::string(const Token& token) const {
    if (token.kind != Token::Kind::string) {
        fail_expected("a quoted string", token);
    }
    std::string value;
    value.reserve(token.text.size());
    for (std::size_t i = 0; i < token.text.size(); ++i) {
        if (token.text[i] != '\\') {
            value += token.text[i];
            continue;
        }
        const char c = unescaped(token.text[++i]);
        if (c == '\0') {
            // The quote is at the token's column, so the backslash is at column + i.
            throw InputError(Location{file_, token.line, token.column + static_cast<int>(i)},
                             "unknown escape in a string; known: \\b \\f \\n \\r \\t \\\\ \\' \\\"");
        }
        value += c;
    }
    return value;
}

void Lexer::fail_expected(std::string_view what, const Token& token) const {
    throw InputError(location(token), fmt::format("expected {}, found {}", what, describe(token)));
}

void Lexer::fail_too_large(std::string_view type, const Token& token) const {
    throw InputError(location(token),
                     fmt::format("{} is not a finite number that a {} can hold", describe(token), type));
}

}  // namespace wend::pbrt
