// Chi-square test of a sampler of directions against its density.
#pragma once

#include <wend/core/random.h>
#include <wend/stats/chi_square.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace wend::test {

struct SphereTestOptions {
    int samples = 200000;
    /// Cells in the cosine of the polar angle about z, and in azimuth.
    int cosine_cells = 20;
    int azimuth_cells = 40;
    std::uint64_t seed = 1;
};

/// Counts over the cells of the sphere, cosine-major; the last cell counts "no sample".
struct SphereTest {
    ChiSquare result;
    SphereTestOptions options;
    std::vector<std::uint64_t> observed;
    std::vector<double> expected;
};

/// A sampler of unit directions that may give none.
using DirectionSampler = std::function<std::optional<Vec3>(Pcg32&)>;
/// A density over solid angle, 1/sr. What it lacks to an integral of 1 is the probability of "no sample".
using DirectionDensity = std::function<double(const Vec3&)>;

/// Draws directions and compares their counts with adaptive integrals of the density over each cell.
SphereTest test_direction_sampler(const DirectionSampler& sample, const DirectionDensity& density,
                                  const SphereTestOptions& options = {});

/// The same for any callable that takes a generator (Pcg32&) or a uniform point (Vec2) and returns a direction or an
/// optional one.
template <class Sample>
SphereTest chi_square_sphere(const Sample& sample, const DirectionDensity& density,
                             const SphereTestOptions& options = {}) {
    if constexpr (std::is_invocable_v<const Sample&, Pcg32&>) {
        return test_direction_sampler(sample, density, options);
    } else {
        return test_direction_sampler([&](Pcg32& random) { return std::optional<Vec3>(sample(random.uniform2())); },
                                      density, options);
    }
}

/// For EXPECT_TRUE: passes when the p-value is at least the significance, 0.01 held jointly over `tests` tests of this
/// kind (Sidak). A failure leaves the counts as chi_square/NAME.csv in the build folder and says so.
testing::AssertionResult follows_density(const SphereTest& test, const std::string& name, int tests = 1);

}  // namespace wend::test
