#include <wend/guide/fit.h>
#include <wend/guide/join_alike.h>
#include <wend/guide/scatter_fit.h>
#include <wend/integrator/training.h>

#include <utility>

namespace wend {

GuidingFields learn(const GuidingFields& fields, std::vector<guide::PathRecords> records, int threads) {
    const guide::PathRecords all = guide::PathRecords::joined(std::move(records));
    const auto next = [&](const guide::Field& field, const guide::Records& arrived,
                          const guide::ScatterRecords& scattered) {
        const guide::FitSettings settings;
        return guide::fit_scattered(guide::fit(field, arrived, settings, threads).field, scattered, settings.decay,
                                    threads);
    };
    return {next(fields.surface, all.surface(), all.surface_scattered()),
            guide::join_alike(next(fields.volume, all.volume(), all.volume_scattered()))};
}

}  // namespace wend
