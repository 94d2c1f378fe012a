// Textures: colour as a function of a surface point. A node refers to others by index, so that a scene's textures are
// one flat list of values.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/image.h>
#include <wend/core/transform.h>
#include <wend/scene/noise.h>
#include <wend/scene/texture_mapping.h>

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

namespace wend {

class AlbedoInversion;

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

/// (1 - amount) * second + amount * first, where the amount is the magnitude of the cosine between the normal and a
/// direction.
struct DirectionMixTexture {
    TextureId first = 0;
    TextureId second = 0;
    Vec3 direction{0, 1, 0};  ///< in the world, of unit length
};

/// Two textures, for the sides of a surface: the normal points away from the front.
struct SidesTexture {
    TextureId front = 0;
    TextureId back = 0;
};

/// By the angle from which a surface is seen, which makes what it scatters another from there and back again.
struct FacingTexture {
    /// One at least: at cosines as far from each other, from 0, where the view grazes the surface, to 1; linear
    /// between.
    std::shared_ptr<const std::vector<Rgb>> values;
};

/// Bilinear in texture coordinates, from the values at the corners of the unit square: at (0,0), (0,1), (1,0), (1,1).
struct BilerpTexture {
    Rgb v00, v01, v10, v11;
    TextureMapping mapping;
};

/// A picture. t grows upwards: (0,0) is the lower left corner of the picture.
struct ImageTexture {
    /// What is beside it: the picture again, the same mirrored, its border, black, or the rest of a sphere that the
    /// picture shows by the octahedral mapping.
    enum class Wrap { repeat, mirror, clamp, black, octahedral_sphere };

    std::shared_ptr<const Image> image;
    TextureMapping mapping;
    Wrap wrap = Wrap::repeat;
    bool nearest = false;  ///< the nearest pixel, not bilinear interpolation
    float scale = 1;
    bool invert = false;  ///< 1 - value, after the scale
    /// What the value is limited to in the end.
    float least = -infinity;
    float most = infinity;
};

/// Two textures in the squares of a chess board of unit squares in (s, t), or of unit cubes in texture space.
struct CheckerboardTexture {
    TextureId even = 0;
    TextureId odd = 0;
    int dimensions = 2;
    TextureMapping mapping;
    AffineMap texture_from_world;
};

/// Dots at random places, one in about half of the unit squares in (s, t).
struct DotsTexture {
    TextureId dot = 0;
    TextureId ground = 0;
    TextureMapping mapping;
};

/// Sums of noise in texture space: with signs, as magnitudes, or that of waves whose height varies slowly (of which
/// the octaves are fixed).
struct NoiseTexture {
    enum class Kind { fractal, wrinkled, windy };

    Kind kind = Kind::fractal;
    Octaves octaves;
    AffineMap texture_from_world;
};

/// Veins: waves along y in texture space, displaced by noise, in the colours of marble.
struct MarbleTexture {
    Octaves octaves;
    float scale = 1;            ///< of texture space
    float displacement = 0.2f;  ///< how much of the noise is added to the phase of the waves
    AffineMap texture_from_world;
};

/// Values at the vertices of a mesh, or on its faces: what the mesh has beside its shape.
struct MeshTexture {
    std::shared_ptr<const std::vector<Rgb>> values;
    /// Three a triangle, one triangle at least; those of another mesh have them again from the first on.
    std::shared_ptr<const std::vector<std::uint32_t>> indices;
};

/// The albedo that gives a medium the colour of another texture, over the medium's own.
struct RelativeAlbedoTexture {
    TextureId reflectance = 0;
    std::shared_ptr<const AlbedoInversion> albedo_of;
    Rgb albedo;
};

using Texture = std::variant<ConstantTexture, ScaleTexture, MixTexture, DirectionMixTexture, SidesTexture,
                             FacingTexture, BilerpTexture, ImageTexture, CheckerboardTexture, DotsTexture, NoiseTexture,
                             MarbleTexture, MeshTexture, RelativeAlbedoTexture>;

/// A scene's textures. References must point to earlier entries, so that evaluation ends.
class Textures {
public:
    TextureId add(Texture texture);
    TextureId add_constant(const Rgb& value) { return add(ConstantTexture{value}); }

    Rgb evaluate(TextureId id, const TexturePoint& p) const;
    float evaluate_grey(TextureId id, const TexturePoint& p) const { return evaluate(id, p).r; }
    /// The value, where the texture is the same everywhere; null otherwise.
    const Rgb* constant(TextureId id) const;
    /// The texture, where it is a picture; null otherwise.
    const ImageTexture* picture(TextureId id) const {
        return std::get_if<ImageTexture>(&textures_[static_cast<std::size_t>(id)]);
    }

private:
    Rgb value_of(const ConstantTexture& t, const TexturePoint&) const { return t.value; }
    Rgb value_of(const ScaleTexture& t, const TexturePoint& p) const;
    Rgb value_of(const MixTexture& t, const TexturePoint& p) const;
    Rgb value_of(const DirectionMixTexture& t, const TexturePoint& p) const;
    Rgb value_of(const SidesTexture& t, const TexturePoint& p) const {
        return evaluate(p.is_behind ? t.back : t.front, p);
    }
    Rgb value_of(const FacingTexture& t, const TexturePoint& p) const;
    Rgb value_of(const BilerpTexture& t, const TexturePoint& p) const;
    Rgb value_of(const ImageTexture& t, const TexturePoint& p) const;
    Rgb value_of(const CheckerboardTexture& t, const TexturePoint& p) const;
    Rgb value_of(const DotsTexture& t, const TexturePoint& p) const;
    Rgb value_of(const NoiseTexture& t, const TexturePoint& p) const;
    Rgb value_of(const MarbleTexture& t, const TexturePoint& p) const;
    Rgb value_of(const MeshTexture& t, const TexturePoint& p) const;
    Rgb value_of(const RelativeAlbedoTexture& t, const TexturePoint& p) const;

    std::vector<Texture> textures_;
};

}  // namespace wend
