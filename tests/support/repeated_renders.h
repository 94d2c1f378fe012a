// Independent renders of a small scene: their mean, and how noisy they are.
#pragma once

#include <tests/support/kept_means.h>

#include <wend/render/render.h>
#include <wend/stats/moments.h>
#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace wend::test {

/// How many renders there are: as many as tell their noise, and then those that it takes to see a bias of 1 %.
struct RenderCount {
    int least = 16, most = 64;
    double error = 0.0015;  ///< of the mean, relative: enough to end
};

/// Renders with seeds from `settings.seed` on.
struct RepeatedRenders {
    Moments mean;      ///< of the luminance of whole pictures
    double noise = 0;  ///< mean of squared differences of pictures in luminance, between renders that follow each other

    RepeatedRenders(const Scene& scene, RenderSettings settings, int resolution, const RenderCount& count = {}) {
        Image last;
        int i = 0;
        for (; i < count.least || (i < count.most && mean.relative_error() > count.error); ++i, ++settings.seed) {
            Film film({resolution, resolution}, {{0, 0}, {resolution, resolution}});
            render(scene, film, settings);
            const Image image = film.beauty();
            double sum = 0;
            for (std::size_t k = 0; k < image.pixels.size(); ++k) {
                sum += luminance(image.pixels[k]);
                noise += i > 0 ? std::pow(luminance(image.pixels[k] - last.pixels[k]), 2) : 0;
            }
            mean.add(sum / static_cast<double>(image.pixels.size()));
            last = image;
        }
        noise /= i - 1;
    }
};

/// Agrees with the mean within four standard errors, which are small enough that a bias of 1 % would be seen.
inline void expect_mean(const RepeatedRenders& renders, const KnownMean& known) {
    const double error = std::hypot(known.standard_error, renders.mean.standard_error());
    EXPECT_TRUE(agrees(renders.mean.mean() - known.mean, error, 0, 4))
        << renders.mean.mean() << " and " << known.mean << " +- " << error;
    EXPECT_FALSE(agrees(1.01 * renders.mean.mean() - known.mean, error, 0, 4))
        << "a bias of 1 % must be seen: " << error / known.mean;
}

inline void expect_same_mean(const RepeatedRenders& classical, const RepeatedRenders& guided) {
    expect_mean(guided, {classical.mean.mean(), classical.mean.standard_error()});
}

/// Guided renders have the mean that is expected, seen to 1 %, and a small part of the noise of classical ones.
inline void expect_right_and_quieter(const Scene& scene, RenderSettings settings, int resolution, double expected,
                                     double largest_noise) {
    // For its noise alone.
    const RepeatedRenders classical(scene, settings, resolution, {4, 4});
    for (const char* sampling : {"direction", "full"}) {
        SCOPED_TRACE(sampling);
        settings.preset = parse_preset(sampling);
        const RepeatedRenders guided(scene, settings, resolution);
        EXPECT_TRUE(agrees(guided.mean.mean(), guided.mean.standard_error(), expected, 4))
            << guided.mean.mean() << " +- " << guided.mean.standard_error() << " expected " << expected;
        EXPECT_LT(4 * guided.mean.standard_error(), 0.01 * expected) << "too few samples to see a bias of 1 %";
        EXPECT_LT(guided.noise, largest_noise * classical.noise);
    }
}

}  // namespace wend::test
