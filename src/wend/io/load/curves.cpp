#include <wend/io/load/curves.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace wend {
namespace {

using Points = std::array<Vec3, 4>;

Vec3 between(const Vec3& a, const Vec3& b, float t) {
    return a + (b - a) * t;
}

/// The cubic curve that is a quadratic one.
Points elevated(const Vec3& a, const Vec3& b, const Vec3& c) {
    return {a, between(a, b, 2.0f / 3), between(c, b, 2.0f / 3), c};
}

/// What is given of all curves of a directive.
struct Layout {
    bool is_spline = false;  ///< a uniform B-spline, not Bezier curves
    std::size_t degree = 3;
    std::size_t segments = 0;
};

Layout load_layout(const pbrt::ParameterSet& p, std::size_t points) {
    Layout layout;
    const int degree = p.get_int("degree", 3);
    if (degree != 2 && degree != 3) {
        throw InputError(p.place_of("degree"), fmt::format("the degree of a curve is 2 or 3, not {}", degree));
    }
    layout.degree = static_cast<std::size_t>(degree);
    const std::string basis = p.get_string("basis", "bezier");
    if (basis != "bezier" && basis != "bspline") {
        throw InputError(p.place_of("basis"),
                         fmt::format("the basis \"{}\" is unknown; known are bezier, bspline", basis));
    }
    layout.is_spline = basis == "bspline";
    // The curves of a Bezier basis share their ends; those of a spline all but one point.
    const bool fits = points > layout.degree && (layout.is_spline || (points - 1) % layout.degree == 0);
    if (!fits) {
        throw InputError(p.place_of("P"), fmt::format("{} points \"P\" make no curve of degree {} in the basis \"{}\"",
                                                      points, degree, basis));
    }
    layout.segments = layout.is_spline ? points - layout.degree : (points - 1) / layout.degree;
    return layout;
}

/// The control points of a segment as those of a cubic Bezier curve.
Points bezier_points(const Layout& layout, const std::vector<Vec3>& points, std::size_t segment) {
    const Vec3* p = &points[layout.is_spline ? segment : segment * layout.degree];
    if (!layout.is_spline) {
        return layout.degree == 2 ? elevated(p[0], p[1], p[2]) : Points{p[0], p[1], p[2], p[3]};
    }
    if (layout.degree == 2) {
        return elevated(between(p[0], p[1], 0.5f), p[1], between(p[1], p[2], 0.5f));
    }
    const Vec3 first = between(p[0], p[1], 2.0f / 3), second = between(p[1], p[2], 1.0f / 3);
    const Vec3 third = between(p[1], p[2], 2.0f / 3), fourth = between(p[2], p[3], 1.0f / 3);
    return {between(first, second, 0.5f), second, third, between(third, fourth, 0.5f)};
}

CurveSet::Kind load_kind(LoadContext& context, const pbrt::ParameterSet& p) {
    const std::string type = p.get_string("type", "flat");
    if (type == "flat") {
        return CurveSet::Kind::flat;
    }
    if (type == "cylinder") {
        return CurveSet::Kind::cylinder;
    }
    if (type == "ribbon") {
        return CurveSet::Kind::ribbon;
    }
    if (type == "round") {
        return CurveSet::Kind::round;
    }
    context.warnings.add(p.place_of("type"),
                         fmt::format("the type of curve \"{}\" is unknown; known are flat, cylinder, "
                                     "ribbon, round: cylinder takes its place, as in pbrt",
                                     type));
    return CurveSet::Kind::cylinder;
}

/// Of ribbons, one at each end of a segment.
std::vector<Vec3> load_normals(LoadContext& context, const pbrt::ShapeEntity& shape, CurveSet::Kind kind,
                               std::size_t segments) {
    const pbrt::ParameterSet& p = shape.parameters;
    std::vector<Vec3> normals = p.get_normal3s("N");
    if (kind != CurveSet::Kind::ribbon) {
        if (!normals.empty()) {
            context.warnings.add(p.place_of("N"), "normals are of use to curves of the type \"ribbon\" only");
        }
        return {};
    }
    if (normals.size() != segments + 1) {
        throw InputError(p.place_of("N"), fmt::format("a ribbon of {} segments needs {} normals \"N\", not {}",
                                                      segments, segments + 1, normals.size()));
    }
    for (Vec3& n : normals) {
        n = shape.world_from_object.normal(n);
        if (!is_finite(n) || !(length_squared(n) > 0)) {
            throw InputError(p.place_of("N"), "a normal of the ribbon has no direction");
        }
        n = normalize(n);
    }
    return normals;
}

}  // namespace

Shape load_curve(LoadContext& context, pbrt::ShapeEntity& shape) {
    const pbrt::ParameterSet& p = shape.parameters;
    std::vector<Vec3> points = p.get_point3s("P");
    const Layout layout = load_layout(p, points.size());
    for (Vec3& point : points) {
        point = shape.world_from_object.point(point);
        if (!is_finite(point)) {
            throw InputError(shape.place, "Shape \"curve\" has a vertex that is not finite");
        }
    }
    const float width = non_negative_float(p, "width", 1);
    const auto scale = static_cast<float>(std::cbrt(std::abs(shape.world_from_object.determinant())));
    const float first = non_negative_float(p, "width0", width) * scale;
    const float last = non_negative_float(p, "width1", width) * scale;
    constexpr int deepest_split = 4;
    CurveSet curves;
    curves.kind = load_kind(context, p);
    curves.pieces = 1u << std::clamp(p.get_int("splitdepth", 3), 0, deepest_split);
    const std::vector<Vec3> normals = load_normals(context, shape, curves.kind, layout.segments);
    const auto width_after = [&](std::size_t segments) {
        return first + (last - first) * static_cast<float>(segments) / static_cast<float>(layout.segments);
    };
    for (std::size_t i = 0; i < layout.segments; ++i) {
        CurveSegment segment;
        segment.points = bezier_points(layout, points, i);
        segment.width = {width_after(i), width_after(i + 1)};
        if (!normals.empty()) {
            segment.normals = {normals[i], normals[i + 1]};
        }
        curves.segments.push_back(segment);
    }
    return curves;
}

bool merge(CurveSet& curves, const CurveSet& more) {
    constexpr std::size_t most_primitives = std::size_t{1} << 30;
    if (curves.kind != more.kind || curves.pieces != more.pieces ||
        curves.primitive_count() + more.primitive_count() > most_primitives) {
        return false;
    }
    curves.segments.insert(curves.segments.end(), more.segments.begin(), more.segments.end());
    return true;
}

}  // namespace wend
