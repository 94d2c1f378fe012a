// A transport code of your own with Wend as its library: light that enters a half-space of fog along the normal, and
// how much of it comes back. The walk is written here; random numbers and statistics are Wend's.
#include <wend/core/random.h>
#include <wend/stats/figure_of_merit.h>
#include <wend/stats/moments.h>
#include <wend/stats/significance.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace {

constexpr double albedo = 0.9;

/// What comes back of unit incidence, 1 - sqrt(1 - albedo) H(1), with Chandrasekhar's H function for isotropic
/// scattering.
constexpr double exact_reflectance = 0.4149474791;

/// The weight one walk brings back to the surface. Lengths are in mean free paths; absorption is carried in the weight,
/// and roulette ends walks that carry little.
double walk(wend::Pcg32& random) {
    double depth = 0, cosine = 1, weight = 1;
    while (true) {
        depth += cosine * -std::log1p(-random.uniform());
        if (depth < 0) {
            return weight;
        }
        weight *= albedo;
        if (weight < 1e-3) {
            if (random.uniform() < 0.5f) {
                return 0;
            }
            weight *= 2;
        }
        cosine = 1 - 2 * static_cast<double>(random.uniform());
    }
}

}  // namespace

int main() {
    const auto start = std::chrono::steady_clock::now();
    wend::Moments reflectance;
    for (std::uint64_t i = 0; i < 200000; ++i) {
        wend::Pcg32 random(wend::hash_of(i));
        reflectance.add(walk(random));
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    std::printf("reflectance %.5f +- %.5f, exact %.5f\n", reflectance.mean(), reflectance.standard_error(),
                exact_reflectance);
    std::printf("figure of merit %.3g per second\n", wend::figure_of_merit(reflectance, seconds).value_or(0));
    return wend::agrees(reflectance, exact_reflectance, 4) ? 0 : 1;
}
