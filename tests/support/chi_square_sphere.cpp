#include <tests/support/chi_square_sphere.h>
#include <tests/support/paths.h>
#include <wend/stats/significance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>

namespace wend::test {
namespace {

constexpr double two_pi = 6.283185307179586477;

struct Rectangle {
    double cosine, azimuth, cosine_size, azimuth_size;
};

Vec3 direction(double cosine, double azimuth) {
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return Vec3(static_cast<float>(sine * std::cos(azimuth)), static_cast<float>(sine * std::sin(azimuth)),
                static_cast<float>(cosine));
}

/// The product of two 3-point Gauss–Legendre rules.
double gauss_legendre(const DirectionDensity& density, const Rectangle& r) {
    constexpr std::array<double, 3> nodes = {0.1127016653792583, 0.5, 0.8872983346207417};
    constexpr std::array<double, 3> weights = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            sum += weights[i] * weights[j] *
                   density(direction(r.cosine + nodes[i] * r.cosine_size, r.azimuth + nodes[j] * r.azimuth_size));
        }
    }
    return sum * r.cosine_size * r.azimuth_size;
}

/// Splits a rectangle until its four quarters add up to the whole. The first levels always split: a narrow lobe can
/// hide between the nodes.
double integrate(const DirectionDensity& density, const Rectangle& r, double whole, int depth = 0) {
    constexpr int always_split = 2, never_split = 9;
    constexpr double tolerance = 1e-7;
    const double h = 0.5 * r.cosine_size, w = 0.5 * r.azimuth_size;
    const std::array<Rectangle, 4> quarters = {{{r.cosine, r.azimuth, h, w},
                                                {r.cosine + h, r.azimuth, h, w},
                                                {r.cosine, r.azimuth + w, h, w},
                                                {r.cosine + h, r.azimuth + w, h, w}}};
    std::array<double, 4> parts;
    std::transform(quarters.begin(), quarters.end(), parts.begin(),
                   [&](const Rectangle& quarter) { return gauss_legendre(density, quarter); });
    const double sum = std::accumulate(parts.begin(), parts.end(), 0.0);
    if (depth == never_split || (depth >= always_split && std::abs(sum - whole) <= tolerance)) {
        return sum;
    }
    double refined = 0;
    for (int i = 0; i < 4; ++i) {
        refined += integrate(density, quarters[i], parts[i], depth + 1);
    }
    return refined;
}

Rectangle cell_rectangle(const SphereTestOptions& options, int i, int j) {
    const double cosine_size = 2.0 / options.cosine_cells, azimuth_size = two_pi / options.azimuth_cells;
    return {-1 + i * cosine_size, j * azimuth_size, cosine_size, azimuth_size};
}

std::size_t cell_of(const SphereTestOptions& options, const Vec3& v) {
    double azimuth = std::atan2(v.y, v.x);
    azimuth += azimuth < 0 ? two_pi : 0;
    const int i = static_cast<int>((v.z + 1.0) / 2 * options.cosine_cells);
    const int j = static_cast<int>(azimuth / two_pi * options.azimuth_cells);
    return static_cast<std::size_t>(std::clamp(i, 0, options.cosine_cells - 1)) * options.azimuth_cells +
           std::clamp(j, 0, options.azimuth_cells - 1);
}

std::vector<double> expected_counts(const DirectionDensity& density, const SphereTestOptions& options) {
    std::vector<double> counts;
    for (int i = 0; i < options.cosine_cells; ++i) {
        for (int j = 0; j < options.azimuth_cells; ++j) {
            const Rectangle cell = cell_rectangle(options, i, j);
            counts.push_back(options.samples * integrate(density, cell, gauss_legendre(density, cell)));
        }
    }
    const double missing = options.samples - std::accumulate(counts.begin(), counts.end(), 0.0);
    // Less than one sample is what integration and single precision leave of a complete density.
    counts.push_back(missing < 1 ? 0.0 : missing);
    return counts;
}

std::filesystem::path write_csv(const SphereTest& test, const std::string& name) {
    const std::filesystem::path folder = build_dir() / "chi_square";
    std::filesystem::create_directories(folder);
    const std::filesystem::path path = folder / (name + ".csv");
    std::ofstream file(path);
    file << "cosine,azimuth,observed,expected\n";
    for (int i = 0; i < test.options.cosine_cells; ++i) {
        for (int j = 0; j < test.options.azimuth_cells; ++j) {
            const Rectangle cell = cell_rectangle(test.options, i, j);
            const std::size_t k = static_cast<std::size_t>(i) * test.options.azimuth_cells + j;
            file << cell.cosine << ',' << cell.azimuth << ',' << test.observed[k] << ',' << test.expected[k] << '\n';
        }
    }
    file << "none,none," << test.observed.back() << ',' << test.expected.back() << '\n';
    return path;
}

}  // namespace

SphereTest test_direction_sampler(const DirectionSampler& sample, const DirectionDensity& density,
                                  const SphereTestOptions& options) {
    SphereTest test{{}, options, {}, expected_counts(density, options)};
    test.observed.resize(test.expected.size());
    Pcg32 random(options.seed);
    for (int i = 0; i < options.samples; ++i) {
        const std::optional<Vec3> v = sample(random);
        ++(v ? test.observed[cell_of(options, *v)] : test.observed.back());
    }
    test.result = chi_square_test(test.observed, test.expected);
    return test;
}

testing::AssertionResult follows_density(const SphereTest& test, const std::string& name, int tests) {
    if (test.result.p_value >= sidak(0.01, tests)) {
        return testing::AssertionSuccess();
    }
    return testing::AssertionFailure() << "p = " << test.result.p_value << " (chi-square " << test.result.statistic
                                       << ", " << test.result.degrees_of_freedom << " degrees of freedom); counts in "
                                       << write_csv(test, name);
}

}  // namespace wend::test
