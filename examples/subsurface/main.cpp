// A renderer of your own with Wend's walk inside its dense objects: a ball of coloured wax under a grey sky with a sun.
// Intersection, sky and roulette's dice are written here, as a renderer has them; the walk is drawn to the boundary
// where it entered. docs/subsurface_in_your_renderer.md explains the numbered steps.
#include <wend/subsurface.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

namespace {

using wend::dot, wend::normalize;
using wend::InteriorFlight, wend::InteriorGuide, wend::InteriorWalk, wend::InteriorWalkRecord, wend::TechniqueMix;
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
    Walk(const InteriorGuide& guide, const TechniqueMix& mix, const Ray& ray, wend::Pcg32& random)
        : ray_(ray), random_(random) {
        // 2. At the boundary, going in: enter, aim, head. The mix says how walks that begin here are drawn.
        ray_.origin = ray.at(intersect(ray)->x);
        const Vec3 normal = normalize(ray_.origin);
        record_.entry = ray_.origin;
        record_.guided = !(random_.uniform() < mix.unguided_probability);
        next_event_ = record_.guided ? mix.guided : mix.unguided;
        interior_.enter(guide, Rgb(1.0f / 3), record_.guided ? mix.defensive_fraction : 1);
        interior_.aim(normal);
        interior_.head(ray_.direction);
    }

    Rgb run() {
        while (step()) {
        }
        return radiance_;
    }

    /// 7. What the walk found, to learn the mix from.
    const InteriorWalkRecord& record() const { return record_; }

private:
    bool step() {
        // 3. Fly to the next collision or to the boundary.
        const InteriorFlight step = interior_.fly(distance_to_exit(ray_), interior_.draw_distance(random_.uniform()));
        throughput_ *= step.flight.weight;
        ++record_.flights;
        record_.relative = interior_.relative_densities();
        if (!step.flight.scatters) {
            leave(step.pass_probability);
            return false;
        }
        // 4. Scatter: draw a direction, and tell the walk.
        const Vec3 position = ray_.at(step.flight.distance);
        const InteriorWalk::Directions directions(interior_, ray_.direction, random_);
        if (random_.uniform() < next_event_.probability) {
            connect(directions, position);
        }
        at_collision_ = interior_.relative_densities();
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
        gather(throughput_ * sky_radiance, {record_.relative, 0});
        if (is_in_sun(ray_.direction)) {
            // Not connected if the ray went through without a collision.
            const float connections = interior_.has_turned() ? next_event_.probability * sun_density : 0.0f;
            const float own = interior_.has_turned() ? next_event_.preference * density_ * pass_probability : 1.0f;
            const float by_connections = connections / (own + connections);
            gather(throughput_ * sun_radiance * (1 - by_connections),
                   wend::gradient_of_hit(at_collision_, record_.relative, by_connections));
        }
    }

    /// 6. Next-event estimation: what a straight line from a collision to the sun brings, with the balance heuristic
    /// against the walk that might have gone the same way.
    void connect(const InteriorWalk::Directions& directions, const Vec3& position) {
        const Vec3 w = sun.to_world(wend::to_cone(random_.uniform2(), sun_width));
        const float length = distance_to_exit({position, w});
        InteriorWalk there = interior_;
        there.turn(directions, w);
        const float own = next_event_.preference * directions.density(w) * there.pass(length);
        const float connections = next_event_.probability * sun_density;
        const Rgb transmittance = wend::exp(wax.extinction() * -length);
        const Rgb arriving = transmittance * sun_radiance * (1 / (own + connections));
        record_.connected = true;
        gather(throughput_ * wax.phase.evaluate(dot(ray_.direction, w)) * arriving,
               wend::gradient_of_connection(interior_.relative_densities(), there.relative_densities(),
                                            connections / (own + connections)));
    }

    void gather(const Rgb& light, const wend::MixGradient& gradient) {
        radiance_ += light;
        record_.bring(wend::mean_value(light), gradient);
    }

    Ray ray_;
    wend::Pcg32& random_;
    InteriorWalk interior_;
    wend::NextEventSettings next_event_;
    InteriorWalkRecord record_;
    InteriorGuide::PerTechnique at_collision_{};
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

constexpr Ray ray{{0.3f, 0.2f, -3}, {0, 0, 1}};

/// Radiance along one ray, by channel.
Measured measure(const InteriorGuide& guide, const TechniqueMix& mix, int walks) {
    Measured radiance;
    wend::Pcg32 random(1);
    for (int i = 0; i < walks; ++i) {
        const Rgb sample = Walk(guide, mix, ray, random).run();
        for (int c = 0; c < 3; ++c) {
            radiance[static_cast<std::size_t>(c)].add(sample[c]);
        }
    }
    return radiance;
}

/// The mix that walks along that ray teach, in a few rounds.
TechniqueMix learn(const InteriorGuide& guide) {
    constexpr int rounds = 8, walks = 4000;
    wend::TechniqueMixes mixes({Vec3(-1), Vec3(1)}, guide.defensive_fraction);
    const int cell = mixes.cell_at(ray.at(intersect(ray)->x));
    wend::Pcg32 random(2);
    for (int round = 0; round < rounds; ++round) {
        std::vector<InteriorWalkRecord> records;
        for (int i = 0; i < walks; ++i) {
            Walk walk(guide, mixes.plan(cell), ray, random);
            walk.run();
            records.push_back(walk.record());
        }
        mixes.learn_from(records, round + 1 < rounds ? wend::NextWalks::beside_classical : wend::NextWalks::rendering);
    }
    return mixes.plan(cell);
}

}  // namespace

int main() {
    // 1. Once a medium: solve for its modes.
    constexpr int walks = 100000;
    const InteriorGuide guide = wend::interior_guide(wax, wend::half_space_modes(wax));
    const Measured classical = measure(guide, {.defensive_fraction = 1}, walks);
    const Measured guided = measure(guide, {.defensive_fraction = guide.defensive_fraction}, walks);
    const TechniqueMix mix = learn(guide);
    const Measured learned = measure(guide, mix, walks);

    // A renderer that embeds a guide does well to test the same: no bias, and less noise in as many samples.
    bool agrees = true;
    std::printf("         classical            guided               variance  learned              variance\n");
    for (std::size_t c = 0; c < 3; ++c) {
        const auto column = [&](const Moments& m) {
            const double error = std::hypot(classical[c].standard_error(), m.standard_error());
            agrees = agrees && std::abs(classical[c].mean() - m.mean()) < 4 * error;
            std::printf("  %.5f +- %.5f", m.mean(), m.standard_error());
        };
        std::printf("%-6s", std::array{"red", "green", "blue"}[c]);
        column(classical[c]);
        column(guided[c]);
        std::printf("   1 / %.1f", classical[c].variance() / guided[c].variance());
        column(learned[c]);
        std::printf("   1 / %.1f\n", classical[c].variance() / learned[c].variance());
    }
    std::printf("learned: %.0f %% of the walks classical, connections with probability %.2f\n",
                100 * static_cast<double>(mix.defensive_fraction), static_cast<double>(mix.guided.probability));
    return agrees ? 0 : 1;
}
