#include <wend/scene/curve.h>

#include <wend/core/vector.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

using Bezier = std::array<Vec3, 4>;

Vec3 between(const Vec3& a, const Vec3& b, float t) {
    return a + (b - a) * t;
}

Vec3 value(const Bezier& c, float u) {
    const float w = 1 - u;
    return c[0] * (w * w * w) + c[1] * (3 * u * w * w) + c[2] * (3 * u * u * w) + c[3] * (u * u * u);
}

Vec3 derivative(const Bezier& c, float u) {
    const float w = 1 - u;
    return ((c[1] - c[0]) * (w * w) + (c[2] - c[1]) * (2 * u * w) + (c[3] - c[2]) * (u * u)) * 3.0f;
}

/// The value of the curve's blossom, by which control points of any part follow.
Vec3 blossom(const Bezier& c, float r, float s, float t) {
    const Vec3 a = between(c[0], c[1], r), b = between(c[1], c[2], r), d = between(c[2], c[3], r);
    return between(between(a, b, s), between(b, d, s), t);
}

Bezier part(const Bezier& c, float u0, float u1) {
    return {blossom(c, u0, u0, u0), blossom(c, u0, u0, u1), blossom(c, u0, u1, u1), blossom(c, u1, u1, u1)};
}

/// From where to where a primitive goes along its segment.
struct Range {
    float begin, end;

    Range(float from, float to) : begin(from), end(to) {}
    Range(const CurveSet& curves, std::uint32_t primitive)
        : Range(static_cast<float>(primitive % curves.pieces) / static_cast<float>(curves.pieces),
                static_cast<float>(primitive % curves.pieces + 1) / static_cast<float>(curves.pieces)) {}

    float middle() const { return 0.5f * (begin + end); }
    float at(float w) const { return begin + (end - begin) * w; }
};

/// The least sine of the angle between a ray and the axis of a tube at which it is met where it is; rays along the axis
/// come in by an end, or are inside for long.
constexpr float steepest = 0.5f;

float largest_width(const CurveSegment& segment, const Range& range) {
    return std::max(segment.width_at(range.begin), segment.width_at(range.end));
}

/// How often a curve must be halved so that each part is as good as straight, for a width.
int halvings(const Bezier& c, float width) {
    constexpr int most = 10;
    constexpr float tolerance = 0.05f;  // of the width
    float bend = 0;
    for (int i = 0; i < 2; ++i) {
        const Vec3 d = c[i] - c[i + 1] * 2.0f + c[i + 2];
        bend = std::max({bend, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    }
    // The distance from the chord is at most sqrt(2) * 6 / 8 of that, and falls by four with each halving.
    const float ratio = bend * 1.0606602f / (tolerance * width);
    return ratio > 1 ? static_cast<int>(std::min(std::log2(ratio) / 2, static_cast<float>(most))) : 0;
}

/// A ray's search along a primitive, in a space whose z axis is the ray: it starts at the origin.
class Search {
public:
    Search(const CurveSet& curves, const CurveSegment& segment, const Vec3& direction, float t_min, float t_max,
           const CrossingFilter& accepted)
        : curves_(curves),
          segment_(segment),
          way_(direction),
          length_(length(direction)),
          t_min_(t_min),
          t_max_(t_max),
          accepted_(accepted) {}

    std::optional<CurveCrossing> run(const Bezier& world, const Vec3& origin, const Range& range) {
        const Frame frame = frame_along(world[3] - world[0]);
        Bezier c;
        for (std::size_t i = 0; i < c.size(); ++i) {
            const Vec3 p = world[i] - origin;
            c[i] = {dot(p, frame.s), dot(p, frame.t), dot(p, frame.n)};
        }
        const float width = largest_width(segment_, range);
        if (width > 0) {
            look_into(c, range, halvings(c, width));
        }
        return found_;
    }

private:
    /// Along the ray, with x along the curve, whose bounds are small then.
    Frame frame_along(const Vec3& chord) const {
        const Vec3 z = way_ / length_;
        const Vec3 across = chord - z * dot(chord, z);
        if (!(length_squared(across) > 1e-12f * length_squared(chord))) {
            return Frame::from_z(z);
        }
        Frame frame;
        frame.n = z;
        frame.s = normalize(across);
        frame.t = cross(z, frame.s);
        return frame;
    }

    void look_into(const Bezier& c, const Range& range, int halvings_left) {
        if (is_missed(c, 0.5f * largest_width(segment_, range))) {
            return;
        }
        if (halvings_left == 0) {
            look_at(c, range);
            return;
        }
        look_into(part(c, 0, 0.5f), {range.begin, range.middle()}, halvings_left - 1);
        look_into(part(c, 0.5f, 1), {range.middle(), range.end}, halvings_left - 1);
    }

    bool is_missed(const Bezier& c, float margin) const {
        const auto apart = [&](int axis, float low, float high, float room) {
            const auto [least, most] = std::minmax({c[0][axis], c[1][axis], c[2][axis], c[3][axis]});
            return least - room > high || most + room < low;
        };
        // A slanted ray is in a tube long before it is at the axis.
        const float before = curves_.kind == CurveSet::Kind::round ? margin / steepest : margin;
        return apart(0, 0, 0, margin) || apart(1, 0, 0, margin) || apart(2, t_min_ * length_, t_max_ * length_, before);
    }

    /// A part that is as good as straight.
    void look_at(const Bezier& c, const Range& range) {
        const auto flat = [](const Vec3& p) { return Vec2(p.x, p.y); };
        const Vec2 p0 = flat(c[0]), p3 = flat(c[3]);
        const Vec2 chord = p3 - p0;
        const float chord_squared = chord.dot(chord);
        // Between the perpendiculars of its ends.
        if (p0.dot(flat(c[1]) - p0) > 0 || p3.dot(flat(c[2]) - p3) > 0 || !(chord_squared > 0)) {
            return;
        }
        const float w = std::clamp(-p0.dot(chord) / chord_squared, 0.0f, 1.0f);
        const float u = range.at(w);
        const float width = seen_width(u);
        const Vec3 middle = value(c, w);
        const float distance = std::hypot(middle.x, middle.y);
        if (!(distance <= 0.5f * width)) {
            return;
        }
        const Vec3 along = derivative(c, w);
        const float before = curves_.kind == CurveSet::Kind::round ? depth_of_tube(along, distance, 0.5f * width) : 0;
        const float t = (middle.z - before) / length_;
        if (!(t > t_min_ && t < t_max_) || !accepted_(t)) {
            return;
        }
        const float side = along.y * middle.x > along.x * middle.y ? 1.0f : -1.0f;
        t_max_ = t;
        found_ = CurveCrossing{t, u, width > 0 ? std::clamp(0.5f + side * distance / width, 0.0f, 1.0f) : 0.5f};
    }

    /// How far before the axis a ray enters a tube whose axis it misses by a distance.
    static float depth_of_tube(const Vec3& along, float distance, float radius) {
        const float sine = std::hypot(along.x, along.y) / length(along);
        return std::sqrt(std::max(radius * radius - distance * distance, 0.0f)) / std::max(sine, steepest);
    }

    float seen_width(float u) const {
        const float width = segment_.width_at(u);
        return curves_.kind == CurveSet::Kind::ribbon ? width * std::abs(dot(segment_.normal_at(u), way_)) / length_
                                                      : width;
    }

    const CurveSet& curves_;
    const CurveSegment& segment_;
    Vec3 way_;
    float length_;
    float t_min_, t_max_;
    const CrossingFilter& accepted_;
    std::optional<CurveCrossing> found_;
};

}  // namespace

Vec3 CurveSegment::at(float u) const {
    return value(points, u);
}

Vec3 CurveSegment::along(float u) const {
    return derivative(points, u);
}

Vec3 CurveSegment::normal_at(float u) const {
    const float angle = std::acos(std::clamp(dot(normals[0], normals[1]), -1.0f, 1.0f));
    const float sine = std::sin(angle);
    if (!(sine > 1e-4f)) {
        return normals[0];
    }
    return (normals[0] * std::sin((1 - u) * angle) + normals[1] * std::sin(u * angle)) / sine;
}

std::optional<CurveCrossing> next_crossing(const CurveSet& curves, std::uint32_t primitive, const Vec3& origin,
                                           const Vec3& direction, float t_min, float t_max,
                                           const CrossingFilter& accepted) {
    const CurveSegment& segment = curves.segment_of(primitive);
    const Range range(curves, primitive);
    return Search(curves, segment, direction, t_min, t_max, accepted)
        .run(part(segment.points, range.begin, range.end), origin, range);
}

CurvePoint curve_point(const CurveSet& curves, std::uint32_t primitive, float u, float v, const Vec3& direction) {
    const CurveSegment& segment = curves.segment_of(primitive);
    CurvePoint point;
    point.dpdu = segment.along(u);
    if (!(length_squared(point.dpdu) > 0)) {
        point.dpdu = segment.points[3] - segment.points[0];  // two control points coincide
    }
    point.width = segment.width_at(u);
    const Vec3 way = normalize(direction);
    const Vec3 tangent = normalize(point.dpdu);
    if (curves.kind == CurveSet::Kind::ribbon) {
        const Vec3 n = segment.normal_at(u);
        point.width *= std::abs(dot(n, way));
        point.normal = n - tangent * dot(n, tangent);
    } else {
        point.normal = normalize(way - tangent * dot(way, tangent));
        if (curves.kind != CurveSet::Kind::flat) {
            const bool is_tube = curves.kind == CurveSet::Kind::round;
            // All of a tube's point inside, as in its middle.
            const float angle = is_tube ? std::asin(std::clamp(1 - 2 * v, -1.0f, 1.0f)) : (v - 0.5f) * pi;
            point.normal = point.normal * std::cos(angle) + normalize(cross(way, tangent)) * std::sin(angle);
        }
    }
    if (!is_finite(point.normal) || !(length_squared(point.normal) > 0)) {
        point.normal = way;
    }
    return point;
}

Box3 bounds(const CurveSet& curves, std::uint32_t primitive) {
    const CurveSegment& segment = curves.segment_of(primitive);
    const Range range(curves, primitive);
    Box3 box;
    for (const Vec3& p : part(segment.points, range.begin, range.end)) {
        box.extendBy(p);
    }
    const float radius = 0.5f * largest_width(segment, range);
    // Where a tube is met is that far from the point of its axis that tells.
    const Vec3 margin(curves.kind == CurveSet::Kind::round ? radius / steepest : radius);
    return {box.min - margin, box.max + margin};
}

Box3 bounds(const CurveSet& curves) {
    Box3 box;
    for (std::uint32_t i = 0; i < curves.primitive_count(); ++i) {
        box.extendBy(bounds(curves, i));
    }
    return box;
}

}  // namespace wend
