// What a rough coat sends back to what is below it.
#pragma once

#include <wend/scene/bsdf/bsdf.h>

namespace wend {

/// coat_return() of a coat whose facets may be rough: what they reflect below the horizon is lost, as it is to walks.
float rough_coat_return(const DielectricBsdf& coat, float thickness);

}  // namespace wend
