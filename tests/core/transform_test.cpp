#include <wend/core/transform.h>

#include <gtest/gtest.h>

#include <stdexcept>

namespace wend {
namespace {

TEST(Transform, ComposesRightToLeft) {
    const Transform t = Transform::translate(1, 2, 3) * Transform::scale(2, 2, 2);
    EXPECT_EQ(t.point(Vec3(1, 1, 1)), Vec3(3, 4, 5));
    EXPECT_EQ(t.vector(Vec3(1, 1, 1)), Vec3(2, 2, 2));
    EXPECT_EQ(t.inverse().point(Vec3(3, 4, 5)), Vec3(1, 1, 1));
}

TEST(Transform, RotatesCounterClockwiseAboutTheAxis) {
    const Vec3 p = Transform::rotate(90, 0, 0, 1).point(Vec3(1, 0, 0));
    EXPECT_NEAR(p.x, 0, 1e-6);
    EXPECT_NEAR(p.y, 1, 1e-6);
}

TEST(Transform, LookAtPutsTheTargetOnThePositiveZAxis) {
    const Transform t = Transform::look_at({1, 2, 3}, {4, 2, 3}, {0, 1, 0});
    const Vec3 p = t.point(Vec3(4, 2, 3));
    EXPECT_NEAR(p.x, 0, 1e-6);
    EXPECT_NEAR(p.y, 0, 1e-6);
    EXPECT_NEAR(p.z, 3, 1e-6);
    EXPECT_NEAR(t.point(Vec3(1, 3, 3)).y, 1, 1e-6);
}

TEST(Transform, NormalsStayPerpendicularUnderAnisotropicScale) {
    const Transform t = Transform::scale(1, 4, 1);
    EXPECT_NEAR(dot(t.normal(Vec3(1, 1, 0)), t.vector(Vec3(1, -1, 0))), 0, 1e-6);
}

TEST(Transform, MirrorSwapsHandedness) {
    EXPECT_TRUE(Transform::scale(-1, 1, 1).swaps_handedness());
    EXPECT_FALSE(Transform::rotate(33, 1, 2, 3).swaps_handedness());
}

TEST(Transform, RefusesDegenerateInput) {
    EXPECT_THROW(Transform::scale(0, 1, 1), std::domain_error);
    EXPECT_THROW(Transform::rotate(10, 0, 0, 0), std::domain_error);
    EXPECT_THROW(Transform::look_at({0, 0, 0}, {0, 1, 0}, {0, 1, 0}), std::domain_error);
    const Transform::Matrix singular = {{1, 0, 0, 0}, {2, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    EXPECT_THROW(Transform{singular}, std::domain_error);
}

}  // namespace
}  // namespace wend
