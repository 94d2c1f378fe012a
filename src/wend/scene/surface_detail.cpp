#include <wend/scene/surface_detail.h>

#include <wend/scene/picture_lookup.h>

#include <cmath>
#include <optional>

namespace wend {
namespace {

/// Bilinear, repeated, v upwards.
Vec3 look_up(const Image& image, const Vec2& uv) {
    const auto repeated = [](float x) {
        const float part = x - std::floor(x);
        return part >= 0 && part < 1 ? part : 0.0f;  // as well for what is too large to have one
    };
    const Vec2 place(repeated(uv.x) * static_cast<float>(image.width),
                     repeated(1 - uv.y) * static_cast<float>(image.height));
    const Rgb c = bilinear(place, [&](int i, int j) {
        return image.at((i + image.width) % image.width, (j + image.height) % image.height);
    });
    return {c.r, c.g, c.b};
}

/// x along `along`, as far as that is across n.
std::optional<Frame> frame_around(Vec3 n, const Vec3& along) {
    n = normalize(n);
    const Vec3 across = along - n * dot(n, along);
    if (!is_finite(n) || !(length_squared(across) > 1e-12f * length_squared(along))) {
        return std::nullopt;
    }
    const Vec3 s = normalize(across);
    return Frame{s, cross(n, s), n};
}

/// The normal of the surface moved along its normal by a texture (blinn1978), by differences.
std::optional<Frame> bumped(TextureId displacement, const Frame& shading, const TexturePoint& p,
                            const SurfaceDerivatives& s, const Textures& textures) {
    constexpr float step = 0.0005f;
    const float here = textures.evaluate_grey(displacement, p);
    const float beyond_u =
        textures.evaluate_grey(displacement, {p.uv + Vec2(step, 0), p.position + s.dpdu * step, p.normal});
    const float beyond_v =
        textures.evaluate_grey(displacement, {p.uv + Vec2(0, step), p.position + s.dpdv * step, p.normal});
    const Vec3 dpdu = s.dpdu + shading.n * ((beyond_u - here) / step) + s.dndu * here;
    const Vec3 dpdv = s.dpdv + shading.n * ((beyond_v - here) / step) + s.dndv * here;
    return frame_around(cross(dpdu, dpdv), dpdu);
}

}  // namespace

Frame detailed_frame(const SurfaceDetail& detail, const Frame& shading, const Vec3& normal, const TexturePoint& p,
                     const SurfaceDerivatives& surface, const Textures& textures) {
    std::optional<Frame> frame;
    if (detail.normal_map) {
        const Vec3 local = look_up(*detail.normal_map, p.uv) * 2 - Vec3(1);
        frame = frame_around(shading.to_world(local), surface.dpdu);
    } else {
        frame = bumped(detail.displacement, shading, p, surface, textures);
    }
    if (!frame) {
        return shading;
    }
    if (dot(frame->n, normal) < 0) {
        frame->n = -frame->n;
        frame->t = -frame->t;
    }
    return *frame;
}

}  // namespace wend
