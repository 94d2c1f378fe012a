#include <wend/io/load/sky_picture.h>
#include <wend/scene/light.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// Each pixel of a sky by longitude and latitude is the direction towards it.
Image directions(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float phi = 2 * pi * (0.5f - (static_cast<float>(x) + 0.5f) / static_cast<float>(width));
            const float theta = pi * (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
            image.at(x, y) = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
        }
    }
    return image;
}

TEST(SkyPicture, ShowsWhatIsInADirection) {
    const Image sky = equal_area_sky(directions(256, 128), SkyRows::in_strips);
    ASSERT_EQ(sky.width, sky.height);
    for (int y = 0; y < sky.height; y += 7) {
        for (int x = 0; x < sky.width; x += 7) {
            const Vec3 d =
                equal_area_square_to_sphere({(static_cast<float>(x) + 0.5f) / static_cast<float>(sky.width),
                                             (static_cast<float>(y) + 0.5f) / static_cast<float>(sky.height)});
            const Rgb& shown = sky.at(x, y);
            EXPECT_LT(length(Vec3(shown.r, shown.g, shown.b) - d), 0.03f) << d;
        }
    }
}

TEST(SkyPicture, SmallOnesAreNotBlurred) {
    Image dot(32, 16);
    dot.at(9, 5) = Rgb(1.0f);
    const Image sky = equal_area_sky(dot, SkyRows::in_strips);
    float brightest = 0;
    for (const Rgb& pixel : sky.pixels) {
        brightest = std::max(brightest, pixel.r);
    }
    EXPECT_GT(brightest, 0.85f);
}

// Between the middles of eight pixels a sky grows evenly; a view straight into it must not see steps.
TEST(SkyPicture, FewPixelsAreSmooth) {
    Image ramp(8, 4);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 8; ++x) {
            ramp.at(x, y) = Rgb(static_cast<float>(std::min(x, 7 - x)) + 0.5f);
        }
    }
    const ImageInfiniteLight light(equal_area_sky(ramp, SkyRows::in_strips), 1, Transform());
    for (int i = 0; i < 500; ++i) {
        const float phi = -2.7f + 0.005f * static_cast<float>(i);  // of u = 1/2 - phi / 2 pi
        const float u = 8 * (0.5f - phi / (2 * pi));
        const float wanted = u < 3.5f ? u : u < 4.5f ? 3.5f : 8 - u;
        EXPECT_NEAR(light.radiance({std::cos(phi), std::sin(phi), 0.1f}).r, wanted, 0.02f) << phi;
    }
}

TEST(SkyPicture, RowsMayBeginAtThePole) {
    Image rows(8, 3);
    for (int x = 0; x < 8; ++x) {
        rows.at(x, 0) = Rgb(1.0f);
        rows.at(x, 2) = Rgb(1.0f);
    }
    // Triangles of the latitude against steps that are as wide at the poles.
    const auto mean_of = [](const Image& image) {
        double sum = 0;
        for (const Rgb& pixel : image.pixels) {
            sum += static_cast<double>(pixel.r);
        }
        return sum / static_cast<double>(image.pixels.size());
    };
    // ∫ |1 - 2 theta / pi| sin(theta) dtheta / 2 over [0, pi].
    EXPECT_NEAR(mean_of(equal_area_sky(rows, SkyRows::on_nodes)), 1 - 2 / static_cast<double>(pi), 0.01);
    EXPECT_NE(mean_of(equal_area_sky(rows, SkyRows::in_strips)), mean_of(equal_area_sky(rows, SkyRows::on_nodes)));
}

}  // namespace
}  // namespace wend
