// A renderer of your own with Wend as its library: two foggy rooms joined by a door, the lamp in the far one. Rays,
// surfaces and lights are written here, as a renderer has them; Wend learns where light comes from, chooses directions,
// and decides which walks go on. The numbered comments are the steps of embedding it.
#include <tbb/parallel_for.h>
#include <wend/guide.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace {

using wend::dot, wend::length, wend::normalize;
using wend::Rgb, wend::Vec2, wend::Vec3;
using wend::guide::Field, wend::guide::PathLog, wend::guide::PathRecords;

// ---- The scene: rectangles across an axis, and fog everywhere ----

struct Wall {
    int axis;
    float at;
    Vec2 min, max;  ///< along the next two axes
    Rgb albedo;
};

const Rgb white(0.75f), red(0.6f, 0.2f, 0.15f);
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
    {0, 5.99f, {0.8f, 0.2f}, {1.6f, 0.8f}, Rgb()},
}};
const Wall& lamp = walls.back();
const float lamp_area = (lamp.max.x - lamp.min.x) * (lamp.max.y - lamp.min.y);
const Rgb lamp_radiance(15, 13, 10);
const float extinction = 0.2f;
const Rgb fog_albedo(0.95f);
const wend::PhaseFunction fog_phase(wend::HenyeyGreenstein{0.6f});
const wend::Box3 bounds(Vec3(0, 0, 0), Vec3(6, 2.5f, 4));

struct Hit {
    const Wall* wall = nullptr;
    float distance = std::numeric_limits<float>::infinity();
};
Hit intersect(const Vec3& origin, const Vec3& direction) {
    Hit nearest;
    for (const Wall& wall : walls) {
        const float distance = (wall.at - origin[wall.axis]) / direction[wall.axis];
        const Vec3 p = origin + direction * distance;
        const Vec2 q(p[(wall.axis + 1) % 3], p[(wall.axis + 2) % 3]);
        if (distance > 1e-5f && distance < nearest.distance && Imath::Box2f(wall.min, wall.max).intersects(q)) {
            nearest = {&wall, distance};
        }
    }
    return nearest;
}

/// Of choosing a direction by choosing a point of the lamp, per steradian; `cosine` is the lamp's.
float emitter_density(float distance, float cosine) {
    return distance * distance / (cosine * lamp_area);
}

// ---- 1. Tell Wend how things scatter: any class with these functions will do (wend::ScatteringFunction) ----

/// A matt surface. Its lobes are what the guide multiplies incident radiance with. (Fog: wend::VolumeScattering.)
struct Matt {
    static constexpr bool in_volume = false;
    Rgb albedo;
    Vec3 normal;

    Rgb evaluate(const Vec3& w) const { return albedo * density(w); }
    float density(const Vec3& w) const { return std::max(0.0f, dot(normal, w)) * wend::inv_pi; }
    std::optional<wend::DirectionSample> sample(float, const Vec2& u) const {
        const Vec3 w = wend::Frame::from_z(normal).to_world(wend::to_cosine_hemisphere(u));
        return wend::DirectionSample{w, evaluate(w), density(w)};
    }
    wend::AxialLobes lobes() const { return wend::AxialLobes::cosine().around(normal); }
    bool is_specular() const { return false; }
    bool is_guidable() const { return true; }
};

// ---- 2. Walk, let a decision choose directions, and tell the log what happens ----

/// One walk. `Directions` is wend::ClassicalDirection or wend::GuidedDirection: the walk cannot tell.
template <class Directions>
class Walk {
public:
    Walk(const Directions& directions, const Vec3& origin, const Vec3& direction, wend::Pcg32& random, PathLog& log)
        : directions_(directions), random_(random), log_(log), origin_(origin), direction_(direction) {}

    Rgb run() {
        log_.start();
        while (fly()) {
        }
        return radiance_;
    }

private:
    /// To the next collision or surface; false where the walk ends.
    bool fly() {
        const Hit hit = intersect(origin_, direction_);
        const float flight = wend::to_exponential(random_.uniform(), extinction);
        log_.meet(std::min(flight, hit.distance));
        if (flight < hit.distance) {
            weigh(fog_albedo);  // transmittance times scattering coefficient over the density of the flight
            return scatter(wend::VolumeScattering(fog_phase, direction_), origin_ + direction_ * flight);
        }
        const float cosine = direction_[hit.wall->axis];
        if (hit.wall == &lamp) {
            if (cosine > 0) {
                // The balance heuristic against connect(): the walk might have been connected to this point.
                const float own = density_ * std::exp(-extinction * hit.distance);
                gather(lamp_radiance * (depth_ == 0 ? 1 : own / (own + emitter_density(hit.distance, cosine))));
            }
            return false;
        }
        Vec3 normal(0, 0, 0);
        normal[hit.wall->axis] = cosine > 0 ? -1.0f : 1.0f;
        return scatter(Matt{hit.wall->albedo, normal}, origin_ + direction_ * hit.distance + normal * 1e-4f);
    }

    template <class F>
    bool scatter(const F& f, const Vec3& position) {
        const auto distribution = directions_.at(position, f, mean_value(throughput_));
        gather(connect(f, distribution, position));
        const float u = random_.uniform();
        const auto s = distribution.sample(u, random_.uniform2());
        if (!s) {
            return false;
        }
        // The weight is the scattering function over the density that was used, so no field can bias the picture.
        throughput_ *= s->weight();
        log_.scatter(position, s->direction, s->density, s->weight(), F::in_volume, s->classical_density,
                     s->guided_density);
        boost_ *= s->density_ratio;
        origin_ = position;
        direction_ = s->direction;
        density_ = s->density;
        const float survival = wend::ClassicalRoulette().after_direction({throughput_, boost_, 1, ++depth_});
        if (random_.uniform() >= survival) {
            return false;
        }
        weigh(Rgb(1 / survival));
        return true;
    }

    /// Next-event estimation. Directions could have found the lamp as well: the balance heuristic asks their density.
    template <class F, class Distribution>
    Rgb connect(const F& f, const Distribution& distribution, const Vec3& position) {
        const Vec2 q = lamp.min + random_.uniform2() * (lamp.max - lamp.min);
        const Vec3 to_lamp = Vec3(lamp.at, q.x, q.y) - position;
        const float distance = length(to_lamp);
        const Vec3 w = to_lamp / distance;
        if (w.x <= 0 || intersect(position, w).wall != &lamp) {
            return Rgb();
        }
        const float transmittance = std::exp(-extinction * distance);
        const float both = emitter_density(distance, w.x) + distribution.density(w) * transmittance;
        return f.evaluate(w) * lamp_radiance * (transmittance / both);
    }

    // Every factor and every radiance goes to the log as well. That is all that training asks of a walk.
    void weigh(const Rgb& weight) {
        throughput_ *= weight;
        log_.weigh(weight);
    }
    void gather(const Rgb& radiance) {
        radiance_ += throughput_ * radiance;
        log_.gather(radiance);
    }

    const Directions& directions_;
    wend::Pcg32& random_;
    PathLog& log_;
    Vec3 origin_, direction_;
    Rgb throughput_{1.0f}, radiance_;
    float density_ = 0;  ///< of the direction drawn last
    float boost_ = 1;    ///< how much likelier the walk is for being guided: roulette must not end it for that
    int depth_ = 0;
};

// ---- 3. Render in passes ----

constexpr int width = 64, height = 36;

/// Mean and variance of a stream of values.
class Moments {
public:
    void add(double value) {
        const double before = value - mean_;
        mean_ += before / static_cast<double>(++count_);
        squares_ += before * (value - mean_);
    }
    long count() const { return count_; }
    double mean() const { return mean_; }
    double variance() const { return count_ > 1 ? squares_ / static_cast<double>(count_ - 1) : 0; }
    double standard_error() const { return std::sqrt(variance() / static_cast<double>(count_)); }

private:
    long count_ = 0;
    double mean_ = 0, squares_ = 0;
};

struct Pixel {
    Rgb sum;
    Moments grey;
};
using Picture = std::vector<Pixel>;

const Vec3 camera(0.4f, 1.3f, 3.6f);
Vec3 camera_direction(float x, float y) {
    const Vec3 forward(0.67f, -0.08f, -0.74f), right(0.74f, 0, 0.67f), down(0, -1, 0);
    return normalize(forward + right * (1.6f * (x / width - 0.5f)) + down * (0.9f * (y / height - 0.5f)));
}

/// Adds `count` samples to every pixel, and returns what the walks recorded. A random number depends on pixel and
/// sample, and records are put in the order of rows: so the result is the same for any number of threads.
template <class Directions>
PathRecords render(const Directions& directions, int first, int count, Picture& picture) {
    std::vector<PathRecords> rows(height);
    tbb::parallel_for(std::size_t{0}, std::size_t(height), [&](std::size_t row) {
        PathLog log;
        for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
            for (int sample = first; sample < first + count; ++sample) {
                wend::Pcg32 random(wend::hash_of(i, sample));
                const float x = static_cast<float>(i % width) + random.uniform();
                const float y = static_cast<float>(row) + random.uniform();
                const Rgb radiance = Walk(directions, camera, camera_direction(x, y), random, log).run();
                picture[i].sum += radiance;
                picture[i].grey.add(mean(radiance));
                rows[row].add(log.vertices());
            }
        }
    });
    return PathRecords::joined(std::move(rows));
}

/// Over the picture: its pixels, and the squares of their standard errors.
struct Quality {
    Moments radiance, variance;
};
Quality report(const char* name, const Picture& picture) {
    Quality q;
    for (const Pixel& pixel : picture) {
        q.radiance.add(pixel.grey.mean());
        q.variance.add(std::pow(pixel.grey.standard_error(), 2));
    }
    std::printf("%-9s  mean %.4f, relative error of a pixel %.1f %%\n", name, q.radiance.mean(),
                100 * std::sqrt(q.variance.mean()) / q.radiance.mean());
    return q;
}

void write_pfm(const char* file, const Picture& picture) {
    std::ofstream out(file, std::ios::binary);
    out << "PF\n" << width << ' ' << height << "\n-1\n";  // little-endian; rows from the bottom up
    for (std::size_t y = height; y-- > 0;) {
        for (std::size_t x = 0; x < width; ++x) {
            const Pixel& pixel = picture[y * width + x];
            const Rgb colour = pixel.sum / static_cast<float>(pixel.grey.count());
            out.write(reinterpret_cast<const char*>(&colour), sizeof colour);
        }
    }
}

}  // namespace

int main() {
    constexpr int samples = 128, passes = 7;
    Picture classical(width * height), guided(width * height), training(width * height);
    render(wend::ClassicalDirection(), 0, samples, classical);
    // Surfaces and volumes have a field each: what they see differs. Some directions stay classical, the defence
    // against what the fields do not know yet. (The decision refers to the fields: new ones are assigned to them.)
    Field surface = Field::empty(bounds), volume = Field::empty(bounds);
    const wend::GuidedDirection<Field> directions(&surface, &volume);
    // ---- 4. Learn between passes. Each walks by what the passes before it learned, and is twice as long ----
    int sample = samples;
    for (int pass = 0; pass < passes; ++pass) {
        const PathRecords records = render(directions, sample, 1 << pass, training);
        surface = wend::guide::fit(surface, records.surface(), {}).field;
        volume = wend::guide::fit(volume, records.volume(), {}).field;
        sample += 1 << pass;
    }
    // Training pictures are right, but noisier than what follows: this one shows what has been learned.
    render(directions, sample, samples, guided);
    write_pfm("classical.pfm", classical);
    write_pfm("guided.pfm", guided);

    // A renderer that embeds a guide does well to test the same: no bias, and less noise in as many samples.
    const Quality a = report("classical", classical), b = report("guided", guided);
    const double gain = a.variance.mean() / b.variance.mean();
    std::printf("%.2f times less variance by %d samples per pixel, after %d of training\n", gain, samples,
                sample - samples);
    const double error = std::sqrt((a.variance.mean() + b.variance.mean()) / (width * height));
    return std::abs(a.radiance.mean() - b.radiance.mean()) < 4 * error && gain > 1 ? 0 : 1;
}
