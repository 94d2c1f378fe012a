#include <wend/capi/settings.h>

#include <wend/capi/boundary.h>

#include <cmath>

namespace wend::capi {

wend_fit_settings from_settings(const guide::FitSettings& settings) {
    wend_fit_settings s;
    s.lobes = settings.lobes;
    s.leaf_samples = settings.leaf_samples;
    s.max_depth = settings.max_depth;
    s.max_bytes = settings.max_bytes;
    s.decay = settings.decay;
    s.max_iterations = settings.max_iterations;
    s.tolerance = settings.tolerance;
    s.prior_weight = settings.priors.weight;
    s.prior_mean_cosine = settings.priors.mean_cosine;
    s.max_kappa = settings.priors.max_kappa;
    return s;
}

guide::FitSettings to_settings(const wend_fit_settings& settings) {
    for (const double number : {settings.leaf_samples, settings.decay, settings.tolerance, settings.prior_weight,
                                settings.prior_mean_cosine, static_cast<double>(settings.max_kappa)}) {
        require(std::isfinite(number), "all settings must be finite");
    }
    guide::FitSettings s;
    s.lobes = settings.lobes;
    s.leaf_samples = settings.leaf_samples;
    s.max_depth = settings.max_depth;
    s.max_bytes = settings.max_bytes;
    s.decay = settings.decay;
    s.max_iterations = settings.max_iterations;
    s.tolerance = settings.tolerance;
    s.priors.weight = settings.prior_weight;
    s.priors.mean_cosine = settings.prior_mean_cosine;
    s.priors.max_kappa = settings.max_kappa;
    return s;
}

wend_fit_report from_report(const guide::FitReport& report) {
    wend_fit_report r;
    r.records = report.records;
    r.ignored = report.ignored;
    r.dark = report.dark;
    r.cells = report.cells;
    r.bytes = report.bytes;
    r.memory_limited = report.memory_limited ? 1 : 0;
    return r;
}

}  // namespace wend::capi
