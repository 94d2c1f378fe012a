#include <wend/guide/fit.h>
#include <wend/integrator/training.h>

namespace wend {

GuidingFields learn(const GuidingFields& fields, std::span<const guide::PathRecords> records, int threads) {
    guide::PathRecords all;
    for (const guide::PathRecords& part : records) {
        all.append(part);
    }
    return {guide::fit(fields.surface, all.surface(), {}, threads).field,
            guide::fit(fields.volume, all.volume(), {}, threads).field};
}

}  // namespace wend
