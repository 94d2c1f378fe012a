// How a Mitsuba scene is seen: its sensor with film and sampler, and its integrator.
#pragma once

#include <wend/io/mitsuba/object.h>

#include <optional>
#include <string>

namespace wend::mitsuba {

class Media;

/// Adds the camera, film, filter and sampler. `picture`: the name of the picture where nobody gives one. Throws
/// InputError for a sensor, film or filter that there is not, or that Wend lacks: there is nothing to take its place.
void add_sensor(Context& context, Media& media, const Element& sensor, const std::string& picture);

/// Adds the integrator; null: the default. Returns whether it is one of surfaces alone, such as `path`.
bool add_integrator(Context& context, const Element* integrator);

}  // namespace wend::mitsuba
