// A renderer of your own with Wend's walk inside its dense objects: a ball of coloured wax under a grey sky with a sun.
// Intersection, sky and roulette's dice are written here, as a renderer has them; the walk is drawn to the boundary
// where it entered. docs/subsurface_in_your_renderer.md explains the numbered steps.
#include <wend/subsurface.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

namespace {

using wend::dot, wend::normalize;
using wend::InteriorFlight, wend::InteriorGuide, wend::InteriorWalk;
using wend::Ray, wend::Rgb, wend::Vec2, wend::Vec3;

// ---- The scene: a ball of radius 1 around the origin, which does not refract, and light from everywhere ----

/// Coefficients per unit of length: the ball is 200 mean free paths wide.
const wend::HomogeneousMedium wax{
    .absorption = {2.5f, 5, 10},
    .scattering = {97.5f, 95, 90},
    .emission = {},
    .phase = wend::PhaseFunction(wend::HenyeyGreenstein{0.5f}),
};

/// Distances at which the line through the ball enters and leaves it.
std::optional<Vec2> intersect(const Ray& ray) {
    const float middle = -dot(ray.origin, ray.direction);
    const Vec3 closest = ray.at(middle);
    const float square = 1 - dot(closest, closest);
    return square > 0 ? std::optional(Vec2(middle - std::sqrt(square), middle + std::sqrt(square))) : std::nullopt;
}
float distance_to_exit(const Ray& ray) {
    const std::optional<Vec2> line = intersect(ray);
    return line ? std::max(line->y, 0.0f) : 0.0f;  // rounding may put a collision just outside
}

const wend::Frame sun = wend::Frame::from_z(normalize(Vec3(0.3f, 0.6f, -0.7f)));
constexpr float sun_width = 0.03f;  ///< 1 - cosine of its radius: 14 degrees
const float sun_density = wend::cone_density(sun_width);
const Rgb sun_radiance(12, 10, 8);
const Rgb sky_radiance(1);
bool is_in_sun(const Vec3& w) {
    return dot(w, sun.n) > 1 - sun_width;
}

// ---- The walk ----

/// Light that arrives along a ray that hits the ball, by a random walk through it.
class Walk {
public:
    Walk(const InteriorGuide& guide, const Ray& ray, wend::Pcg32& random) : ray_(ray), random_(random) {
        // 2. At the boundary, going in: enter, aim, head.
        ray_.origin = ray.at(intersect(ray)->x);
        const Vec3 normal = normalize(ray_.origin);
        interior_.enter(guide, Rgb(1.0f / 3));
        interior_.aim(normal);
        interior_.head(ray_.direction);
    }

    Rgb run() {
        while (step()) {
        }
        return radiance_;
    }

private:
    bool step() {
        // 3. Fly to the next collision or to the boundary.
        const InteriorFlight step = interior_.fly(distance_to_exit(ray_), interior_.draw_distance(random_.uniform()));
        throughput_ *= step.flight.weight;
        if (!step.flight.scatters) {
            leave(step.pass_probability);
            return false;
        }
        // 4. Scatter: draw a direction, and tell the walk.
        const Vec3 position = ray_.at(step.flight.distance);
        const InteriorWalk::Directions directions(interior_, ray_.direction, random_);
        radiance_ += throughput_ * connect(directions, position);
        const float u = random_.uniform();
        const auto s = directions.sample(u, random_.uniform2());
        throughput_ *= s->weight();
        interior_.turn(directions, s->direction);
        ray_ = {position, s->direction};
        density_ = s->density;
        // 5. Survive.
        const float survival = interior_.survival(wend::max_value(throughput_));
        if (random_.uniform() >= survival) {
            return false;
        }
        throughput_ *= 1 / survival;
        return true;
    }

    /// Out of the ball, straight on: the sky, and the sun where connections have left it.
    void leave(float pass_probability) {
        radiance_ += throughput_ * sky_radiance;
        if (is_in_sun(ray_.direction)) {
            const bool connected = interior_.has_turned();  // not if the ray went through without a collision
            const float own = density_ * pass_probability;
            radiance_ += throughput_ * sun_radiance * (connected ? own / (own + sun_density) : 1.0f);
        }
    }

    /// 6. Next-event estimation: what a straight line from a collision to the sun brings, with the balance heuristic
    /// against the walk that might have gone the same way.
    Rgb connect(const InteriorWalk::Directions& directions, const Vec3& position) {
        const Vec3 w = sun.to_world(wend::to_cone(random_.uniform2(), sun_width));
        const float length = distance_to_exit({position, w});
        InteriorWalk there = interior_;
        there.turn(directions, w);
        const float own = directions.density(w) * there.pass(length);
        const Rgb transmittance = wend::exp(wax.extinction() * -length);
        return wax.phase.evaluate(dot(ray_.direction, w)) * transmittance * sun_radiance * (1 / (own + sun_density));
    }

    Ray ray_;
    wend::Pcg32& random_;
    InteriorWalk interior_;
    Rgb throughput_{1}, radiance_;
    float density_ = 0;  ///< of the direction drawn last
};

// ---- The test ----

/// Mean and variance of a stream of values.
class Moments {
public:
    void add(double value) {
        const double before = value - mean_;
        mean_ += before / static_cast<double>(++count_);
        squares_ += before * (value - mean_);
    }
    double mean() const { return mean_; }
    double variance() const { return count_ > 1 ? squares_ / static_cast<double>(count_ - 1) : 0; }
    double standard_error() const { return std::sqrt(variance() / static_cast<double>(count_)); }

private:
    long count_ = 0;
    double mean_ = 0, squares_ = 0;
};

using Measured = std::array<Moments, 3>;

/// Radiance along one ray, by channel.
Measured measure(const InteriorGuide& guide, int walks) {
    const Ray ray{{0.3f, 0.2f, -3}, {0, 0, 1}};
    Measured radiance;
    wend::Pcg32 random(1);
    for (int i = 0; i < walks; ++i) {
        const Rgb sample = Walk(guide, ray, random).run();
        for (int c = 0; c < 3; ++c) {
            radiance[static_cast<std::size_t>(c)].add(sample[c]);
        }
    }
    return radiance;
}

}  // namespace

int main() {
    // 1. Once a medium: solve for its modes, and say how often walks are classical all the same.
    constexpr int walks = 100000;
    const auto modes = wend::half_space_modes(wax);
    const Measured classical = measure(wend::interior_guide(wax, modes, 1), walks);
    const Measured guided = measure(wend::interior_guide(wax, modes, 0.25f), walks);

    // A renderer that embeds a guide does well to test the same: no bias, and less noise in as many samples.
    bool agrees = true;
    std::printf("         classical            guided               variance\n");
    for (std::size_t c = 0; c < 3; ++c) {
        const Moments &a = classical[c], &b = guided[c];
        const double error = std::hypot(a.standard_error(), b.standard_error());
        std::printf("%-6s  %.5f +- %.5f  %.5f +- %.5f   1 / %.1f\n", std::array{"red", "green", "blue"}[c], a.mean(),
                    a.standard_error(), b.mean(), b.standard_error(), a.variance() / b.variance());
        agrees = agrees && std::abs(a.mean() - b.mean()) < 4 * error;
    }
    return agrees ? 0 : 1;
}
