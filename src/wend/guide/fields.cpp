#include <wend/guide/fit.h>
#include <wend/guide/scatter_fit.h>
#include <wend/guide/shared_learning.h>

#include <utility>

namespace wend::guide {

Fields learn(const Fields& fields, std::vector<PathRecords> records, int threads) {
    return learn(fields, std::move(records), FitSettings(), threads);
}

Fields learn(const Fields& fields, std::vector<PathRecords> records, const FitSettings& settings, int threads) {
    const PathRecords all = PathRecords::joined(std::move(records));
    const auto next = [&](const Field& field, const Records& arrived, const ScatterRecords& scattered) {
        return fit_scattered(fit(field, arrived, settings, threads).field, scattered, settings.decay, threads);
    };
    return {next(fields.surface, all.surface(), all.surface_scattered()),
            next(fields.volume, all.volume(), all.volume_scattered())};
}

}  // namespace wend::guide
