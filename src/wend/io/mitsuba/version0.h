// What Mitsuba 2 only renamed, so that scenes of Mitsuba 0.6 can be read.
#pragma once

#include <wend/io/mitsuba/element.h>

namespace wend::mitsuba {

/// Gives an element of version 0.x the names that it has since version 2: `toWorld` is `to_world`, `<lookAt>` is
/// `<lookat>`.
void rename_version0(Element& element);

/// What depends on an object's properties: `uscale` and the like of a texture are its `to_uv`.
void complete_version0(Element& object);

}  // namespace wend::mitsuba
