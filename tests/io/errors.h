// What the tests of readers say of errors.
#pragma once

#include <wend/core/error.h>

#include <string>

namespace wend::test {

/// The message of the InputError that `act` ends in.
template <typename Act>
std::string message_of(Act act) {
    try {
        act();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace wend::test
