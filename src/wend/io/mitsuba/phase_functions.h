// Phase functions of Mitsuba scenes.
#pragma once

#include <wend/io/mitsuba/directive.h>

namespace wend::mitsuba {

/// Adds to a medium's parameters what its `<phase>` says; null: isotropic. What is blended becomes a mixture of
/// Henyey and Greenstein's functions, or a table. Throws InputError for one that there is not, or that Wend lacks.
void set_phase(Context& context, const Element* phase, Parameters& medium);

}  // namespace wend::mitsuba
