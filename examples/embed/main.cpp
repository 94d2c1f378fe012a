// A renderer of your own with Wend as its library: two foggy rooms joined by a door, the lamps in the far one. Rays,
// surfaces and lights are written here, as a renderer has them; Wend learns where light comes from. It chooses how far
// walks fly, which way they scatter, which lamp they are connected to, and which of them go on or are split. The
// numbered comments are the steps of embedding it.
#include <tbb/parallel_for.h>
#include <wend/guide.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace {

using wend::dot, wend::length, wend::normalize, wend::mean_value;
using wend::Rgb, wend::Vec2, wend::Vec3;
using wend::guide::Field, wend::guide::PathLog, wend::guide::PathRecords;

// ---- The scene: rectangles across an axis, and fog everywhere ----

struct Wall {
    int axis;
    float at;
    Vec2 min, max;  ///< along the next two axes
    Rgb albedo;
    int lamp = -1;      ///< which, if it is one
    float shines = -1;  ///< along the axis: on this side
    Rgb radiance{0.0f};

    float area() const { return (max.x - min.x) * (max.y - min.y); }
};

const Rgb white(0.75f), red(0.6f, 0.2f, 0.15f), black(0.0f);
const std::array<Wall, 11> walls = {{
    {0, 0, {0, 0}, {2.5f, 4}, red},
    {0, 6, {0, 0}, {2.5f, 4}, white},
    {1, 0, {0, 0}, {4, 6}, white},
    {1, 2.5f, {0, 0}, {4, 6}, white},
    {2, 0, {0, 0}, {6, 2.5f}, white},
    {2, 4, {0, 0}, {6, 2.5f}, white},
    // The wall between the rooms, around a door.
    {0, 3, {0, 0}, {2.5f, 0.3f}, white},
    {0, 3, {0, 0.7f}, {2.5f, 4}, white},
    {0, 3, {2, 0.3f}, {2.5f, 0.7f}, white},
    // One lamp shines towards the door, a stronger one from the wall between the rooms, where nobody sees it.
    {0, 5.99f, {0.8f, 0.2f}, {1.6f, 0.8f}, black, 0, -1, {15, 13, 10}},
    {0, 3.01f, {1, 2}, {2, 3.5f}, black, 1, 1, {8, 9, 12}},
}};
const std::array<const Wall*, 2> lamps = {&walls[9], &walls[10]};
const wend::PhaseFunction fog_phase(wend::HenyeyGreenstein{0.6f});
const wend::HomogeneousMedium fog{Rgb(0.01f), Rgb(0.19f), black, fog_phase};
const float extinction = 0.2f;
const wend::Box3 bounds(Vec3(0, 0, 0), Vec3(6, 2.5f, 4));

struct Hit {
    const Wall* wall = nullptr;
    float distance = INFINITY;
    Vec3 normal;  ///< towards where the ray came from
};
Hit intersect(const Vec3& origin, const Vec3& direction) {
    Hit nearest;
    for (const Wall& wall : walls) {
        const float distance = (wall.at - origin[wall.axis]) / direction[wall.axis];
        const Vec3 p = origin + direction * distance;
        const Vec2 q(p[(wall.axis + 1) % 3], p[(wall.axis + 2) % 3]);
        if (distance > 1e-5f && distance < nearest.distance && Imath::Box2f(wall.min, wall.max).intersects(q)) {
            nearest = {&wall, distance, Vec3(0, 0, 0)};
            nearest.normal[wall.axis] = direction[wall.axis] > 0 ? -1.0f : 1.0f;
        }
    }
    return nearest;
}

/// Of choosing a direction by choosing a point of a lamp, per steradian; 0 on its dark side.
float emitter_density(const Wall& lamp, const Vec3& direction, float distance) {
    const float cosine = -lamp.shines * direction[lamp.axis];
    return cosine > 0 ? distance * distance / (cosine * lamp.area()) : 0.0f;
}

/// Which lamp is connected to, as long as nothing is learned: by power. (wend::LightChoice)
const wend::WeightedLights by_power({mean_value(lamps[0]->radiance) * lamps[0]->area(),
                                     mean_value(lamps[1]->radiance) * lamps[1]->area()});

// ---- 1. Tell Wend how things scatter: any class with these functions will do (wend::ScatteringFunction) ----

/// A matt surface. Its lobes are what the guide multiplies incident radiance with. (Fog: wend::VolumeScattering.)
struct Matt {
    static constexpr bool in_volume = false;
    Rgb reflectance;
    Vec3 normal;

    Rgb albedo() const { return reflectance; }
    Rgb evaluate(const Vec3& w) const { return reflectance * density(w); }
    float density(const Vec3& w) const { return std::max(0.0f, dot(normal, w)) * wend::inv_pi; }
    std::optional<wend::DirectionSample> sample(float, const Vec2& u) const {
        const Vec3 w = wend::Frame::from_z(normal).to_world(wend::to_cosine_hemisphere(u));
        // Along the surface, where rounding may put it, a direction carries nothing.
        return density(w) > 0 ? std::optional(wend::DirectionSample{w, evaluate(w), density(w)}) : std::nullopt;
    }
    wend::AxialLobes lobes() const { return wend::AxialLobes::cosine().around(normal); }
    bool is_specular() const { return false; }
    bool is_guidable() const { return true; }
};

// ---- 2. Walk, let decisions choose, and tell the log what happens ----

/// What a walk asks, classical or guided: it cannot tell which.
template <class Distances, class Directions, class Survival>
struct Decisions {
    Distances distances;
    Directions directions;
    Survival survival;
    const wend::LearnedLights& lights;
};

/// What walks tell: records for the fields, and what connections brought.
struct Told {
    PathLog log;  ///< of one walk
    PathRecords records;
    std::vector<wend::LightRecord> lights;
};

/// One walk from the camera, with all its branches.
template <class Decisions>
class Walk {
public:
    /// `expected`: what the pixel will be, as far as is known; 0: not at all.
    Walk(const Decisions& d, float expected, wend::Pcg32& random, Told& told)
        : d_(d), expected_(expected), random_(random), log_(told.log), told_(told) {}

    Rgb run(const Vec3& origin, const Vec3& direction) {
        log_.start();
        pending_.emplace_back().ray = {origin, direction};
        while (!pending_.empty()) {
            now_ = pending_.back();
            pending_.pop_back();
            log_.resume(now_.logged);
            while (fly()) {
            }
        }
        return radiance_;
    }

private:
    /// Where a branch of the walk is.
    struct State {
        wend::Ray ray;
        Rgb throughput{1.0f};
        wend::LightReceiver last;  ///< where the direction was drawn
        float density = 0;         ///< of the direction
        float ratio = 1;  ///< how much likelier the walk is for being guided: roulette must not end it for that
        float copies = 1;
        int depth = 0;
        PathLog::Branch logged{};  ///< where the log goes on
    };

    /// Radiance of a lamp that is met, weighted against connect(), which might have found it (balance heuristic).
    Rgb met(const Hit& hit) const {
        const float point = hit.wall->lamp < 0 ? 0 : emitter_density(*hit.wall, now_.ray.direction, hit.distance);
        if (point == 0 || now_.depth == 0) {
            return point > 0 ? hit.wall->radiance : black;
        }
        const float own = now_.density * std::exp(-extinction * hit.distance);
        const float other = d_.lights.probability(by_power, now_.last, hit.wall->lamp) * point;
        return hit.wall->radiance * (own / (own + other));
    }

    /// To the next collision or surface; false where the branch ends.
    bool fly() {
        const Hit hit = intersect(now_.ray.origin, now_.ray.direction);
        if (!hit.wall) {
            return false;  // out through an edge, where rounding leaves a gap
        }
        const Vec3 there = now_.ray.at(hit.distance);
        const Rgb light = met(hit);
        const wend::FlightEnd end{wend::FlightEnd::Kind::surface, there, hit.normal, mean_value(light)};
        const wend::FlightStart start{now_.ray, hit.distance, now_.throughput, mean_value(now_.throughput), end, {}};
        // These rays are cheap, and a guided flight costs five of them. The first flights are worth it.
        const wend::Flight flight =
            now_.depth < 2 ? d_.distances.sample(fog, start, random_) : classical_flights_.sample(fog, start, random_);
        weigh(flight.weight);
        now_.ratio *= flight.density_ratio;
        log_.meet(flight.scatters ? flight.distance : hit.distance);
        if (flight.scatters) {
            const Vec3 p = now_.ray.at(flight.distance);
            return scatter(wend::VolumeScattering(fog_phase, now_.ray.direction), {p, {0, 0, 0}}, p);
        }
        gather(light);
        if (hit.wall->lamp >= 0) {
            return false;
        }
        log_.face(hit.normal);
        return scatter(Matt{hit.wall->albedo, hit.normal}, {there, hit.normal}, there + hit.normal * 1e-4f);
    }

    /// Connects to a lamp, and decides how many directions to draw; several are branches of their own.
    template <class F>
    bool scatter(const F& f, const wend::LightReceiver& here, const Vec3& position) {
        ++now_.depth;
        const auto directions = d_.directions.at(position, f, mean_value(now_.throughput));
        connect(f, directions, here);
        const auto ahead = wend::ExpectedContribution::at(directions, f.albedo(), now_.throughput, expected_,
                                                          static_cast<int>(64 / now_.copies) + 1);
        const auto outcome = d_.survival.before_direction(ahead, random_);
        if (!outcome) {
            return draw(directions, here, position) && survives();
        }
        const auto expected = static_cast<float>(outcome->expected);
        weigh(Rgb(1 / expected));
        now_.ratio *= expected;
        now_.copies *= std::max(1.0f, expected);
        for (int i = 0; i < outcome->copies; ++i) {
            const State before = now_;
            const PathLog::Branch logged = log_.branch();
            if (draw(directions, here, position)) {
                now_.logged = log_.branch();
                pending_.push_back(now_);
            }
            now_ = before;
            log_.resume(logged);
        }
        return false;  // they are all pending
    }

    template <class Distribution>
    bool draw(const Distribution& directions, const wend::LightReceiver& here, const Vec3& position) {
        const auto s = directions.sample(random_);
        if (!s) {
            return false;
        }
        // The weight is the scattering function over the density that was used, so no field can bias the picture.
        now_.throughput *= s->weight();
        log_.scatter(here.position, *s, here.in_volume());
        now_.ratio *= s->density_ratio;
        now_.ray = {position, s->direction};
        now_.last = here;
        now_.density = s->density;
        return true;
    }

    /// Next-event estimation. Directions could have found the lamp as well: the balance heuristic asks their density.
    template <class F, class Distribution>
    void connect(const F& f, const Distribution& directions, const wend::LightReceiver& here) {
        const wend::ChosenLight chosen = d_.lights.sample(by_power, here, random_.uniform());
        const Wall& lamp = *lamps[static_cast<std::size_t>(chosen.index)];
        const Vec2 q = lamp.min + random_.uniform2() * (lamp.max - lamp.min);
        const Vec3 to_lamp = Vec3(lamp.at, q.x, q.y) - here.position;
        const float distance = length(to_lamp);
        const Vec3 w = to_lamp / distance;
        const float point = emitter_density(lamp, w, distance);
        Rgb brought;
        if (point > 0 && intersect(here.position + here.normal * 1e-4f, w).wall == &lamp) {
            const float transmittance = std::exp(-extinction * distance);
            const float both = chosen.probability * point + directions.density(w) * transmittance;
            const Rgb fluence = lamp.radiance * (transmittance / both);
            brought = f.evaluate(w) * fluence;
            log_.connect(w, distance, mean_value(fluence), brought);
            gather(brought);
        }
        told_.lights.push_back(d_.lights.record(here, chosen.index, mean_value(brought) * chosen.probability));
    }

    bool survives() {
        const float survival =
            d_.survival.after_direction({now_.throughput, now_.ratio, 1, now_.depth, false, now_.last.in_volume()});
        weigh(Rgb(1 / survival));
        return random_.uniform() < survival;
    }

    // Every factor and every radiance goes to the log as well. That is all that training asks of a walk.
    void weigh(const Rgb& weight) {
        now_.throughput *= weight;
        log_.weigh(weight);
    }
    void gather(const Rgb& radiance) {
        radiance_ += now_.throughput * radiance;
        log_.gather(radiance);
    }

    const Decisions& d_;
    const wend::ClassicalDistance classical_flights_{};
    float expected_;
    wend::Pcg32& random_;
    PathLog& log_;
    Told& told_;
    State now_;
    std::vector<State> pending_;
    Rgb radiance_;
};

// ---- 3. Render in passes ----

constexpr int width = 64, height = 36;

struct Picture {
    int first = 0;  ///< of the samples of all pictures
    wend::Image mean{width, height};
    std::array<double, height> squares{};  ///< sums by row
    int samples = 0;
    double seconds = 0;

    /// Of the pixels, to a power.
    double average(int power = 1) const {
        const auto add = [&](double sum, const Rgb& pixel) { return sum + std::pow(double{mean_value(pixel)}, power); };
        return std::accumulate(mean.pixels.begin(), mean.pixels.end(), 0.0, add) / (width * height);
    }
    /// Of one sample, as a mean over the picture.
    double variance() const {
        return std::accumulate(squares.begin(), squares.end(), 0.0) / (samples * width * height) - average(2);
    }
};

Vec3 camera_direction(float x, float y) {
    const Vec3 forward = normalize(Vec3(0.67f, -0.08f, -0.74f)), right = normalize(forward.cross(Vec3(0, 1, 0)));
    return normalize(forward + right * (1.6f * (x / width - 0.5f)) +
                     forward.cross(right) * (0.9f * (y / height - 0.5f)));
}

/// Adds samples to every pixel, and returns what the walks told where one `learns` from it. A random number depends on
/// pixel and sample, and what is told is put in the order of rows: so the result is the same for any number of threads.
template <class Decisions>
std::vector<Told> render(const Decisions& decisions, const std::vector<float>& expected, int count, bool learns,
                         Picture& picture) {
    const auto start = std::chrono::steady_clock::now();
    std::vector<Told> rows(height);
    tbb::parallel_for(std::size_t{0}, std::size_t(height), [&](std::size_t row) {
        for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
            for (int sample = picture.samples; sample < picture.samples + count; ++sample) {
                wend::Pcg32 random(wend::hash_of(i, picture.first + sample));
                const float x = static_cast<float>(i % width) + random.uniform();
                const float y = static_cast<float>(row) + random.uniform();
                Walk walk(decisions, expected.empty() ? 0.0f : expected[i], random, rows[row]);
                const Rgb radiance = walk.run(Vec3(0.4f, 1.3f, 3.6f), camera_direction(x, y));
                Rgb& mean = picture.mean.pixels[i];
                mean += (radiance - mean) / static_cast<float>(sample + 1);
                const auto value = static_cast<double>(mean_value(radiance));
                picture.squares[row] += value * value;
                if (learns) {
                    rows[row].records.add(rows[row].log.vertices(), 64);
                }
            }
        }
    });
    picture.samples += count;
    picture.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return rows;
}

// ---- 4. Learn between passes. Each walks by what the passes before it learned, and is twice as long ----

void render_both(int samples, int passes, Picture& classical, Picture& training, Picture& guided) {
    training.first = samples;
    guided.first = samples + (1 << passes);
    wend::LearnedLights lights(bounds, lamps.size());
    const Decisions unguided{wend::ClassicalDistance(), wend::ClassicalDirection(), wend::unguided_walks_end, lights};
    render(unguided, {}, samples, false, classical);
    // Surfaces and volumes have a field each: what they see differs. Decisions refer to the fields: new ones are
    // assigned to them. What pixels will be is known from those passes, too.
    wend::guide::Fields fields{Field::empty(bounds), Field::empty(bounds)};
    std::vector<float> expected;
    const auto decide = [&] {
        const double noise = training.samples > 1 ? training.variance() / (training.average() * training.average()) : 1;
        return Decisions{wend::GuidedDistance(fields), wend::GuidedDirection(fields),
                         wend::AdjointRouletteSplitting(true, true, noise), lights};
    };
    for (int pass = 0; pass < passes; ++pass) {
        std::vector<PathRecords> records;
        for (Told& told : render(decide(), expected, 1 << pass, true, training)) {
            records.push_back(std::move(told.records));
            lights.add(told.lights);
        }
        fields = wend::guide::learn(fields, std::move(records), 0);
        lights.learn(by_power, 0);
        expected = wend::pixel_estimates(training.mean, training.samples);
    }
    // Training pictures are right, but noisier than what follows: this one shows what has been learned.
    render(decide(), expected, samples, false, guided);
}

}  // namespace

int main() {
    Picture classical, training, guided;
    render_both(128, 6, classical, training, guided);
    // A renderer that embeds a guide does well to test the same: no bias, and less noise in as many samples.
    for (const auto& [name, picture] : {std::pair("classical", &classical), {"guided", &guided}}) {
        std::printf("%-9s  mean %.4f, relative error of a sample %.2f, %.2f s\n", name, picture->average(),
                    std::sqrt(picture->variance()) / picture->average(), picture->seconds);
    }
    const double gain = classical.variance() / guided.variance();
    std::printf("%.1f times less variance by as many samples, %.1f times by as much time; %d samples of training\n",
                gain, gain * classical.seconds / guided.seconds, training.samples);
    const double error = std::sqrt((classical.variance() + guided.variance()) / (classical.samples * width * height));
    return std::abs(classical.average() - guided.average()) < 4 * error && gain > 4 ? 0 : 1;
}
