// Refractive indices by the names that Mitsuba has for them.
#pragma once

#include <wend/core/colour.h>
#include <wend/io/mitsuba/object.h>

#include <string_view>

namespace wend::mitsuba {

/// The index that a property gives by number or name. Throws InputError for an unknown name, listing those that there
/// are, and for an index that is not above 0.
double index_of(const Object& object, std::string_view name, std::string_view fallback);

/// Complex index of a metal.
struct MetalIndex {
    Rgb eta, k;
};

/// That of a name such as "Au", in the three channels that Mitsuba's RGB variants make of its spectra; "none" reflects
/// everything. Throws InputError at the place for an unknown name, listing those that there are.
MetalIndex metal_index(std::string_view name, const pbrt::Location& place);

}  // namespace wend::mitsuba
