#include <wend/scene/surface_detail.h>

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
    const float x = repeated(uv.x) * static_cast<float>(image.width) - 0.5f;
    const float y = repeated(1 - uv.y) * static_cast<float>(image.height) - 0.5f;
    const float x0 = std::floor(x), y0 = std::floor(y);
    const auto at = [&](float column, float row) {
        const auto wrapped = [](float i, int size) { return (static_cast<int>(i) + size) % size; };
        return image.at(wrapped(column, image.width), wrapped(row, image.height));
    };
    const float fx = x - x0, fy = y - y0;
    const Rgb c = at(x0, y0) * ((1 - fx) * (1 - fy)) + at(x0 + 1, y0) * (fx * (1 - fy)) +
                  at(x0, y0 + 1) * ((1 - fx) * fy) + at(x0 + 1, y0 + 1) * (fx * fy);
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
