#include <wend/scene/surface_detail.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

namespace wend {
namespace {

const SurfaceDerivatives flat{{2, 0, 0}, {0, 3, 0}, {0, 0, 0}, {0, 0, 0}};

Frame mapped(const Image& map, const Vec2& uv, const Vec3& normal = {0, 0, 1}) {
    SurfaceDetail detail;
    detail.normal_map = std::make_shared<const Image>(map);
    return detailed_frame(detail, Frame(), normal, {uv, {0, 0, 0}}, flat, Textures());
}

TEST(SurfaceDetail, ANormalMapTiltsTheFrame) {
    const Image map(3, 5, Rgb(0.9f, 0.5f, 0.8f));
    const Frame frame = mapped(map, {0.3f, 0.7f});
    const Vec3 expected = normalize(Vec3(0.8f, 0, 0.6f));
    EXPECT_NEAR(length(frame.n - expected), 0, 1e-6f);
    EXPECT_NEAR(dot(frame.s, frame.n), 0, 1e-6f);
    EXPECT_NEAR(length(cross(frame.n, frame.s) - frame.t), 0, 1e-6f);
    // The side stays that of the geometric normal.
    EXPECT_LT(mapped(map, {0.3f, 0.7f}, {0, 0, -1}).n.z, 0);
}

TEST(SurfaceDetail, ParametersWithoutBoundsStayInTheMap) {
    const Image map(2665, 7, Rgb(0.9f, 0.5f, 0.8f));
    constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    for (const float u : {-1e-9f, -0.2f, 1.0f, 7.7f, 3e38f, -3e38f, inf, nan}) {
        for (const Vec2& uv : {Vec2(u, 0.5f), Vec2(0.5f, u), Vec2(u, u)}) {
            EXPECT_NEAR(length(mapped(map, uv).n), 1, 1e-5f) << u;
        }
    }
}

TEST(SurfaceDetail, ABumpIsTheSlopeOfItsTexture) {
    // A ramp of the position along x, half as high as it is long.
    Textures textures;
    auto ramp = std::make_shared<Image>(2, 1);
    ramp->at(0, 0) = Rgb(0.0f);
    ramp->at(1, 0) = Rgb(1.0f);
    ImageTexture texture;
    texture.image = ramp;
    SurfaceDetail detail;
    detail.displacement = textures.add(texture);
    // Between the middles of both pixels the texture grows by 1 over half of u, which is 1 long.
    const Frame frame = detailed_frame(detail, Frame(), {0, 0, 1}, {{0.5f, 0.5f}, {0, 0, 0}}, flat, textures);
    const Vec3 expected = normalize(Vec3(-1, 0, 1));
    EXPECT_NEAR(length(frame.n - expected), 0, 2e-3f);
}

}  // namespace
}  // namespace wend
