#include <wend/core/motion.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace wend {
namespace {

constexpr double pi = std::numbers::pi;

void expect_near(const Vec3& a, const Vec3& b, float tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(Motion, AtRestItIsTheTransformItself) {
    const Transform still = Transform::translate(1, 2, 3) * Transform::rotate(40, 1, 2, 3);
    const Motion motion(still), from_equals(still, still);
    EXPECT_FALSE(motion.is_moving());
    EXPECT_FALSE(from_equals.is_moving());
    EXPECT_EQ(motion.key_count(), 1u);
    EXPECT_EQ(motion.at(0.3f).world_from_object.point({1, 1, 1}), AffineMap(still).point({1, 1, 1}));
    EXPECT_EQ(motion.at(0.3f).object_from_world.point({1, 1, 1}), AffineMap(still.inverse()).point({1, 1, 1}));
}

TEST(Motion, PlaceAndStretchChangeEvenly) {
    const Motion motion(Transform::translate(1, 0, 0), Transform::translate(3, 4, 0) * Transform::scale(3, 1, 1));
    EXPECT_EQ(motion.key_count(), 2u) << "without a turn matrices are linear";
    expect_near(motion.at(0.25f).world_from_object.point({1, 1, 1}), {3, 2, 1}, 1e-6f);
    EXPECT_EQ(motion.start(), Transform::translate(1, 0, 0));
    expect_near(motion.at(1).world_from_object.point({1, 1, 1}), {6, 5, 1}, 1e-6f);
}

TEST(Motion, TurnsEvenlyByTheShortestWay) {
    for (const double degrees : {1.0, 30.0, 90.0, 179.0, -120.0, 270.0}) {
        const Motion motion(Transform(), Transform::rotate(degrees, 0, 0, 1));
        const double shortest = std::remainder(degrees, 360.0);
        for (const float t : {0.0f, 0.1f, 0.37f, 0.5f, 0.8f, 1.0f}) {
            const Vec3 p = motion.at(t).world_from_object.point({1, 0, 0});
            EXPECT_NEAR(std::hypot(p.x, p.y), 1, 8e-5);
            EXPECT_NEAR(std::atan2(double{p.y}, double{p.x}), shortest * double{t} * pi / 180, 3e-6) << degrees << t;
        }
        // A degree would be seen.
        EXPECT_GT(std::abs(shortest), 0.9);
    }
}

TEST(Motion, AStretchTurnsWithTheRest) {
    // M = R S with the same S at both ends: in between it is R(t) S.
    const Transform stretch =
        Transform::rotate(30, 1, 1, 0) * Transform::scale(1, 2, 0.5) * Transform::rotate(-30, 1, 1, 0);
    const Motion motion(stretch, Transform::rotate(90, 0, 0, 1) * stretch);
    const Vec3 p(0.3f, -0.7f, 0.9f);
    expect_near(motion.at(0.5f).world_from_object.point(p), (Transform::rotate(45, 0, 0, 1) * stretch).point(p), 1e-4f);
}

TEST(Motion, WhatMirrorsMoves) {
    const Transform mirror = Transform::scale(-1, 1, 1);
    const Motion motion(mirror, Transform::rotate(60, 0, 1, 0) * mirror);
    const Vec3 p(1, 2, 3);
    expect_near(motion.at(0.5f).world_from_object.point(p), (Transform::rotate(30, 0, 1, 0) * mirror).point(p), 4e-4f);
    EXPECT_THROW(Motion(Transform(), mirror), std::domain_error);
}

TEST(Motion, TheInverseIsThatOfTheSameTime) {
    const Motion motion(Transform::translate(3, 2, 1) * Transform::rotate(20, 1, 2, 3) * Transform::scale(1, 2, 3),
                        Transform::translate(-1, 2, 5) * Transform::rotate(170, 3, -2, 1) * Transform::scale(2, 1, 1));
    for (const float t : {0.0f, 0.013f, 0.4f, 0.777f, 1.0f}) {
        const Placement place = motion.at(t);
        const Vec3 p(0.4f, -1.2f, 2.5f);
        expect_near(place.object_from_world.point(place.world_from_object.point(p)), p, 1e-5f);
        expect_near(place.object_from_world.vector(place.world_from_object.vector(p)), p, 1e-5f);
    }
}

TEST(Motion, WithinAnotherBothAreDone) {
    const Motion outer(Transform(), Transform::rotate(100, 0, 1, 0));
    const Motion inner(Transform::translate(1, 0, 0), Transform::translate(2, 1, 0));
    const Motion still(Transform::translate(0, 0, 5));
    const Vec3 p(0.5f, 0.25f, 0.125f);
    for (const float t : {0.0f, 0.3f, 0.5f, 1.0f}) {
        const auto at = [&](const Motion& m, const Vec3& q) { return m.at(t).world_from_object.point(q); };
        expect_near(at(outer * inner, p), at(outer, at(inner, p)), 3e-4f);
        expect_near(at(still * inner, p), at(still, at(inner, p)), 1e-6f);
        expect_near(at(inner * still, p), at(inner, at(still, p)), 1e-6f);
    }
    EXPECT_FALSE((still * still).is_moving());
    EXPECT_EQ((still * inner).key_count(), inner.key_count());
}

}  // namespace
}  // namespace wend
