// Rays that start where Embree does not reckon: they leave the scene, and end nothing.
#include "small_scene.h"

#include <wend/scene/scene.h>

#include <gtest/gtest.h>

#include <limits>

namespace wend {
namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// Whether a ray finds anything, and whether a connection is blocked: the same for what has left the scene.
void expect_met(const Scene& scene, const Ray& ray, bool met) {
    EXPECT_EQ(scene.find(ray, infinity).has_value(), met);
    EXPECT_EQ(scene.is_occluded(ray, infinity), met);
}

TEST(FarRays, LeaveTheScene) {
    SceneDescription description = test::two_materials();
    test::add(description, test::square());
    const Scene scene(std::move(description));
    expect_met(scene, {{0, 0, 1e6f}, {0, 0, -1}}, true);
    for (const float far : {2e18f, 3e38f, infinity, not_a_number}) {
        expect_met(scene, {{0, 0, far}, {0, 0, -1}}, false);
        expect_met(scene, {{0, 0, 1}, {0, 0, -far}}, false);
    }
    expect_met(scene, {{0, 0, 1}, {0, not_a_number, -1}}, false);
    EXPECT_FALSE(scene.find(Ray{{0, 0, 1}, {0, 0, -1}}, not_a_number));
}

TEST(FarRays, LeaveTheSceneOfATinyInstance) {
    constexpr double scale = 1e-10;
    SceneDescription description = test::two_materials();
    test::add(description, test::square());
    description.objects.push_back({description.world_surfaces});
    description.world_surfaces.clear();
    description.instances.push_back({0, Transform::scale(scale, scale, scale)});
    const Scene scene(std::move(description));
    expect_met(scene, {{0, 0, 1}, {0, 0, -1}}, true);
    // In the instance it would be beyond 1e19.
    expect_met(scene, {{0, 0, 1e9f}, {0, 0, -1}}, false);
}

}  // namespace
}  // namespace wend
