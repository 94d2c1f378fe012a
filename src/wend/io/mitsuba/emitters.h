// Lights of Mitsuba scenes.
#pragma once

#include <wend/io/mitsuba/textures.h>

namespace wend::mitsuba {

/// Adds a light of the scene's own. Throws InputError for one that there is not; one that Wend lacks is left out, with
/// a warning.
void add_emitter(Context& context, const Element& emitter);

/// Adds the light that a shape's next directive shines by. Throws InputError for one that there is not.
void add_area_emitter(Context& context, const Element& emitter);

}  // namespace wend::mitsuba
