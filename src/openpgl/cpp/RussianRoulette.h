// Probabilities with which a path goes on.
#pragma once

#include <openpgl/cpp/Common.h>

namespace openpgl {
namespace cpp {
namespace util {

/// The brightest channel of the throughput.
inline float StandardThroughputBasedRussianRoulette(const pgl_vec3f& throughput, float minSurvivalProbability = 0,
                                                    float maxSurvivalProbability = 1) {
    return std::max(minSurvivalProbability, std::min(maxSurvivalProbability, Max(throughput)));
}

/// Survival by what the path is expected to bring (vorba2016): its throughput over the lower edge of a weight window
/// around referenceEstimate / adjoint, whose upper edge is five times as high. An adjoint of 0 is not known, and the
/// path goes on.
inline float GuidedRussianRoulette(const pgl_vec3f& throughput, const pgl_vec3f& adjoint,
                                   const pgl_vec3f& referenceEstimate, float minSurvivalProbability = 0,
                                   float maxSurvivalProbability = 1) {
    constexpr float upper_over_lower = 5;
    const auto centre = [](float reference, float expected) { return expected > 0 ? reference / expected : 0.0f; };
    const pgl_vec3f window = {centre(referenceEstimate.x, adjoint.x), centre(referenceEstimate.y, adjoint.y),
                              centre(referenceEstimate.z, adjoint.z)};
    const float lower = 2 * Average(window) / (1 + upper_over_lower);
    const float survival = lower > 0 && std::isfinite(lower) ? Average(throughput) / lower : 1.0f;
    return std::min(std::max(survival, minSurvivalProbability), maxSurvivalProbability);
}

}  // namespace util
}  // namespace cpp
}  // namespace openpgl
