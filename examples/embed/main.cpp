// A renderer of your own with Wend as its library: a ball of fog under a sky that is dark but for one bright patch. The
// walk is written here; Wend learns where the light comes from, and chooses directions.
#include <wend/core/random.h>
#include <wend/decision/direction.h>
#include <wend/guide/field.h>
#include <wend/guide/fit.h>
#include <wend/guide/records.h>
#include <wend/medium/phase.h>
#include <wend/stats/moments.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <vector>

namespace {

using wend::dot;
using wend::Rgb;
using wend::Vec2;
using wend::Vec3;

// The ball has radius 1 and its centre in the origin.
constexpr float extinction = 3;
constexpr float albedo = 0.95f;
const wend::PhaseFunction phase(wend::HenyeyGreenstein{0.4f});

float sky(const Vec3& direction) {
    return direction.z > 0.98f ? 100.0f : 0.1f;
}

/// What scatters at a collision, as Wend's decisions want it: the phase function with the direction of arrival.
class Collision {
public:
    explicit Collision(const Vec3& before) : before_(before) {}

    Rgb evaluate(const Vec3& w) const { return Rgb(density(w)); }
    float density(const Vec3& w) const { return phase.evaluate(dot(before_, w)); }
    std::optional<wend::DirectionSample> sample(float, const Vec2& u) const {
        const Vec3 w = phase.sample(before_, u);
        return wend::DirectionSample{w, Rgb(density(w)), density(w)};
    }
    wend::AxialLobes lobes() const { return phase.lobes(before_); }
    bool is_specular() const { return false; }
    bool is_guidable() const { return true; }

private:
    Vec3 before_;
};

/// Distance along a ray to the ball's surface from inside.
float distance_to_surface(const Vec3& p, const Vec3& w) {
    const float b = dot(p, w);
    return -b + wend::safe_sqrt(b * b - dot(p, p) + 1);
}

/// The radiance that one walk brings back; what it learned on the way goes to `records`.
template <class Directions>
float walk(const Directions& directions, wend::Pcg32& random, wend::guide::Records* records) {
    Vec3 position(-1, 0, 0);
    Vec3 direction(1, 0, 0);
    float weight = 1;
    std::vector<float> weights;
    const std::size_t first = records ? records->size() : 0;
    for (;;) {
        const float surface = distance_to_surface(position, direction);
        const float distance = wend::to_exponential(random.uniform(), extinction);
        if (records && !weights.empty()) {
            records->back().distance = std::min(distance, surface);
        }
        if (distance >= surface) {
            break;
        }
        position += direction * distance;
        if (random.uniform() >= albedo) {
            return 0;  // absorbed: its records say that nothing came back
        }
        const Collision collision(direction);
        const float u = random.uniform();
        const auto sample = directions.at(position, true, collision).sample(u, random.uniform2());
        if (!sample) {
            return 0;
        }
        weight *= sample->weight().r;
        direction = sample->direction;
        weights.push_back(weight);
        if (records) {
            records->push_back({position, direction, 0, sample->density, 1});
        }
    }
    const float radiance = weight * sky(direction);
    for (std::size_t i = 0; records && i < weights.size(); ++i) {
        (*records)[first + i].radiance = radiance / weights[i];
    }
    return radiance;
}

template <class Directions>
wend::Moments measure(const Directions& directions, std::uint64_t seed, int walks, wend::guide::Records* records) {
    wend::Moments radiance;
    for (int i = 0; i < walks; ++i) {
        wend::Pcg32 random(wend::hash_of(seed, i));
        radiance.add(walk(directions, random, records));
    }
    return radiance;
}

}  // namespace

int main() {
    constexpr int walks = 200000;
    const wend::Moments classical = measure(wend::ClassicalDirection(), 1, walks, nullptr);

    // Learn in passes: each walks with what the last one learned.
    auto field = wend::guide::Field::empty(wend::Box3(Vec3(-1), Vec3(1)));
    for (std::uint64_t pass = 0; pass < 5; ++pass) {
        wend::guide::Records records;
        const wend::GuidedDirection<wend::guide::Field> directions(&field, &field, 0.5f);
        measure(directions, 10 + pass, 10000 << pass, &records);
        field = wend::guide::fit(field, records, {}, 1).field;
    }
    const wend::GuidedDirection<wend::guide::Field> directions(&field, &field, 0.5f);
    const wend::Moments guided = measure(directions, 2, walks, nullptr);

    std::printf("classical %.4f +- %.4f\nguided    %.4f +- %.4f\nvariance  %.2f times less\n", classical.mean(),
                classical.standard_error(), guided.mean(), guided.standard_error(),
                classical.variance() / guided.variance());
    const double error = std::hypot(classical.standard_error(), guided.standard_error());
    return std::abs(classical.mean() - guided.mean()) < 4 * error && guided.variance() < classical.variance() ? 0 : 1;
}
