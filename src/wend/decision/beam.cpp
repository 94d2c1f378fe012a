#include <wend/decision/flight_pieces.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wend {

std::optional<RayInterval> crossing(const Beam& beam, const Ray& ray, float length) {
    // With p from the cone's tip to the ray's origin: (p + t d)·axis >= cosine |p + t d|. Squared, a quadratic.
    const Vec3 p = ray.origin - beam.position;
    const float along = dot(ray.direction, beam.axis), start = dot(p, beam.axis), square = sqr(beam.cosine);
    const float a = along * along - square;
    const float b = start * along - square * dot(p, ray.direction);
    const float c = start * start - square * length_squared(p);
    const float discriminant = b * b - a * c;
    if (discriminant < 0 && a < 0) {
        // The line meets no side of the cone, so it is nowhere in it.
        return std::nullopt;
    }
    std::array<float, 4> ends = {0, 0, 0, length};
    // Without cancellation; a root that is far away or not there does not divide the way.
    const float q = -(b + std::copysign(std::sqrt(std::max(0.0f, discriminant)), b));
    const auto root = [&](float numerator, float denominator) {
        const float t = denominator != 0 ? numerator / denominator : 0.0f;
        return t > 0 && t < length ? t : 0.0f;
    };
    ends[1] = root(q, a);
    ends[2] = root(c, q);
    if (ends[1] > ends[2]) {
        std::swap(ends[1], ends[2]);
    }
    constexpr float far = 1e15f;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const float middle = ends[i + 1] < far ? 0.5f * (ends[i] + ends[i + 1]) : 2 * ends[i] + 1;
        const Vec3 w = p + ray.direction * middle;
        if (ends[i] < ends[i + 1] && dot(w, beam.axis) >= beam.cosine * wend::length(w)) {
            return RayInterval{ends[i], ends[i + 1]};
        }
    }
    return std::nullopt;
}

}  // namespace wend
