// Parameters whose values have names.
#pragma once

#include <wend/core/error.h>
#include <wend/io/pbrt/parameters.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <string>
#include <string_view>

namespace wend {

template <class Value>
struct Named {
    std::string_view name;
    Value value;
};

/// The value of this name; `fallback` where the parameter is absent. Throws InputError at the parameter for a name that
/// is not among the choices.
template <class Value, std::size_t n>
Value named_value(const pbrt::ParameterSet& parameters, std::string_view parameter,
                  const std::array<Named<Value>, n>& choices, Value fallback) {
    if (!parameters.has(parameter)) {
        return fallback;
    }
    const std::string name = parameters.get_string(parameter, "");
    std::array<std::string_view, n> known;
    for (std::size_t i = 0; i < n; ++i) {
        if (choices[i].name == name) {
            return choices[i].value;
        }
        known[i] = choices[i].name;
    }
    throw InputError(parameters.place_of(parameter),
                     fmt::format("the {} \"{}\" is unknown; known are {}", parameter, name, fmt::join(known, ", ")));
}

}  // namespace wend
