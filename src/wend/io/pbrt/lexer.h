// The words of a pbrt scene file.
#pragma once

#include <wend/io/pbrt/location.h>

#include <string>
#include <string_view>

namespace wend::pbrt {

/// A piece of the text: `text` points into it, without the quotes for a string.
struct Token {
    enum class Kind { word, string, open, close, end };

    Kind kind = Kind::end;
    std::string_view text;
    int line = 1;
    int column = 1;

    bool is_word(std::string_view word) const { return kind == Kind::word && text == word; }
};

/// How a message names a token: quoted, shortened, and printable whatever the file holds.
std::string describe(const Token& token);

/// Splits a text into tokens, and turns tokens into values. Every error is an InputError with the place of the token.
class Lexer {
public:
    /// The text must outlive the lexer and its tokens, and be shorter than 2 GiB.
    Lexer(std::string_view text, std::shared_ptr<const SourceFile> file);

    /// The token that next() will return.
    const Token& peek() const { return ahead_; }
    /// Returns a token of kind `end` again and again at the end of the text.
    Token next();

    const std::shared_ptr<const SourceFile>& file() const { return file_; }
    Location location(const Token& token) const { return {file_, token.line, token.column}; }

    /// A finite number, with the overflow and the spelling checked; numbers too small for the type become zero.
    double number(const Token& token) const;
    float float_number(const Token& token) const;
    int integer(const Token& token) const;
    /// The content of a quoted string, with its escapes (\b \f \n \r \t \\ \' \") replaced.
    std::string string(const Token& token) const;

private:
    Token scan();
    void skip_blanks_and_comments();
    Token scan_string(Token token);

    [[noreturn]] void fail_expected(std::string_view what, const Token& token) const;
    [[noreturn]] void fail_too_large(std::string_view type, const Token& token) const;

    std::shared_ptr<const SourceFile> file_;
    const char* position_;
    const char* end_;
    const char* line_start_;
    int line_ = 1;
    Token ahead_;
};

}  // namespace wend::pbrt
