// Colours of Mitsuba scenes, as the RGB variants have them.
#pragma once

#include <wend/core/colour.h>
#include <wend/io/mitsuba/object.h>

#include <string_view>

namespace wend::mitsuba {

/// What a spectrum is for: between 0 and 1; any number; or light, of which an even spectrum is not white.
enum class SpectrumUse { reflectance, unbounded, light };

/// Whether an element is a texture over a surface, and no spectrum.
bool is_texture(const Element& element);

/// The colour of `<float>`, `<rgb>`, `<spectrum>` or an object such as `<spectrum type="d65">`. Throws InputError for
/// what is none, or has no value between 0 and 1 where it must, or is for the spectral variants alone.
Rgb colour_of(Context& context, const Element& element, SpectrumUse use);

/// The colour that a property gives, the fallback where it is absent; a texture is refused.
Rgb colour_of(const Object& object, std::string_view name, SpectrumUse use, const Rgb& fallback);

}  // namespace wend::mitsuba
