#include <wend/subsurface/technique_mixes.h>

namespace wend {

MixGradient gradient_of_connection(const InteriorGuide::PerTechnique& here, const InteriorGuide::PerTechnique& towards,
                                   float by_connections) {
    return {mix(here, towards, by_connections), by_connections - 1};
}

MixGradient gradient_of_hit(const InteriorGuide::PerTechnique& before, const InteriorGuide::PerTechnique& now,
                            float by_connections) {
    return {mix(before, now, by_connections), by_connections};
}

}  // namespace wend
