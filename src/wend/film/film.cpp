#include <wend/film/film.h>

#include <wend/core/contracts.h>
#include <wend/core/error.h>
#include <wend/core/parallel.h>
#include <wend/decision/roulette_splitting.h>
#include <wend/film/chess_board.h>
#include <wend/film/each_pixel.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace wend {
namespace {

constexpr double colour_channels = 3;

std::size_t checked_size(const Vec2i& full, const PixelRect& crop) {
    if (full.x <= 0 || full.y <= 0) {
        throw InputError("a film of " + std::to_string(full.x) + " x " + std::to_string(full.y) +
                         " pixels: both must be positive");
    }
    if (crop.min.x < 0 || crop.min.y < 0 || crop.max.x > full.x || crop.max.y > full.y || crop.width() <= 0 ||
        crop.height() <= 0) {
        throw InputError("the crop window is empty or outside the picture");
    }
    const auto pixels = static_cast<std::int64_t>(crop.width()) * crop.height();
    if (pixels > Film::max_pixels) {
        throw InputError("a film of " + std::to_string(crop.width()) + " x " + std::to_string(crop.height()) +
                         " pixels is more than Wend holds in memory (" + std::to_string(Film::max_pixels) + " pixels)");
    }
    return static_cast<std::size_t>(pixels);
}

}  // namespace

Film::Film(const Vec2i& full_size, const PixelRect& crop, FilmLayers layers)
    : full_size_(full_size),
      crop_(crop),
      layers_(std::move(layers)),
      pixels_(checked_size(full_size, crop)),
      parts_(pixels_.size(), layers_.parts.size() + (layers_.halves ? 2 : 0)),
      geometry_(layers_.geometry ? pixels_.size() : 0),
      coverage_(layers_.objects ? pixels_.size() : 0) {
}

void Film::add(const Vec2i& pixel, const FilmSample& sample) {
    Pixel& p = at(pixel);
    for (int c = 0; c < 3; ++c) {
        const double v = sample.radiance[c];
        p.sum[c] += v;
        p.squares[c] += v * v;
    }
    ++p.count;
    p.guided += sample.guided ? 1 : 0;
    p.segments += sample.segments;
    p.branches += sample.branches;
    if (sample.is_of_half_a && layers_.halves) {
        add_to_half(crop_.place_of(pixel), sample.radiance);
    }
}

void Film::add_parts(const Vec2i& pixel, std::span<const std::array<double, 3>> parts) {
    WEND_EXPECT(parts.size() == layers_.parts.size());
    for (std::size_t part = 0; part < parts.size(); ++part) {
        parts_.add(crop_.place_of(pixel), part, parts[part]);
    }
}

void Film::add_to_half(std::size_t index, const Rgb& radiance) {
    const std::size_t sum = layers_.parts.size();
    parts_.add(index, sum, {double{radiance.r}, double{radiance.g}, double{radiance.b}});
    parts_.add(index, sum + 1, {1, 1, 1});
}

void Film::add_features(const Vec2i& pixel, const FilmFeatures& features) {
    Pixel& p = at(pixel);
    for (int c = 0; c < 3; ++c) {
        p.albedo[c] += features.albedo[c];
        p.normal[c] += features.normal[c];
    }
    p.depth += features.depth;
    p.opacity += features.opacity;
    p.alpha += features.alpha;
    ++p.featured;
    if (layers_.geometry) {
        Geometry& sum = geometry_[crop_.place_of(pixel)];
        for (int c = 0; c < 3; ++c) {
            sum.position[c] += features.position[c];
            sum.face_normal[c] += features.face_normal[c];
        }
    }
}

void Film::add_coverage(const Vec2i& pixel, std::span<const Coverage> seen) {
    WEND_EXPECT(layers_.objects);
    for (const Coverage& object : seen) {
        coverage_[crop_.place_of(pixel)].add(object);
    }
}

void Film::reject(const Vec2i& pixel, bool is_of_half_a) {
    ++at(pixel).count;
    if (is_of_half_a && layers_.halves) {
        add_to_half(crop_.place_of(pixel), Rgb(0.0f));
    }
}

double Film::Pixel::variance(int c) const {
    if (count < 2) {
        return 0;
    }
    const double n = count;
    const double first = sum[c] / n;
    return std::max(0.0, squares[c] / n - first * first) * n / (n - 1);
}

double Film::Pixel::likely_variance(int c) const {
    return count < 2 && earlier_weight > 0 ? earlier_spread[c] * earlier_count / (earlier_weight * earlier_weight)
                                           : variance(c);
}

double Film::Pixel::mean(int c, double weight) const {
    const double total = this->weight(weight);
    return total > 0 ? (earlier_sum[c] + weight * sum[c]) / total : 0.0;
}

double Film::Pixel::spread(int c, double weight) const {
    const double total = this->weight(weight);
    return total > 0 ? (earlier_spread[c] + weight * weight * count * likely_variance(c)) / (total * total) : 0.0;
}

std::size_t Film::half_of(std::size_t index) const {
    return chess_half(index, crop_.width());
}

int Film::mean_samples() const {
    const auto add = [](std::uint64_t sum, const Pixel& p) { return sum + p.samples(); };
    return static_cast<int>(std::accumulate(pixels_.begin(), pixels_.end(), std::uint64_t{0}, add) / pixels_.size());
}

std::vector<float> Film::estimates_of_half(const Halves& weights, std::size_t half) const {
    return pixel_estimates(filled_from_half(beauty({weights[half], weights[half]}), half), mean_samples());
}

std::array<Film::Comparison, 2> Film::compare_stages(const Halves& weights) const {
    std::array<Comparison, 2> result;
    parallel_for(2, threads_for(crop_), [&](std::size_t half) {
        const std::vector<float> estimates = estimates_of_half(weights, half);
        Comparison& shown = result[half];
        double variances = 0, squares = 0, light = 0, count = 0;
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            const Pixel& p = pixels_[i];
            const double scale = static_cast<double>(estimates[i]);
            if (half_of(i) == half && p.count > 1 && scale > 0) {
                const double variance = (p.variance(0) + p.variance(1) + p.variance(2)) / (scale * scale);
                variances += variance;
                squares += variance * variance;
                light += (p.sum[0] + p.sum[1] + p.sum[2]) / (p.count * scale);
                if (p.earlier_weight > 0) {
                    light -= (p.earlier_sum[0] + p.earlier_sum[1] + p.earlier_sum[2]) / (p.earlier_weight * scale);
                }
                shown.samples += p.count;
                shown.earlier_samples += p.earlier_count;
                ++count;
            }
        }
        if (count == 0) {
            return;
        }
        shown.more_light = light / (colour_channels * count);
        shown.noise = {variances / count, shown.samples - count, 0};
        if (count > 1 && variances > 0) {
            const double of_pixels = std::max(0.0, count * squares / (variances * variances) - 1);
            shown.noise.scatter = shown.noise.freedom * of_pixels / (count - 1);
        }
    });
    return result;
}

double Film::stage_weight(double earlier_weight, const StageNoise& first, const Comparison& shown) {
    double variance = shown.noise.variance, weight = earlier_weight;
    if (!(variance > 0)) {
        return weight;
    }
    // What is less noise than before may be chance, too. Of the logarithm of their ratio what remains is the part that
    // its own error does not explain. Stages scatter alike: one that has missed what is rare takes its error for small.
    constexpr double least_scatter = 2;  // of a normal distribution
    const double gain = first.variance > 0 ? std::log(first.variance / (variance * earlier_weight)) : 0.0;
    if (gain > 0) {
        const double scatter = std::max(least_scatter, first.scatter);
        const double error = scatter / first.freedom + std::max(scatter, shown.noise.scatter) / shown.noise.freedom;
        weight *= std::exp(std::max(0.0, gain - error / gain));
        variance = first.variance / weight;
    }
    // All stages have the same mean. What is missing in a sum of n samples comes once in n of them, or more seldom. The
    // more earlier samples would count little then, the less it may be chance.
    const double deviations = std::sqrt(4 + 2 * std::log(std::max(1.0, shown.earlier_samples / shown.samples)));
    const double missing = shown.more_light - deviations * std::sqrt(variance / (colour_channels * shown.samples));
    const double lack = missing > 0 ? colour_channels * shown.earlier_samples * missing * missing : 0.0;
    return std::max(weight, earlier_weight * lack / variance);
}

Film::Halves Film::stage_weights() const {
    if (earlier_weights_[0] == 0) {
        return {1, 1};
    }
    const std::array<Comparison, 2> shown = compare_stages(earlier_weights_);
    Halves weights;
    for (std::size_t half = 0; half < 2; ++half) {
        weights[half] = stage_weight(earlier_weights_[half], first_noise_[1 - half], shown[1 - half]);
    }
    return weights;
}

void Film::begin_stage() {
    const Halves weights = stage_weights();
    if (earlier_weights_[0] == 0) {
        const std::array<Comparison, 2> shown = compare_stages(weights);
        first_noise_ = {shown[0].noise, shown[1].noise};
    }
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        Pixel& p = pixels_[i];
        const double weight = weights[half_of(i)];
        for (int c = 0; c < 3; ++c) {
            p.earlier_spread[c] += weight * weight * p.count * p.likely_variance(c);
            p.earlier_sum[c] += weight * std::exchange(p.sum[c], 0);
            p.squares[c] = 0;
        }
        parts_.end_stage(i, weight);
        p.earlier_weight += weight * p.count;
        p.earlier_count += std::exchange(p.count, 0);
    }
    earlier_weights_ = weights;
}

Image Film::beauty() const {
    return beauty(stage_weights());
}

Image Film::beauty(const Halves& weights) const {
    Image image(crop_.width(), crop_.height());
    for_each_pixel(crop_, [&](std::size_t i) {
        const double weight = weights[half_of(i)];
        for (int c = 0; c < 3; ++c) {
            image.pixels[i][c] = static_cast<float>(pixels_[i].mean(c, weight));
        }
    });
    return image;
}

std::vector<PixelNoise> Film::noise() const {
    const Halves weights = stage_weights();
    std::vector<PixelNoise> result(pixels_.size());
    parallel_for(2, threads_for(crop_), [&](std::size_t half) {
        const std::vector<float> estimates = estimates_of_half(weights, half);
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            if (half_of(i) != half) {
                continue;
            }
            const Pixel& p = pixels_[i];
            const double weight = weights[half], scale = static_cast<double>(estimates[i]);
            PixelNoise& noise = result[i];
            noise.count = p.samples();
            noise.samples = p.weight(weight) / weight;
            noise.work = p.samples() > 0 ? static_cast<double>(p.segments) / p.samples() : 0.0;
            const double spread = p.spread(0, weight) + p.spread(1, weight) + p.spread(2, weight);
            noise.variance = scale > 0 ? spread * noise.samples / (3 * scale * scale) : 0.0;
        }
    });
    return result;
}

double Film::relative_noise() const {
    const Halves weights = stage_weights();
    double total = 0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            total += pixels_[i].mean(c, weights[half_of(i)]);
        }
    }
    const double floor = 0.1 * total / static_cast<double>(pixels_.size());
    double sum = 0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const Pixel& p = pixels_[i];
        double variance = 0;
        double mean = 0;
        for (int c = 0; c < 3; ++c) {
            variance += p.spread(c, weights[half_of(i)]);
            mean += p.mean(c, weights[half_of(i)]);
        }
        const double scale = std::max(mean, floor);
        sum += scale > 0 ? 3 * variance / (scale * scale) : 0.0;
    }
    return std::sqrt(sum / static_cast<double>(pixels_.size()));
}

}  // namespace wend
