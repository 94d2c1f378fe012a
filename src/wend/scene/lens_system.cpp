#include <wend/scene/lens_system.h>

#include <wend/scene/picture_lookup.h>

#include <Imath/ImathBox.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace wend {
namespace {

/// Pupils that are known, from the axis to the edge of the film.
constexpr int known_pupils = 64;

Imath::V3d refracted(const Imath::V3d& direction, const Imath::V3d& normal, double index, bool& is_reflected) {
    const double cosine = -direction.dot(normal);
    const double sine2 = (1 - cosine * cosine) / (index * index);
    is_reflected = sine2 >= 1;
    return is_reflected ? direction : direction / index + normal * (cosine / index - std::sqrt(1 - sine2));
}

/// To the surface of a ball around the axis, the near or the far side as the cap at `z` asks; none if it is missed.
std::optional<double> distance_to_cap(const LensSurface& surface, double z, const Imath::V3d& origin,
                                      const Imath::V3d& direction) {
    // The middle of the ball is towards the film where the cap bulges towards the scene.
    const Imath::V3d from_middle = origin - Imath::V3d(0, 0, z - surface.radius);
    const double half = from_middle.dot(direction);
    const double root2 = half * half - from_middle.length2() + surface.radius * surface.radius;
    if (root2 < 0) {
        return std::nullopt;
    }
    const bool is_near_side = (direction.z < 0) == (surface.radius > 0);
    const double t = is_near_side ? -half - std::sqrt(root2) : -half + std::sqrt(root2);
    return t >= 0 ? std::optional(t) : std::nullopt;
}

/// Where a line before or behind lenses crosses a height over the axis, and the axis.
struct CardinalPoints {
    double principal, focal;
};

CardinalPoints cardinal_points(double height, const Imath::V3d& origin, const Imath::V3d& direction) {
    return {origin.z + direction.z * (height - origin.x) / direction.x,
            origin.z - direction.z * origin.x / direction.x};
}

}  // namespace

LensSystem::LensSystem(std::vector<LensSurface> surfaces, double focus_distance, double film_radius, Image stop)
    : surfaces_(std::move(surfaces)), stop_(std::move(stop)), film_radius_(film_radius) {
    focus(focus_distance, film_radius);
    for (int i = 0; i < known_pupils; ++i) {
        pupils_.push_back(find_pupil(film_radius * i / known_pupils, film_radius * (i + 1) / known_pupils));
    }
}

double LensSystem::front() const {
    double z = 0;
    for (const LensSurface& surface : surfaces_) {
        z += surface.thickness;
    }
    return z;
}

bool LensSystem::pass(const LensSurface& surface, double z, double index, Line& line) const {
    const bool is_stop = surface.radius == 0;
    const std::optional<double> t = is_stop ? std::optional((z - line.origin.z) / line.direction.z)
                                            : distance_to_cap(surface, z, line.origin, line.direction);
    if (!t || !(*t >= 0)) {
        return false;
    }
    line.origin += line.direction * *t;
    if (is_stop) {
        return true;
    }
    if (line.origin.x * line.origin.x + line.origin.y * line.origin.y > surface.aperture * surface.aperture) {
        return false;
    }
    Imath::V3d normal = (line.origin - Imath::V3d(0, 0, z - surface.radius)) / surface.radius;
    normal = normal.dot(line.direction) > 0 ? -normal : normal;
    bool is_reflected = false;
    line.direction = refracted(line.direction, normal, index, is_reflected).normalized();
    return !is_reflected;
}

std::optional<LensSystem::Line> LensSystem::to_scene(Line line, double* weight) const {
    double z = 0;
    for (std::size_t i = surfaces_.size(); i-- > 0;) {
        const LensSurface& surface = surfaces_[i];
        z += surface.thickness;
        const double beyond = i > 0 ? surfaces_[i - 1].index : 1.0;
        if (!pass(surface, z, beyond / surface.index, line)) {
            return std::nullopt;
        }
        if (surface.radius == 0 && weight) {
            *weight *= let_through(surface, line.origin);
            if (!(*weight > 0)) {
                return std::nullopt;
            }
        }
    }
    return line;
}

std::optional<LensSystem::Line> LensSystem::to_film(Line line) const {
    double z = front();
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
        const LensSurface& surface = surfaces_[i];
        const double before = i > 0 ? surfaces_[i - 1].index : 1.0;
        if (!pass(surface, z, surface.index / before, line)) {
            return std::nullopt;
        }
        z -= surface.thickness;
    }
    return line;
}

double LensSystem::let_through(const LensSurface& stop, const Imath::V3d& at) const {
    const double x = at.x / stop.aperture, y = at.y / stop.aperture;
    if (stop_.pixels.empty()) {
        return x * x + y * y <= 1 ? 1.0 : 0.0;
    }
    if (std::max(std::abs(x), std::abs(y)) > 1) {
        return 0;
    }
    const auto pixel = [this](int i, int j) {
        return i < 0 || j < 0 || i >= stop_.width || j >= stop_.height ? Rgb(0.0f) : stop_.at(i, j);
    };
    const Vec2 place(static_cast<float>((x + 1) / 2 * stop_.width), static_cast<float>((1 - y) / 2 * stop_.height));
    return static_cast<double>(mean(bilinear(place, pixel)));
}

/// By the cardinal points of rays near the axis: as a thick lens (kolb1995).
void LensSystem::focus(double distance, double film_radius) {
    // Much less than the radius of any lens, and much more than rounding.
    const double height = film_radius * 2e-3;
    const auto from_scene = to_film({{height, 0, front() + 1}, {0, 0, -1}});
    const auto from_film = to_scene({{height, 0, back_focus() - 1}, {0, 0, 1}}, nullptr);
    if (!from_scene || !from_film) {
        throw std::domain_error("no ray along the axis gets through the lenses");
    }
    const CardinalPoints behind = cardinal_points(height, from_scene->origin, from_scene->direction);
    const CardinalPoints before = cardinal_points(height, from_film->origin, from_film->direction);
    const double focal_length = behind.principal - behind.focal;
    if (!(focal_length > 0) || !std::isfinite(focal_length)) {
        throw std::domain_error("the lenses do not collect light");
    }
    // Of a thick lens: 1/s + 1/s' = 1/f, where s and s' begin at the principal planes and the lens moves by `by`.
    const double between = before.principal - behind.principal;
    const double whole = distance - between;
    const double c = whole * (whole - 4 * focal_length);
    if (!(c > 0)) {
        throw std::domain_error("so near, nothing is in focus: the distance must be larger than four focal lengths");
    }
    const double image_distance = (whole - std::sqrt(c)) / 2;
    surfaces_.back().thickness += image_distance - behind.principal;
    if (!(surfaces_.back().thickness > 0)) {
        throw std::domain_error("in focus, the lenses would touch the film");
    }
}

LensSystem::Pupil LensSystem::find_pupil(double film_min, double film_max) const {
    constexpr int side = 64, film_points = 3, rounds = 2;
    const double rear = back_focus(), reach = 1.5 * surfaces_.back().aperture;
    Imath::Box2d bounds(Imath::V2d(-reach), Imath::V2d(reach));
    // First all around the last lens, then again within what was found there.
    for (int round = 0; round < rounds; ++round) {
        const Imath::V2d step = bounds.size() / side;
        Imath::Box2d found;
        for (int i = 0; i < film_points; ++i) {
            const Imath::V3d film(film_min + (film_max - film_min) * i / (film_points - 1), 0, 0);
            for (int k = 0; k < side * side; ++k) {
                const Imath::V2d at = bounds.min + step * Imath::V2d(k % side + 0.5, k / side + 0.5);
                double weight = 1;
                if (!found.intersects(at) &&
                    to_scene({film, (Imath::V3d(at.x, at.y, rear) - film).normalized()}, &weight)) {
                    found.extendBy(at);
                }
            }
        }
        if (found.isEmpty()) {
            break;
        }
        bounds = Imath::Box2d(found.min - step * 2.0, found.max + step * 2.0);
    }
    return {Vec2(bounds.min), Vec2(bounds.max)};
}

std::optional<LensSystem::Sample> LensSystem::sample(const Vec2& film, const Vec2& lens) const {
    const float radius = std::sqrt(film.x * film.x + film.y * film.y);
    const auto index = static_cast<std::size_t>(radius / static_cast<float>(film_radius_) * known_pupils);
    const Pupil& pupil = pupils_[std::min(index, pupils_.size() - 1)];
    const Vec2 size = pupil.max - pupil.min;
    const Vec2 on_axis = pupil.min + size * lens;
    // The pupil of a point on the x axis turns with the point.
    const float cosine = radius > 0 ? film.x / radius : 1.0f, sine = radius > 0 ? film.y / radius : 0.0f;
    const Imath::V3d from(double{film.x}, double{film.y}, 0);
    const Imath::V3d rear(double{cosine * on_axis.x - sine * on_axis.y}, double{sine * on_axis.x + cosine * on_axis.y},
                          back_focus());
    const Imath::V3d direction = (rear - from).normalized();
    double weight = 1;
    const auto line = to_scene({from, direction}, &weight);
    if (!line) {
        return std::nullopt;
    }
    const double area = double{size.x} * double{size.y};
    weight *= std::pow(direction.z, 4) * area / (back_focus() * back_focus());
    return Sample{{Vec3(line->origin), Vec3(line->direction)}, static_cast<float>(weight)};
}

}  // namespace wend
