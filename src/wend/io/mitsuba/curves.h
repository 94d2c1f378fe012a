// Curves of Mitsuba scenes: hair, fur, grass.
#pragma once

#include <wend/io/mitsuba/directive.h>

#include <vector>

namespace wend::mitsuba {

/// The curves of a `bsplinecurve` or `linearcurve`, in the world: the parameters of a `curve` each, beside `common`.
///
/// Throws InputError, with the line, at a file that is no such.
std::vector<pbrt::ParameterSet> curves_of(const Object& shape, const pbrt::ParameterSet& common);

}  // namespace wend::mitsuba
