#include <wend/io/load/subsurface.h>

#include <algorithm>
#include <cmath>

namespace wend {

float albedo_of_reflectance(float reflectance, float g) {
    const float a = std::clamp(reflectance, 0.0f, 1.0f);
    const float s = 4.09712f + 4.20863f * a - std::sqrt(9.59217f + 41.6808f * a + 17.7126f * a * a);
    return std::clamp((1 - s * s) / (1 - g * s * s), 0.0f, 1.0f);
}

}  // namespace wend
