// Tables of measured reflections, made up.
#pragma once

#include <wend/scene/bsdf/measured.h>

namespace wend::test {

/// An even reflectance: facets are as frequent in all places of the unit square, and what they reflect makes up for
/// that. Values are exact at the entries of tables of size x size.
MeasuredData even_reflectance(const Rgb& reflectance, bool is_isotropic, std::size_t size = 48);

/// Of no meaning, but uneven everywhere, and less than even reflectance.
MeasuredData uneven_reflectance(bool is_isotropic);

}  // namespace wend::test
