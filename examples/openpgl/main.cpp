// The renderer of examples/embed once more, by Open PGL's interface alone: two foggy rooms joined by a door, the lamp
// in the far one. The numbered comments are where such a renderer talks to the guide.
#include <openpgl/cpp/OpenPGL.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace {

// ---- Values: the interface's own plain vectors do for points, directions and colours ----

namespace pgl = openpgl::cpp;
using Vec = pgl_vec3f;

constexpr float pi = 3.14159265f;

float get(const Vec& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
void set(Vec& v, int axis, float value) {
    (axis == 0 ? v.x : axis == 1 ? v.y : v.z) = value;
}
float dot(const Vec& a, const Vec& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vec operator-(const Vec& v) {
    return v * -1.0f;
}

/// The unit vector with a cosine to an axis and an azimuth around it (the frame is that of duff2017).
Vec around(const Vec& axis, float cosine, float azimuth) {
    const float sign = std::copysign(1.0f, axis.z), a = -1 / (sign + axis.z), b = axis.x * axis.y * a;
    const Vec u = {1 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x};
    const Vec v = {b, sign + axis.y * axis.y * a, -axis.y};
    const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    return pglNormalize(u * (sine * std::cos(azimuth)) + v * (sine * std::sin(azimuth)) + axis * cosine);
}

/// Random numbers of a pixel's sample.
class Random {
public:
    Random(std::uint64_t pixel, std::uint64_t sample) : state_(pixel * 0x9e3779b97f4a7c15u ^ (sample << 40)) { next(); }
    float uniform() { return static_cast<float>(next() >> 40) * 0x1p-24f; }

private:
    std::uint64_t next() {
        std::uint64_t x = state_ += 0x9e3779b97f4a7c15u;
        x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
        x = (x ^ x >> 27) * 0x94d049bb133111ebu;
        return x ^ x >> 31;
    }
    std::uint64_t state_;
};

// ---- The scene: rectangles across an axis, and fog everywhere ----

struct Wall {
    int axis;
    float at;
    pgl_vec2f min, max;  ///< along the next two axes
    Vec albedo;
};

const Vec white{0.75f, 0.75f, 0.75f}, red{0.6f, 0.2f, 0.15f};
const std::array<Wall, 10> walls = {{
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
    // The lamp shines towards the door.
    {0, 5.99f, {0.8f, 0.2f}, {1.6f, 0.8f}, {0, 0, 0}},
}};
const Wall& lamp = walls.back();
const float lamp_area = (lamp.max.x - lamp.min.x) * (lamp.max.y - lamp.min.y);
const Vec lamp_radiance{15, 13, 10};
const float extinction = 0.2f;
const float fog_albedo = 0.95f, fog_mean_cosine = 0.6f;

struct Hit {
    const Wall* wall = nullptr;
    float distance = std::numeric_limits<float>::infinity();
};
Hit intersect(const Vec& origin, const Vec& direction) {
    Hit nearest;
    for (const Wall& wall : walls) {
        const float distance = (wall.at - get(origin, wall.axis)) / get(direction, wall.axis);
        const Vec p = origin + direction * distance;
        const float a = get(p, (wall.axis + 1) % 3), b = get(p, (wall.axis + 2) % 3);
        if (distance > 1e-5f && distance < nearest.distance && a >= wall.min.x && a <= wall.max.x && b >= wall.min.y &&
            b <= wall.max.y) {
            nearest = {&wall, distance};
        }
    }
    return nearest;
}

/// Of choosing a direction by choosing a point of the lamp, per steradian; `cosine` is the lamp's.
float emitter_density(float distance, float cosine) {
    return distance * distance / (cosine * lamp_area);
}

// ---- How things scatter ----

/// A matt surface, or the fog. The value contains a surface's cosine.
struct Scatterer {
    bool in_volume;
    Vec axis;  ///< the normal, or the direction of flight
    Vec albedo;

    float density(const Vec& w) const {
        const float cosine = dot(axis, w), g = fog_mean_cosine;
        if (!in_volume) {
            return std::max(0.0f, cosine) / pi;
        }
        const float d = 1 + g * g - 2 * g * cosine;
        return (1 - g * g) / (4 * pi * d * std::sqrt(d));
    }
    Vec evaluate(const Vec& w) const { return albedo * density(w); }
    Vec sample(float u, float v) const {
        const float g = fog_mean_cosine, s = (1 - g * g) / (1 - g + 2 * g * u);
        return around(axis, in_volume ? (1 + g * g - s * s) / (2 * g) : std::sqrt(u), 2 * pi * v);
    }
};

// ---- 1. Ask the field for directions ----

/// What a thread needs to ask a field.
struct Guide {
    const pgl::Field* field;
    pgl::SurfaceSamplingDistribution surface;
    pgl::VolumeSamplingDistribution volume;

    explicit Guide(const pgl::Field& f) : field(&f), surface(&f), volume(&f) {}
};

/// Directions of a vertex: half of them guided, as soon as the field knows something. With no guide, none.
class Directions {
public:
    Directions(Guide* guide, const Scatterer& f, const Vec& position, Random& random) : guide_(guide), f_(f) {
        float u = random.uniform();
        if (!guide) {
            return;
        }
        if (f.in_volume && guide->volume.Init(guide->field, position, u)) {
            guide->volume.ApplySingleLobeHenyeyGreensteinProduct(f.axis, fog_mean_cosine);
            share_ = guided_share;
        } else if (!f.in_volume && guide->surface.Init(guide->field, position, u)) {
            guide->surface.ApplyCosineProduct(f.axis);
            share_ = guided_share;
        }
    }
    float density(const Vec& w) const {
        if (share_ == 0) {
            return f_.density(w);
        }
        const float guided = f_.in_volume ? guide_->volume.PDF(w) : guide_->surface.PDF(w);
        return share_ * guided + (1 - share_) * f_.density(w);
    }
    Vec sample(Random& random) const {
        const bool is_guided = random.uniform() < share_;
        const float u = random.uniform(), v = random.uniform();
        if (!is_guided) {
            return f_.sample(u, v);
        }
        return f_.in_volume ? guide_->volume.Sample(pgl::Point2(u, v)) : guide_->surface.Sample(pgl::Point2(u, v));
    }

private:
    static constexpr float guided_share = 0.5f;

    Guide* guide_;
    const Scatterer& f_;
    float share_ = 0;
};

// ---- 2. Walk, and write down the segments ----

class Walk {
public:
    Walk(Guide* guide, pgl::PathSegmentStorage& segments, const Vec& origin, const Vec& direction, Random& random)
        : guide_(guide), segments_(segments), random_(random), origin_(origin), direction_(direction) {}

    Vec run() {
        while (fly()) {
        }
        return radiance_;
    }

private:
    /// To the next collision or surface; false where the walk ends.
    bool fly() {
        const Hit hit = intersect(origin_, direction_);
        const float flight = -std::log1p(-random_.uniform()) / extinction;
        if (flight < hit.distance) {
            // Transmittance times scattering coefficient over the density of the flight. It is part of the flight.
            const Vec weight{fog_albedo, fog_albedo, fog_albedo};
            throughput_ = throughput_ * weight;
            pgl::SetTransmittanceWeight(segment_, weight);
            return scatter({true, direction_, {1, 1, 1}}, origin_ + direction_ * flight);
        }
        const float cosine = get(direction_, hit.wall->axis);
        if (hit.wall == &lamp) {
            if (cosine > 0) {
                meet_lamp(hit.distance, cosine);
            }
            return false;
        }
        Vec normal{0, 0, 0};
        set(normal, hit.wall->axis, cosine > 0 ? -1.0f : 1.0f);
        return scatter({false, normal, hit.wall->albedo}, origin_ + direction_ * hit.distance + normal * 1e-4f);
    }

    void begin_segment(const Vec& position) {
        segment_ = segments_.NextSegment();
        pgl::SetPosition(segment_, position);
        pgl::SetDirectionOut(segment_, -direction_);
    }

    /// The balance heuristic against connect(): the walk might have been connected to this point.
    void meet_lamp(float distance, float cosine) {
        const float own = density_ * std::exp(-extinction * distance);
        const float weight = depth_ == 0 ? 1 : own / (own + emitter_density(distance, cosine));
        radiance_ = radiance_ + throughput_ * lamp_radiance * weight;
        begin_segment(origin_ + direction_ * distance);
        pgl::SetDirectContribution(segment_, lamp_radiance);
        pgl::SetMiWeight(segment_, weight);
    }

    bool scatter(const Scatterer& f, const Vec& position) {
        begin_segment(position);
        const Directions directions(guide_, f, position, random_);
        const Vec connected = connect(f, directions, position);
        radiance_ = radiance_ + throughput_ * connected;
        const Vec w = directions.sample(random_);
        const float density = directions.density(w);
        const Vec weight = f.evaluate(w) / density;
        pgl::SetVolumeScatter(segment_, f.in_volume);
        pgl::SetNormal(segment_, f.axis);
        pgl::SetScatteredContribution(segment_, connected);
        if (!(pgl::Max(weight) > 0)) {
            return false;
        }
        throughput_ = throughput_ * weight;
        // Roulette by throughput must not end a walk for being guided, which makes it likely and light.
        boost_ *= density / f.density(w);
        const float survival = ++depth_ <= 1 ? 1.0f : std::min(1.0f, pgl::Max(throughput_) * std::min(boost_, 1e4f));
        pgl::SetDirectionIn(segment_, w);
        pgl::SetPDFDirectionIn(segment_, density);
        pgl::SetScatteringWeight(segment_, weight);
        pgl::SetRussianRouletteProbability(segment_, survival);
        if (random_.uniform() >= survival) {
            return false;
        }
        throughput_ = throughput_ / survival;
        origin_ = position;
        direction_ = w;
        density_ = density;
        return true;
    }

    /// Next-event estimation. Directions could have found the lamp as well: the balance heuristic asks their density.
    Vec connect(const Scatterer& f, const Directions& directions, const Vec& position) {
        const float y = lamp.min.x + random_.uniform() * (lamp.max.x - lamp.min.x);
        const float z = lamp.min.y + random_.uniform() * (lamp.max.y - lamp.min.y);
        const Vec to_lamp = Vec{lamp.at, y, z} - position;
        const float distance = std::sqrt(dot(to_lamp, to_lamp));
        const Vec w = to_lamp / distance;
        if (w.x <= 0 || intersect(position, w).wall != &lamp) {
            return {0, 0, 0};
        }
        const float transmittance = std::exp(-extinction * distance);
        const float both = emitter_density(distance, w.x) + directions.density(w) * transmittance;
        return f.evaluate(w) * lamp_radiance * (transmittance / both);
    }

    Guide* guide_;
    pgl::PathSegmentStorage& segments_;
    Random& random_;
    Vec origin_, direction_;
    pgl::PathSegment* segment_ = nullptr;
    Vec throughput_{1, 1, 1}, radiance_{0, 0, 0};
    float density_ = 0;  ///< of the direction drawn last
    float boost_ = 1;    ///< how much likelier the walk is for being guided
    int depth_ = 0;
};

// ---- 3. Render in passes ----

constexpr int width = 64, height = 36;

/// Of a stream of values.
struct Moments {
    double count = 0, sum = 0, squares = 0;

    void add(double value) {
        count += 1;
        sum += value;
        squares += value * value;
    }
    double mean() const { return sum / count; }
    double squared_error() const { return (squares / count - mean() * mean()) / (count - 1); }
};
using Picture = std::vector<Moments>;

const Vec camera{0.4f, 1.3f, 3.6f};
Vec camera_direction(float x, float y) {
    const Vec forward{0.67f, -0.08f, -0.74f}, right{0.74f, 0, 0.67f}, down{0, -1, 0};
    return pglNormalize(forward + right * (1.6f * (x / width - 0.5f)) + down * (0.9f * (y / height - 0.5f)));
}

/// Whether the segments of a walk say what it brought. A walk's first flight is before its first segment.
bool agree(const Vec& segments, const Vec& brought) {
    const float a = pgl::Average(segments), b = pgl::Average(brought);
    return std::abs(a - b) <= 1e-3f * b || std::abs(a * fog_albedo - b) <= 1e-3f * b;
}

/// Adds `count` samples to every pixel, and what the walks recorded to the samples. Threads take rows as they come: a
/// random number depends on pixel and sample, and the order of samples does not matter, so the result is the same.
/// Returns how many walks recorded something else than they brought.
long render(const pgl::Field* field, int first, int count, Picture& picture, pgl::SampleStorage* samples) {
    std::atomic<int> next_row{0};
    std::atomic<long> wrong{0};
    const auto work = [&] {
        std::optional<Guide> guide;
        if (field) {
            guide.emplace(*field);
        }
        pgl::PathSegmentStorage segments;
        segments.Reserve(512);
        for (int y = next_row++; y < height; y = next_row++) {
            for (int i = y * width; i < (y + 1) * width; ++i) {
                for (int sample = first; sample < first + count; ++sample) {
                    Random random(static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(sample));
                    const float px = static_cast<float>(i % width) + random.uniform();
                    const float py = static_cast<float>(y) + random.uniform();
                    const Vec radiance =
                        Walk(guide ? &*guide : nullptr, segments, camera, camera_direction(px, py), random).run();
                    picture[static_cast<std::size_t>(i)].add(pgl::Average(radiance));
                    wrong += agree(segments.CalculatePixelEstimate(true), radiance) ? 0 : 1;
                    if (samples) {
                        segments.PropagateSamples(samples, true, true);
                    }
                    segments.Clear();
                }
            }
        }
    };
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i) {
        threads.emplace_back(work);
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    return wrong;
}

/// The picture's mean, and that of the squares of its pixels' standard errors.
std::pair<double, double> report(const char* name, const Picture& picture) {
    Moments radiance, squared_error;
    for (const Moments& pixel : picture) {
        radiance.add(pixel.mean());
        squared_error.add(pixel.squared_error());
    }
    std::printf("%-9s  mean %.4f, relative error of a pixel %.1f %%\n", name, radiance.mean(),
                100 * std::sqrt(squared_error.mean()) / radiance.mean());
    return {radiance.mean(), squared_error.mean()};
}

}  // namespace

int main() {
    constexpr int samples = 128, passes = 7;
    Picture classical(width * height), guided(width * height), training(width * height);
    long wrong = render(nullptr, 0, samples, classical, nullptr);

    // ---- 4. Learn between passes. Each walks by what the passes before it learned, and is twice as long ----
    pgl::Device device(PGL_DEVICE_TYPE_CPU_8);
    pgl::FieldConfig config;
    config.Init(PGL_SPATIAL_STRUCTURE_KDTREE, PGL_DIRECTIONAL_DISTRIBUTION_PARALLAX_AWARE_VMM);
    pgl::Field field(&device, config);
    pgl::SampleStorage records;
    int sample = samples;
    for (int pass = 0; pass < passes; ++pass) {
        wrong += render(&field, sample, 1 << pass, training, &records);
        field.Update(records);
        records.Clear();
        sample += 1 << pass;
    }
    // Training pictures are right, but noisier than what follows: this one shows what has been learned.
    wrong += render(&field, sample, samples, guided, nullptr);

    // A renderer that embeds a guide does well to test the same: no bias, and less noise in as many samples.
    const auto [mean, noise] = report("classical", classical);
    const auto [guided_mean, guided_noise] = report("guided", guided);
    const double gain = noise / guided_noise;
    std::printf("%.2f times less variance by %d samples per pixel, after %d of training\n", gain, samples,
                sample - samples);
    std::printf("%ld walks recorded something else than they brought\n", wrong);
    const double error = std::sqrt((noise + guided_noise) / (width * height));
    return std::abs(mean - guided_mean) < 4 * error && gain > 1 && wrong == 0 ? 0 : 1;
}
