#pragma once

#include <wend/core/error.h>

#include <string_view>

namespace wend {

/// Takes the words of a picture's header in text apart from its front; what follows is the pixels.
class HeaderWords {
public:
    HeaderWords(std::string_view text, Place place) : text_(text), place_(std::move(place)) {}

    /// The next word, which white space ends, of which one byte is taken with it. With `comments`, what follows a # up
    /// to the end of the line is skipped. Throws InputError at the end of the text.
    std::string_view next(bool comments);
    /// The next word as a number. Throws InputError if it is none, or further from 0 than `most`.
    double number(bool comments, double most);
    std::string_view rest() const { return text_; }

private:
    std::string_view text_;
    Place place_;
};

}  // namespace wend
