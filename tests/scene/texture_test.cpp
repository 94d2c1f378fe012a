// What textures make of texture coordinates, and of the side that they are seen from.
#include <wend/scene/texture.h>

#include <gtest/gtest.h>

#include <memory>

namespace wend {
namespace {

TEST(Texture, AMirroredPictureGoesOnAsItsMirrorImage) {
    auto image = std::make_shared<Image>(4, 1);
    for (int x = 0; x < 4; ++x) {
        image->at(x, 0) = Rgb(static_cast<float>(x));
    }
    ImageTexture picture;
    picture.image = image;
    picture.wrap = ImageTexture::Wrap::mirror;
    picture.nearest = true;
    Textures textures;
    const TextureId id = textures.add(picture);
    const auto at = [&](float u) { return textures.evaluate_grey(id, {{u, 0.5f}, {0, 0, 0}}); };
    for (const float u : {0.1f, 0.4f, 0.6f, 0.9f}) {
        EXPECT_EQ(at(-u), at(u)) << u;
        EXPECT_EQ(at(2 - u), at(u)) << u;
        EXPECT_EQ(at(2 + u), at(u)) << u;
        EXPECT_NE(at(1 - u), at(u)) << u;
    }
}

TEST(Texture, SidesAreTold) {
    Textures textures;
    const TextureId front = textures.add_constant(Rgb(0.2f)), back = textures.add_constant(Rgb(0.7f));
    const TextureId sides = textures.add(SidesTexture{front, back});
    TexturePoint point{{0, 0}, {0, 0, 0}};
    EXPECT_EQ(textures.evaluate_grey(sides, point), 0.2f);
    point.is_behind = true;
    EXPECT_EQ(textures.evaluate_grey(sides, point), 0.7f);
    EXPECT_FALSE(textures.constant(sides));
}

TEST(Texture, TheAngleOfViewIsTold) {
    Textures textures;
    const auto values = [](std::vector<Rgb> of) { return std::make_shared<const std::vector<Rgb>>(std::move(of)); };
    const TextureId id = textures.add(FacingTexture{values({Rgb(1.0f), Rgb(0.5f), Rgb(0.0f, 0.1f, 0.2f)})});
    const TextureId one = textures.add(FacingTexture{values({Rgb(0.3f)})});
    TexturePoint point{{0, 0}, {0, 0, 0}};
    const auto seen = [&](float cosine) {
        point.facing = cosine;
        return textures.evaluate(id, point).b;
    };
    EXPECT_EQ(seen(0), 1.0f);
    EXPECT_NEAR(seen(0.25f), 0.75f, 1e-6f);
    EXPECT_NEAR(seen(0.75f), 0.35f, 1e-6f);
    EXPECT_NEAR(seen(1), 0.2f, 1e-6f);
    EXPECT_NEAR(seen(1.0001f), 0.2f, 1e-6f);
    EXPECT_EQ(textures.evaluate_grey(one, point), 0.3f);
}

TEST(Texture, CoordinatesAreMappedByAnyMatrix) {
    const UvMapping mapping{2, 3, 10, 20, 0.5f, 0.25f};
    EXPECT_EQ(mapping({{4, 8}, {0, 0, 0}}), Vec2(2 * 4 + 0.5f * 8 + 10, 0.25f * 4 + 3 * 8 + 20));
}

}  // namespace
}  // namespace wend
