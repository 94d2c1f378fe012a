#include <tests/medium/smooth_medium.h>
#include <wend/medium/emission_sampler.h>
#include <wend/stats/chi_square.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace wend {
namespace {

const Transform world_from_index = test::index_from_world(40).inverse();
const Box3 box(Vec3(-1, 2, 3), Vec3(39, 30, 12.5f));
constexpr int cells[3] = {32, 28, 10};

/// Radiance that varies, dark in half of the box, at a point in the world.
float emitted(const Vec3& p) {
    const Vec3 q = test::index_from_world(40).point(p);
    return q.x < 19 ? 0.0f : 1 + std::sin(0.2f * q.x) * std::cos(0.3f * q.y) + 0.1f * q.z;
}

/// The middle of a cell, in the world.
Vec3 middle(int x, int y, int z) {
    const Vec3 place((static_cast<float>(x) + 0.5f) / cells[0], (static_cast<float>(y) + 0.5f) / cells[1],
                     (static_cast<float>(z) + 0.5f) / cells[2]);
    return world_from_index.point(box.min + place * box.size());
}

class GlowOfABox : public testing::Test {
protected:
    template <class Visit>
    static void for_each_cell(const Visit& visit) {
        for (int z = 0; z < cells[2]; ++z) {
            for (int y = 0; y < cells[1]; ++y) {
                for (int x = 0; x < cells[0]; ++x) {
                    visit(middle(x, y, z));
                }
            }
        }
    }

    const EmissionSampler glow_{box, world_from_index, emitted};
    const double cell_ =
        world_from_index.determinant() * box.size().x * box.size().y * box.size().z / (cells[0] * cells[1] * cells[2]);
};

TEST_F(GlowOfABox, DensityIsProportionalToWhatIsEmittedAndIntegratesToOne) {
    double integral = 0, power = 0;
    for_each_cell([&](const Vec3& p) {
        integral += cell_ * static_cast<double>(glow_.density(p));
        power += cell_ * static_cast<double>(emitted(p));
    });
    EXPECT_NEAR(integral, 1, 1e-5);
    EXPECT_NEAR(glow_.power(), power, 2e-3 * power);
    for_each_cell([&](const Vec3& p) {
        EXPECT_NEAR(glow_.density(p) * power, emitted(p), 0.03 * static_cast<double>(emitted(p))) << p;
    });
    EXPECT_EQ(glow_.density(world_from_index.point(box.min - Vec3(0.1f))), 0);
    EXPECT_EQ(glow_.density(world_from_index.point(box.max + Vec3(0.1f))), 0);
}

TEST_F(GlowOfABox, SamplesFollowTheDensity) {
    constexpr int samples = 400000;
    std::vector<double> expected;
    for_each_cell([&](const Vec3& p) { expected.push_back(samples * cell_ * static_cast<double>(glow_.density(p))); });
    double total = 0;
    for (const double e : expected) {
        total += e;
    }
    std::vector<std::uint64_t> observed(expected.size());
    const Box3 bounds = glow_.bounds();
    Pcg32 random(3);
    for (int i = 0; i < samples; ++i) {
        const Vec2 u = random.uniform2();
        const EmissionSampler::Sample s = glow_.sample(u, random.uniform());
        ASSERT_TRUE(bounds.intersects(s.position));
        const Vec3 place = (test::index_from_world(40).point(s.position) - box.min) / box.size();
        const int x = static_cast<int>(place.x * static_cast<float>(cells[0]));
        const int y = static_cast<int>(place.y * static_cast<float>(cells[1]));
        const int z = static_cast<int>(place.z * static_cast<float>(cells[2]));
        ++observed.at(static_cast<std::size_t>((z * cells[1] + y) * cells[0] + x));
        if (i % 100 == 0) {
            EXPECT_NEAR(s.density, glow_.density(s.position), 1e-5f * s.density);
        }
    }
    for (double& e : expected) {
        e *= samples / total;
    }
    EXPECT_GT(chi_square_test(observed, expected).p_value, 1e-3);
    // A cell in three has a tenth more than it should.
    double more = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        expected[i] *= i % 3 == 0 ? 1.1 : 1.0;
        more += expected[i];
    }
    for (double& e : expected) {
        e *= samples / more;
    }
    EXPECT_LT(chi_square_test(observed, expected).p_value, 1e-3) << "the test could not fail";
}

TEST_F(GlowOfABox, UnitIsTheSideOfACubeThatGlows) {
    const EmissionSampler cube(Box3(Vec3(0), Vec3(8)), Transform::scale(0.25, 0.25, 0.25),
                               [](const Vec3&) { return 3.0f; });
    EXPECT_NEAR(cube.unit(), 2, 1e-5f);
    EXPECT_NEAR(cube.power(), 24, 1e-4f);
    EXPECT_LT(glow_.unit(), std::cbrt(world_from_index.determinant() * box.size().x * box.size().y * box.size().z));
    // A patch at a distance of 2 of a density 1/8 in its volume, over a depth of one unit.
    EXPECT_NEAR(cube.seen_from({-1, 1, 1}, {1, 1, 1}, cube.density({1, 1, 1})), 0.125f * 4 * 2, 1e-5f);
}

std::shared_ptr<const GridEmission> emission(const Rgb& radiance) {
    auto result = std::make_shared<GridEmission>();
    result->radiance = radiance;
    return result;
}

TEST(EmissionSampler, OfADarkMediumIsNone) {
    const EmissionSampler dark(box, world_from_index, [](const Vec3&) { return 0.0f; });
    EXPECT_EQ(dark.power(), 0);
    EXPECT_TRUE(dark.bounds().isEmpty());
    EXPECT_EQ(dark.density(middle(1, 2, 3)), 0);
    EXPECT_EQ(test::smooth_medium(Rgb(1), Rgb(1)).glow(), nullptr);
    EXPECT_EQ(test::smooth_medium(Rgb(0), Rgb(1), emission(Rgb(1))).glow(), nullptr)
        << "what does not absorb emits nothing";
    const GridMedium bright = test::smooth_medium(Rgb(1), Rgb(1), emission(Rgb(2, 3, 4)));
    ASSERT_NE(bright.glow(), nullptr);
    const Vec3 p(0.1f, -0.2f, 0.3f);
    const float density = bright.density().interpolate(test::index_from_world().point(p));
    EXPECT_EQ(bright.emitted_at(p), Rgb(2, 3, 4) * density);
}

}  // namespace
}  // namespace wend
