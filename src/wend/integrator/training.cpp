#include <wend/guide/fit.h>
#include <wend/integrator/training.h>

namespace wend {

GuidingFields learn(const GuidingFields& fields, std::span<const guide::PathRecords> records, int threads) {
    guide::Records surface;
    guide::Records volume;
    for (const guide::PathRecords& part : records) {
        surface.insert(surface.end(), part.surface().begin(), part.surface().end());
        volume.insert(volume.end(), part.volume().begin(), part.volume().end());
    }
    return {guide::fit(fields.surface, surface, {}, threads).field,
            guide::fit(fields.volume, volume, {}, threads).field};
}

}  // namespace wend
