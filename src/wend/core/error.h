// Errors that a user can cause. Nothing in the path loop throws these; scene loading and the command line do.
#pragma once

#include <wend/core/export.h>

#include <stdexcept>
#include <string>

namespace wend {

/// A position in a file that a user wrote. Line and column count from 1; 0 means the whole file, or the whole line.
struct Place {
    std::string file;  ///< as the user named it
    int line = 0;      ///< from 1
    int column = 0;    ///< from 1
};

/// `file:line:column`, or as much of it as is known.
WEND_API std::string to_string(const Place& place);

/// Bad input: the message says what is wrong, where, and what would be right. The program ends with exit status 2.
class WEND_API InputError : public std::runtime_error {
public:
    /// Of no known place.
    explicit InputError(const std::string& message) : std::runtime_error(message) {}
    /// The place comes before the message.
    InputError(const Place& place, const std::string& message)
        : std::runtime_error(to_string(place) + ": error: " + message), place_(place) {}

    /// Where it is, as far as is known.
    const Place& place() const { return place_; }

private:
    Place place_;
};

}  // namespace wend
