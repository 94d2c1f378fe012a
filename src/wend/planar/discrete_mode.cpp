#include <wend/planar/discrete_mode.h>

#include <wend/core/contracts.h>
#include <wend/planar/eigenvalue.h>

#include <cmath>

namespace wend {

DiscreteMode discrete_mode(double albedo, std::span<const double> moments) {
    WEND_EXPECT(albedo > 0 && albedo <= 1 && !moments.empty());
    DiscreteMode mode;
    mode.albedo = albedo;
    mode.k = discrete_eigenvalue(albedo, moments).k;
    if (mode.k < 1e-9) {
        return mode;
    }
    // The moments I_l of I fall with l: they are the smallest solution of their recurrence, which is stable downwards,
    // started where it does not matter.
    constexpr std::size_t degrees = 256;
    std::vector<double> radiance(degrees + 2);
    radiance[degrees] = 1e-200;
    for (std::size_t l = degrees; l > 0; --l) {
        const auto n = static_cast<double>(l);
        const double moment = l < moments.size() ? moments[l] : 0;
        radiance[l - 1] = ((2 * n + 1) * (1 - albedo * moment) * radiance[l] / mode.k - (n + 1) * radiance[l + 1]) / n;
        if (std::abs(radiance[l - 1]) > 1e200) {
            for (double& value : radiance) {
                value *= 1e-200;
            }
        }
    }
    for (std::size_t l = 1; l < moments.size() && l <= degrees; ++l) {
        mode.source.push_back((2 * static_cast<double>(l) + 1) * moments[l] * radiance[l] / radiance[0]);
    }
    while (mode.source.size() > 1 && std::abs(mode.source.back()) < 1e-8) {
        mode.source.pop_back();
    }
    return mode;
}

}  // namespace wend
