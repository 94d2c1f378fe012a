// Messages that name what a file holds, whatever its size.
#pragma once

#include <wend/core/error.h>

#include <string>

namespace wend {

/// A message that fits a terminal: of a long one the beginning and the end, which say what is wrong and what would be
/// right, with "[... N characters ...]" between them. Control characters become question marks.
std::string readable_message(std::string text);

/// What `load` returns. Throws its InputErrors with the same place and readable messages.
template <class Load>
auto with_readable_messages(const Load& load) {
    try {
        return load();
    } catch (const InputError& error) {
        const std::string placed = to_string(error.place()) + ": error: ", text = error.what();
        if (!text.starts_with(placed)) {
            throw InputError(readable_message(text));
        }
        throw InputError(error.place(), readable_message(text.substr(placed.size())));
    }
}

}  // namespace wend
