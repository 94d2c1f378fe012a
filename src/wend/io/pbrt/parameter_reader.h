#pragma once

#include <wend/io/pbrt/parameters.h>
#include <wend/io/pbrt/token_stream.h>

#include <functional>

namespace wend::pbrt {

/// Called for each parameter that takes the place of an earlier one of its name.
using OnRepeated = std::function<void(const Parameter& last, const Parameter& earlier)>;

/// Reads the parameters of the directive at `directive`: any number of `"type name" value` and `"type name" [ values
/// ]`. An Include between them goes on in the included file, as scenes do that keep the parameters of a medium in a
/// file of their own.
ParameterSet read_parameters(TokenStream& tokens, const Location& directive, ColourSpace colour_space,
                             const OnRepeated& on_repeated);

/// Reads the arguments of an Option: a parameter, or a name and a value whose spelling tells its type, as pbrt has it.
Parameter read_option(TokenStream& tokens, ColourSpace colour_space);

}  // namespace wend::pbrt
