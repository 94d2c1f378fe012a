// Independent renders of a small scene: their mean, and how noisy they are.
#pragma once

#include <wend/integrator/render.h>
#include <wend/stats/moments.h>
#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace wend::test {

/// Eight renders with seeds from `settings.seed` on.
struct RepeatedRenders {
    Moments mean;  ///< of the luminance of whole pictures
    double noise =
        0;  ///< sum of squared differences of the luminance of pixels, between renders that follow each other

    RepeatedRenders(const Scene& scene, RenderSettings settings, int resolution) {
        Image last;
        for (int i = 0; i < 8; ++i, ++settings.seed) {
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
    }
};

/// Both means agree within four standard errors, which are small enough that a bias of 1 % would be seen.
inline void expect_same_mean(const RepeatedRenders& classical, const RepeatedRenders& guided) {
    const double error = std::hypot(classical.mean.standard_error(), guided.mean.standard_error());
    EXPECT_TRUE(agrees(guided.mean.mean() - classical.mean.mean(), error, 0, 4))
        << guided.mean.mean() << " and " << classical.mean.mean() << " +- " << error;
    EXPECT_FALSE(agrees(1.01 * guided.mean.mean() - classical.mean.mean(), error, 0, 4))
        << "a bias of 1 % must be seen: " << error / classical.mean.mean();
}

}  // namespace wend::test
