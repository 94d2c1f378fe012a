// Textures: colour as a function of a surface point. A node refers to others by index, so that a scene's textures are
// one flat list of values.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/image.h>
#include <wend/core/transform.h>

#include <memory>
#include <variant>
#include <vector>

namespace wend {

class AlbedoInversion;

/// What a texture is evaluated at.
struct TexturePoint {
    Vec2 uv;
    Vec3 position;  ///< in the world
};

/// Surface parameters to texture coordinates.
struct UvMapping {
    float su = 1, sv = 1, du = 0, dv = 0;

    Vec2 operator()(const TexturePoint& p) const { return {su * p.uv.x + du, sv * p.uv.y + dv}; }
};

/// Index of a texture in the scene's list.
using TextureId = int;

struct ConstantTexture {
    Rgb value;
};

/// The product of two textures.
struct ScaleTexture {
    TextureId texture = 0;
    TextureId scale = 0;
};

/// (1 - amount) * first + amount * second.
struct MixTexture {
    TextureId first = 0;
    TextureId second = 0;
    TextureId amount = 0;
};

/// A picture, bilinearly interpolated. v grows upwards: (0,0) is the lower left corner of the picture.
struct ImageTexture {
    enum class Wrap { repeat, clamp, black };

    std::shared_ptr<const Image> image;
    UvMapping mapping;
    Wrap wrap = Wrap::repeat;
    float scale = 1;
    bool invert = false;  ///< 1 - value, after the scale
};

/// Two textures in the squares of a chess board of unit squares in (u, v), or of unit cubes in texture space.
struct CheckerboardTexture {
    TextureId even = 0;
    TextureId odd = 0;
    int dimensions = 2;
    UvMapping mapping;
    AffineMap texture_from_world;
};

/// The albedo that gives a medium the colour of another texture, over the medium's own.
struct RelativeAlbedoTexture {
    TextureId reflectance = 0;
    std::shared_ptr<const AlbedoInversion> albedo_of;
    Rgb albedo;
};

using Texture =
    std::variant<ConstantTexture, ScaleTexture, MixTexture, ImageTexture, CheckerboardTexture, RelativeAlbedoTexture>;

/// A scene's textures. References must point to earlier entries, so that evaluation ends.
class Textures {
public:
    TextureId add(Texture texture);
    TextureId add_constant(const Rgb& value) { return add(ConstantTexture{value}); }

    Rgb evaluate(TextureId id, const TexturePoint& p) const;
    float evaluate_grey(TextureId id, const TexturePoint& p) const { return evaluate(id, p).r; }
    /// The value, where the texture is the same everywhere; null otherwise.
    const Rgb* constant(TextureId id) const;

private:
    std::vector<Texture> textures_;
};

}  // namespace wend
