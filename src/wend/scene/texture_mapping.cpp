#include <wend/scene/texture_mapping.h>

#include <algorithm>
#include <cmath>

namespace wend {

Vec2 SphericalMapping::operator()(const TexturePoint& p) const {
    const Vec3 q = texture_from_world.point(p.position);
    const float theta = std::atan2(std::hypot(q.x, q.y), q.z);
    const float phi = std::atan2(q.y, q.x);
    return {theta / pi, (phi < 0 ? phi + 2 * pi : phi) / (2 * pi)};
}

Vec2 CylindricalMapping::operator()(const TexturePoint& p) const {
    const Vec3 q = texture_from_world.point(p.position);
    return {(pi + std::atan2(q.y, q.x)) / (2 * pi), q.z};
}

Vec2 PlanarMapping::operator()(const TexturePoint& p) const {
    const Vec3 q = texture_from_world.point(p.position);
    return {ds + dot(q, vs), dt + dot(q, vt)};
}

Vec2 map_to_texture(const TextureMapping& mapping, const TexturePoint& p) {
    return std::visit([&](const auto& m) { return m(p); }, mapping);
}

}  // namespace wend
