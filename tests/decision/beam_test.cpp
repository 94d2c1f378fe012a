#include <wend/core/random.h>
#include <wend/decision/flight_pieces.h>
#include <wend/sampling/warp.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

bool is_inside(const Beam& beam, const Vec3& p) {
    const Vec3 w = p - beam.position;
    return dot(w, beam.axis) > beam.cosine * length(w);
}

TEST(Beam, ARayIsInTheConeWhereItIsSaidToBe) {
    Pcg32 random(1);
    int crossed = 0;
    for (int i = 0; i < 20000; ++i) {
        const Beam beam{to_sphere(random.uniform2()) * 2, to_sphere(random.uniform2()),
                        0.05f + 0.94f * random.uniform(), 1};
        const Ray ray{to_sphere(random.uniform2()) * (4 * random.uniform()), to_sphere(random.uniform2())};
        const float end = 6 * random.uniform();
        const auto part = crossing(beam, ray, end);
        crossed += part ? 1 : 0;
        for (int k = 0; k < 20; ++k) {
            const float t = end * random.uniform();
            const bool claimed = part && t >= part->t_in && t <= part->t_out;
            // Rounding decides on the rim.
            const float margin = 1e-3f * (1 + end);
            const bool on_rim = part && (std::abs(t - part->t_in) < margin || std::abs(t - part->t_out) < margin);
            const Vec3 w = ray.at(t) - beam.position;
            const bool on_cone = std::abs(dot(w, beam.axis) - beam.cosine * length(w)) < 1e-4f * (1 + length(w));
            if (!on_rim && !on_cone) {
                EXPECT_EQ(claimed, is_inside(beam, ray.at(t))) << i << ' ' << t;
            }
        }
    }
    EXPECT_GT(crossed, 2000);
}

TEST(Beam, RaysAlongTheAxisAndWithoutEnd) {
    const Beam beam{{0, 0, 0}, {0, 0, 1}, 0.9f, 1};
    const auto from_behind = crossing(beam, {{0, 0, -1}, {0, 0, 1}}, 1e30f);
    ASSERT_TRUE(from_behind);
    EXPECT_NEAR(from_behind->t_in, 1, 1e-5f);
    EXPECT_EQ(from_behind->t_out, 1e30f);
    EXPECT_FALSE(crossing(beam, {{0, 0, -1}, {0, 0, -1}}, 1e30f));
    EXPECT_FALSE(crossing(beam, {{5, 0, 1}, {0, 1, 0}}, 1e30f));
    const auto across = crossing(beam, {{-5, 0, 2}, {1, 0, 0}}, 10);
    ASSERT_TRUE(across);
    const float rim = 2 * std::sqrt(1 - 0.81f) / 0.9f;
    EXPECT_NEAR(across->t_in, 5 - rim, 1e-5f);
    EXPECT_NEAR(across->t_out, 5 + rim, 1e-5f);
}

}  // namespace
}  // namespace wend
