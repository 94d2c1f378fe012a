// Shorthand for tests of the one-dimensional laboratory.
#pragma once

#include <wend/lab/lab.h>
#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <string>

namespace wend::test {

/// A half-space under a white sky, entered along the normal.
inline PlanarExperiment half_space(double albedo, const std::string& sampler, int modes = 8) {
    PlanarExperiment e;
    e.albedo = {albedo};
    e.sampler = sampler;
    e.modes = modes;
    return e;
}

inline PlanarExperiment slab(double albedo, double thickness, Tally tally, const std::string& sampler) {
    PlanarExperiment e = half_space(albedo, sampler);
    e.thickness = thickness;
    e.tally = tally;
    return e;
}

inline PlanarResult run(const PlanarExperiment& e, std::uint64_t walks, std::uint64_t seed = 1, int threads = 1) {
    PlanarRun r;
    r.walks = walks;
    r.seed = seed;
    r.threads = threads;
    return run_planar(e, r);
}

/// How exact the references are, relative: H functions to rounding, solutions by 64 ordinates to about 1e-7 for smooth
/// boundaries; a rough one is tabulated.
inline double reference_error(const PlanarExperiment& e) {
    return e.roughness > 0 ? 2e-4 : 1e-6;
}

/// Within 3 standard errors of the exact value times a factor, in every channel, and no walk lost.
inline testing::AssertionResult is_exact(const PlanarResult& result, double reference_error = 1e-6, double factor = 1,
                                         double standard_errors = 3) {
    if (result.rejected > 0) {
        return testing::AssertionFailure() << result.rejected << " values were not finite";
    }
    for (std::size_t c = 0; c < result.channels.size(); ++c) {
        const Moments& m = result.channels[c];
        if (!agrees(m, factor * result.exact[c], standard_errors, reference_error)) {
            return testing::AssertionFailure()
                   << "channel " << c << ": mean " << m.mean() << ", standard error " << m.standard_error()
                   << ", expected " << factor * result.exact[c] << ": "
                   << (m.mean() - factor * result.exact[c]) / m.standard_error() << " standard errors";
        }
    }
    return testing::AssertionSuccess();
}

}  // namespace wend::test
