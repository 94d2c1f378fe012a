// One pass over the picture, tile by tile.
#pragma once

#include <wend/film/film.h>
#include <wend/render/guiding_choice.h>
#include <wend/render/learners.h>
#include <wend/render/render.h>
#include <wend/render/tile.h>
#include <wend/transport/first_surface.h>
#include <wend/transport/path_tracer.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <utility>
#include <vector>

namespace wend {

/// When walks are to rest: at a time, or once they are told to stop, which drops those on their way.
class Rest {
public:
    using Clock = std::chrono::steady_clock;

    /// `stop` may be null.
    Rest(Clock::time_point time, const std::atomic<bool>* stop) : time_(time), stop_(stop) {}

    bool drops_walks() const { return stop_ && stop_->load(std::memory_order_relaxed); }
    bool is_due() const { return drops_walks() || is_late_.load(std::memory_order_relaxed); }
    /// Looks at the clock, which costs as much as a tenth of a short walk.
    void look() const {
        if (Clock::now() >= time_) {
            is_late_.store(true, std::memory_order_relaxed);
        }
    }

private:
    Clock::time_point time_;
    const std::atomic<bool>* stop_;
    mutable std::atomic<bool> is_late_ = false;
};

/// One pass, as far as it has walks of one kind: the same decisions for all of them.
template <class Decisions>
class Pass {
public:
    Pass(const Scene& scene, Film& film, const RenderSettings& settings, const Decisions& decisions,
         const GuidingChoice& choice, std::size_t kind, const Learners& learners, const PassPlan& plan,
         const Rest& rest)
        : tracer_(scene, decisions,
                  choice.kinds()[kind].guides_dense_media ? learners.get<InteriorLearner>().guides() : no_guides_,
                  learners.get<LightLearner>().selection(), learners.get<ReflectionLearner>().probability(),
                  settings.max_depth, settings.stop),
          kind_(kind),
          cost_of_segment_(GuidingChoice::cost_of_segment(choice.kinds()[kind])),
          recorded_share_(choice.kinds()[kind].preset.direction ? plan.recorded_share_directed : plan.recorded_share),
          is_guided_(!choice.kinds()[kind].is_classical()),
          expects_(choice.kinds()[kind].preset.guides_survival()),
          learners_(learners),
          scene_(scene),
          camera_(scene.camera()),
          is_moving_(scene.is_moving()),
          film_(film),
          settings_(settings),
          plan_(plan),
          rest_(rest) {}

    /// Goes on in a tile that is at this kind until all its pixels are done or it is time to rest; whether they are.
    bool run(Tile& tile, Learners::Records& records) const {
        if (tile.shares[kind_] > 0 && !run_pixels(tile, records)) {
            return false;
        }
        tile.pixels_done = 0;
        ++tile.kinds_done;
        return true;
    }

private:
    /// Rays of a pixel whose surfaces are looked at: those that every pixel has. More would tell little.
    static constexpr int most_features = 15;

    bool run_pixels(Tile& tile, Learners::Records& records) const {
        // Segments between two looks at the clock.
        constexpr std::uint64_t few = 256;
        const double mean = mean_estimate(tile.pixels);
        LightParts parts(settings_.parts);
        std::uint64_t looked = tile.counts.segments;
        for (; tile.pixels_done < tile.pixel_count(); ++tile.pixels_done) {
            const Vec2i pixel = tile.pixel(tile.pixels_done);
            const float expected = estimate(pixel);
            if (tile.samples_done == 0) {
                tile.of_pixel = PixelWalks(error_scale(expected, mean), weight(pixel));
            }
            for (const int count = count_of(pixel); tile.samples_done < count; ++tile.samples_done) {
                if (tile.counts.segments - looked > few) {
                    rest_.look();
                    looked = tile.counts.segments;
                }
                if (rest_.is_due() || !sample(pixel, expected, tile, records, parts)) {
                    return false;
                }
            }
            // What is not relative to its pixel would weigh by how bright that is.
            if (!plan_.estimates.empty()) {
                tile.tallies[kind_] += tile.of_pixel.tally();
            }
            tile.samples_done = 0;
        }
        return true;
    }

    /// The next sample of a pixel, if it is one of this kind; false if it was dropped.
    bool sample(const Vec2i& pixel, float expected, Tile& tile, Learners::Records& records, LightParts& parts) const {
        const int index = first_of(pixel) + tile.samples_done;
        const auto number = static_cast<std::uint64_t>(pixel.y) * static_cast<std::uint64_t>(film_.full_size().x) +
                            static_cast<std::uint64_t>(pixel.x);
        if (GuidingChoice::kind_of(tile.shares, settings_.seed, number, tile.samples_done, count_of(pixel)) != kind_) {
            return true;
        }
        Sampler sampler(settings_.sampler, settings_.seed, number, static_cast<std::uint32_t>(index));
        const Filter::Sample place = settings_.filter.sample(sampler.uniform2());
        const Vec2 film_point(static_cast<float>(pixel.x) + 0.5f + place.offset.x,
                              static_cast<float>(pixel.y) + 0.5f + place.offset.y);
        const Vec2 lens = sampler.uniform2();
        const float time = is_moving_ ? camera_.shutter().time(sampler.uniform()) : 0.0f;
        const CameraRay ray = camera_.ray(film_point, lens, time);
        const bool is_recorded = records_walk(number, index);
        const bool is_traced = ray.weight > 0;
        WalkResult result;
        if (is_traced) {
            result =
                tracer_.trace(ray, expects_ ? expected / ray.weight : 0, sampler,
                              learners_.recorders(records, is_recorded), settings_.parts.is_empty() ? nullptr : &parts);
            result.sample.radiance *= ray.weight;
        }
        if (rest_.drops_walks()) {
            return false;  // the walk may be a part of one
        }
        const bool counts = is_finite(result.sample.radiance);
        if (is_traced) {
            learners_.keep(records, is_recorded && counts);
        }
        ++tile.counts.paths;
        ++tile.walks[kind_];
        tile.counts.segments += result.sample.segments;
        if (!counts) {
            ++tile.counts.rejected;
            film_.reject(pixel, is_of_half_a(number, index));
            return true;
        }
        const double work =
            cost_of_segment_ * result.sample.segments + cost_of_interior_segment * result.interior_segments;
        tile.work[kind_] += work;
        tile.of_pixel.add(place.weight * mean_value(result.sample.radiance), work,
                          sqr(static_cast<double>(place.weight * ray.weight)) * result.unguided_square);
        result.sample.guided = is_guided_;
        result.sample.radiance = settings_.balance * (result.sample.radiance * (place.weight * settings_.exposure));
        result.sample.is_of_half_a = is_of_half_a(number, index);
        film_.add(pixel, result.sample);
        if (is_traced && !settings_.parts.is_empty()) {
            add_parts(pixel, parts, static_cast<double>(ray.weight * place.weight * settings_.exposure));
        }
        if (is_traced && index < most_features) {
            constexpr std::uint64_t purpose = 0x66656174;
            Pcg32 random(hash_of(settings_.seed, number, index, purpose));
            SeenObjects seen{settings_.objects};
            film_.add_features(pixel,
                               first_surface(scene_, ray, random, settings_.objects.is_empty() ? nullptr : &seen));
            if (!settings_.objects.is_empty()) {
                film_.add_coverage(pixel, seen.parts);
            }
        }
        return true;
    }

    void add_parts(const Vec2i& pixel, const LightParts& parts, double scale) const {
        std::vector<LightParts::Sum> scaled = parts.sums();
        for (LightParts::Sum& sum : scaled) {
            for (double& value : sum) {
                value *= scale;
            }
            sum = settings_.balance * sum;
        }
        film_.add_parts(pixel, scaled);
    }

    /// One of each two samples, at random: what low-discrepancy sequences have in a half of the domain may be exactly
    /// the even ones.
    bool is_of_half_a(std::uint64_t pixel, int index) const {
        constexpr std::uint64_t purpose = 0x68616c66;
        return film_.layers().halves &&
               ((hash_of(settings_.seed, pixel, index / 2, purpose) ^ static_cast<std::uint64_t>(index)) & 1) != 0;
    }

    /// What makes errors of a pixel relative to it, given the mean of its tile. What is known of it is what few walks
    /// have found: where that is next to nothing another kind of walk may find much, which must not count as its error.
    double error_scale(float expected, double tile_mean) const {
        constexpr double darkest_in_tile = 0.25, darkest_in_picture = 0.1;
        const double mean = plan_.mean_estimate;
        const double shown =
            std::max({static_cast<double>(expected), darkest_in_tile * tile_mean, darkest_in_picture * mean});
        return mean > 0 ? mean / shown : 1;
    }

    /// By a number of its own: what a walk does must not depend on whether it is recorded.
    bool records_walk(std::uint64_t pixel, int index) const {
        constexpr std::uint64_t purpose = 0x7265636f7264;
        return Pcg32(hash_of(settings_.seed, pixel, index, purpose)).uniform_double() < recorded_share_;
    }

    /// In lists of what is known of each pixel of the crop.
    std::size_t place_of(const Vec2i& pixel) const { return film_.crop().place_of(pixel); }
    float estimate(const Vec2i& pixel) const {
        return plan_.estimates.empty() ? 0.0f : plan_.estimates[place_of(pixel)];
    }
    int first_of(const Vec2i& pixel) const {
        return plan_.firsts.empty() ? plan_.first : static_cast<int>(plan_.firsts[place_of(pixel)]);
    }
    int count_of(const Vec2i& pixel) const {
        return plan_.counts.empty() ? plan_.count : static_cast<int>(plan_.counts[place_of(pixel)]);
    }

    /// Of a sample, such that all pixels weigh the same.
    double weight(const Vec2i& pixel) const {
        return plan_.counts.empty() ? 1.0 : static_cast<double>(plan_.count) / std::max(count_of(pixel), 1);
    }

    double mean_estimate(const PixelRect& pixels) const {
        double sum = 0;
        for (int y = pixels.min.y; y < pixels.max.y; ++y) {
            for (int x = pixels.min.x; x < pixels.max.x; ++x) {
                sum += static_cast<double>(estimate({x, y}));
            }
        }
        return sum / (static_cast<double>(pixels.width()) * pixels.height());
    }

    SubsurfaceGuides no_guides_;
    PathTracer<Decisions, Learners::Recorders> tracer_;
    std::size_t kind_;
    double cost_of_segment_;
    double recorded_share_;
    bool is_guided_;
    bool expects_;  ///< whether its survival follows the estimate of the pixel
    const Learners& learners_;
    const Scene& scene_;
    const Camera& camera_;
    bool is_moving_;  ///< a time is drawn only where it matters
    Film& film_;
    const RenderSettings& settings_;
    const PassPlan& plan_;
    const Rest& rest_;
};

}  // namespace wend
