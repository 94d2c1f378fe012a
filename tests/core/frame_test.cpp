#include <wend/core/random.h>
#include <wend/core/vector.h>
#include <wend/sampling/warp.h>

#include <gtest/gtest.h>

#include <vector>

namespace wend {
namespace {

std::vector<Vec3> normals() {
    std::vector<Vec3> all = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {1, 0, -0.0f}};
    // Where a basis that divides by 1 + z loses its digits.
    for (const float tilt : {1e-2f, 1e-3f, 1e-4f, 1e-6f}) {
        all.push_back(normalize(Vec3(tilt, -tilt, -1)));
    }
    Pcg32 random(1);
    for (int i = 0; i < 1000; ++i) {
        all.push_back(to_sphere(random.uniform2()));
    }
    return all;
}

TEST(Frame, IsOrthonormalAndRightHanded) {
    for (const Vec3& n : normals()) {
        const Frame f = Frame::from_z(n);
        EXPECT_EQ(f.n, n);
        EXPECT_NEAR(length(f.s), 1, 1e-6f);
        EXPECT_NEAR(length(f.t), 1, 1e-6f);
        EXPECT_NEAR(dot(f.s, f.t), 0, 1e-6f);
        EXPECT_NEAR(dot(f.s, f.n), 0, 1e-6f);
        EXPECT_NEAR(dot(f.t, f.n), 0, 1e-6f);
        EXPECT_NEAR(dot(cross(f.s, f.t), f.n), 1, 1e-6f);
    }
}

TEST(Frame, WorldAndLocalAreInverse) {
    const Vec3 v(0.3f, -2, 1.5f);
    for (const Vec3& n : normals()) {
        const Frame f = Frame::from_z(n);
        EXPECT_LT(length(f.to_world(f.to_local(v)) - v), 2e-6f);
        EXPECT_LT(length(f.to_local(n) - Vec3(0, 0, 1)), 1e-6f);
    }
}

}  // namespace
}  // namespace wend
