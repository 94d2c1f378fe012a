#include <wend/film/merge.h>

#include <wend/core/contracts.h>
#include <wend/core/error.h>
#include <wend/decision/roulette_splitting.h>
#include <wend/film/chess_board.h>
#include <wend/film/cryptomatte.h>
#include <wend/film/film_layers.h>
#include <wend/film/merged_layers.h>
#include <wend/stats/moments.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace wend {
namespace {

using Halves = std::array<double, 2>;

const Layer& required_layer(const Picture& picture, const std::string& name, const std::vector<std::string>& channels) {
    const Layer* const layer = find_layer(picture.layers, name);
    if (!layer) {
        throw InputError("there is no layer '" + name +
                         "': pictures are merged by the layers 'variance' and 'samples'" +
                         " that 'wend render' writes to .exr files (but not with --half)");
    }
    if (layer->channels != channels) {
        throw InputError("the layer '" + name + "' has other channels than those that 'wend render' writes");
    }
    return *layer;
}

/// The estimate that a picture is, and what it knows of its noise.
class Estimate {
public:
    explicit Estimate(const Picture& picture)
        : pixels_(picture.image.pixels),
          samples_(required_layer(picture, "samples", {"N"}).values),
          variance_(required_layer(picture, "variance", {"R", "G", "B"}).values) {
        WEND_EXPECT(samples_.size() == pixels_.size() && variance_.size() == 3 * pixels_.size());
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            const float n = samples_[i];
            if (!(std::isfinite(n) && n >= 0 && n == std::floor(n))) {
                throw InputError("the layer 'samples' has " + std::to_string(n) + ", which is no number of samples");
            }
            // A variance may be too large for a float.
            if (!(variance_[3 * i] >= 0 && variance_[3 * i + 1] >= 0 && variance_[3 * i + 2] >= 0)) {
                throw InputError("the layer 'variance' has numbers that are negative or not numbers");
            }
            if (!is_finite(pixels_[i])) {
                throw InputError("a pixel is not a finite number");
            }
        }
    }

    const Rgb& mean(std::size_t i) const { return pixels_[i]; }
    double samples(std::size_t i) const { return static_cast<double>(samples_[i]); }
    /// Whether the samples of a pixel tell how far they scatter.
    bool knows_variance(std::size_t i) const { return samples_[i] >= 2; }
    double variance(std::size_t i, int c) const {
        return static_cast<double>(variance_[3 * i + static_cast<std::size_t>(c)]);
    }

private:
    const std::vector<Rgb>& pixels_;
    const std::vector<float>& samples_;
    const std::vector<float>& variance_;
};

std::string size_text(const Picture& picture) {
    const Vec2i end = picture.offset + Vec2i(picture.image.width, picture.image.height);
    return "pixels " + std::to_string(picture.offset.x) + " to " + std::to_string(end.x) + " by " +
           std::to_string(picture.offset.y) + " to " + std::to_string(end.y) + " of a picture of " +
           std::to_string(picture.full_size.x) + " x " + std::to_string(picture.full_size.y);
}

void require_same_place(const Picture& picture, const Picture& first) {
    if (picture.image.width != first.image.width || picture.image.height != first.image.height ||
        picture.offset != first.offset || picture.full_size != first.full_size) {
        throw InputError("it has " + size_text(picture) + ", and the first picture has " + size_text(first));
    }
}

/// Keeps the layers of `layers` that a picture has too; the names of others go to `left_out`.
void keep_common_layers(std::vector<Layer>& layers, const Picture& picture, std::vector<std::string>& left_out) {
    const auto leave_out = [&](const std::string& name) {
        if (std::find(left_out.begin(), left_out.end(), name) == left_out.end()) {
            left_out.push_back(name);
        }
    };
    for (const Layer& other : picture.layers) {
        const Layer* const own = find_layer(layers, other.name);
        if (!own) {
            leave_out(other.name);
        } else if (own->channels != other.channels) {
            throw InputError("the layer '" + other.name + "' has other channels than in the first picture");
        }
    }
    std::erase_if(layers, [&](const Layer& own) {
        const bool is_missing = find_layer(picture.layers, own.name) == nullptr;
        if (is_missing) {
            leave_out(own.name);
        }
        return is_missing;
    });
}

/// What the pictures are by their samples alone: the first look at them.
struct Overview {
    Picture frame;  ///< size and place, the mean over all samples, the layers that all have, yet without values
    std::vector<double> samples;
    std::vector<std::string> left_out;

    void add(const Picture& picture) {
        const Estimate estimate(picture);
        if (samples.empty()) {
            frame.image = Image(picture.image.width, picture.image.height);
            frame.offset = picture.offset;
            frame.full_size = picture.full_size;
            for (const Layer& layer : picture.layers) {
                frame.layers.push_back({layer.name, layer.channels, {}});
            }
            samples.resize(picture.image.pixels.size());
        }
        require_same_place(picture, frame);
        if (!frame.view) {
            frame.view = picture.view;
        }
        keep_common_layers(frame.layers, picture, left_out);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            if (const double n = estimate.samples(i); n > 0) {
                samples[i] += n;
                frame.image.pixels[i] +=
                    (estimate.mean(i) - frame.image.pixels[i]) * static_cast<float>(n / samples[i]);
            }
        }
    }

    int samples_per_pixel() const {
        const double all = std::accumulate(samples.begin(), samples.end(), 0.0);
        return static_cast<int>(std::min(all / static_cast<double>(samples.size()), 1e9));
    }
};

/// The variance of one sample relative to the picture, as one half of the pixels shows it.
using NoiseOfHalves = std::array<Moments, 2>;

NoiseOfHalves noise_of(const Picture& picture, const std::array<std::vector<float>, 2>& brightness) {
    const Estimate estimate(picture);
    NoiseOfHalves noise;
    for (std::size_t i = 0; i < picture.image.pixels.size(); ++i) {
        const std::size_t half = chess_half(i, picture.image.width);
        const double scale = static_cast<double>(brightness[half][i]);
        const double of_mean = estimate.variance(i, 0) + estimate.variance(i, 1) + estimate.variance(i, 2);
        const double relative = estimate.samples(i) * of_mean / (scale * scale);
        if (estimate.knows_variance(i) && scale > 0 && std::isfinite(relative)) {
            noise[half].add(relative);
        }
    }
    return noise;
}

/// What a sample of each picture is worth, by what one half of the pixels shows.
///
/// The logarithms of the variances scatter by what the pictures differ in and by their own error. Only the part that
/// the first has in both is kept of each difference, as in analyses of random effects.
std::vector<double> worth_of_samples(const std::vector<NoiseOfHalves>& noise, std::size_t half) {
    Moments logarithms, variances, squared_errors;
    for (const NoiseOfHalves& of_picture : noise) {
        const Moments& shown = of_picture[half];
        if (shown.mean() > 0) {
            logarithms.add(std::log(shown.mean()));
            variances.add(shown.mean());
            squared_errors.add(shown.standard_error() * shown.standard_error());
        }
    }
    std::vector<double> worth(noise.size(), 1);
    if (logarithms.count() < 2) {
        return worth;
    }
    // Of all together: a picture that has missed what is rare takes its own error for small.
    const double error = squared_errors.mean() / (variances.mean() * variances.mean());
    const double difference = std::max(0.0, logarithms.variance() - error);
    const double kept = difference > 0 ? difference / (difference + error) : 0.0;
    for (std::size_t k = 0; k < noise.size(); ++k) {
        if (const double shown = noise[k][half].mean(); shown > 0) {
            worth[k] = std::exp(kept * (logarithms.mean() - std::log(shown)));
        }
    }
    return worth;
}

/// Weighted sums of one pixel.
struct Sums {
    double weight = 0;
    double mean[3] = {0, 0, 0};
    double known_weight = 0;  ///< of pictures that know their variance there
    /// Σ w² v over those; as long as there are none, Σ w (m − mean)² over the others.
    double spread[3] = {0, 0, 0};

    void add(const Estimate& estimate, std::size_t i, double w) {
        weight += w;
        const bool knows = estimate.knows_variance(i);
        for (int c = 0; c < 3; ++c) {
            const double from_mean = static_cast<double>(estimate.mean(i)[c]) - mean[c];
            mean[c] += from_mean * w / weight;
            if (knows) {
                spread[c] = (known_weight > 0 ? spread[c] : 0.0) + w * w * estimate.variance(i, c);
            } else if (known_weight == 0) {
                spread[c] += w * from_mean * (static_cast<double>(estimate.mean(i)[c]) - mean[c]);
            }
        }
        known_weight += knows ? w : 0.0;
    }

    /// Of the mean. `samples` is how many pixels have had here: one a picture where no picture knows its variance.
    double variance(int c, double samples) const {
        if (known_weight > 0) {
            // w is inverse to the variance, so w² v is in proportion to w.
            return spread[c] / (weight * known_weight);
        }
        return samples > 1 ? spread[c] / ((samples - 1) * weight) : 0.0;
    }
};

bool is_mean_over_samples(const Layer& layer) {
    return layer.name != "variance" && layer.name != "samples" && !counts_as_beauty(layer.name) &&
           !is_cryptomatte(layer);
}

/// Adds a picture's part to the layers that are means over samples.
void add_layers(std::vector<Layer>& layers, const Picture& picture, const Estimate& estimate,
                const std::vector<double>& samples) {
    for (Layer& layer : layers) {
        if (!is_mean_over_samples(layer)) {
            continue;
        }
        const Layer& other = same_layer(picture, layer);
        const std::size_t channels = layer.channels.size();
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const double n = estimate.samples(i);
            for (std::size_t c = 0; n > 0 && c < channels; ++c) {
                layer.values[i * channels + c] +=
                    static_cast<float>(static_cast<double>(other.values[i * channels + c]) * (n / samples[i]));
            }
        }
    }
}

/// Writes the sums into the beauty and the layers `variance` and `samples`.
void put(const std::vector<Sums>& sums, const std::vector<double>& samples, Picture& picture) {
    for (std::size_t i = 0; i < sums.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            picture.image.pixels[i][c] = static_cast<float>(sums[i].mean[c]);
        }
    }
    for (Layer& layer : picture.layers) {
        for (std::size_t i = 0; i < sums.size(); ++i) {
            if (layer.name == "samples") {
                layer.values[i] = static_cast<float>(samples[i]);
            } else if (layer.name == "variance") {
                for (int c = 0; c < 3; ++c) {
                    layer.values[3 * i + static_cast<std::size_t>(c)] =
                        static_cast<float>(sums[i].variance(c, samples[i]));
                }
            }
        }
    }
}

std::vector<double> shares_of(const std::vector<Halves>& weights) {
    std::vector<double> shares(weights.size(), 0);
    double all = 0;
    for (std::size_t half = 0; half < 2; ++half) {
        double total = 0;
        for (const Halves& w : weights) {
            total += w[half];
        }
        for (std::size_t k = 0; total > 0 && k < shares.size(); ++k) {
            shares[k] += weights[k][half] / total;
        }
        all += total > 0 ? 1 : 0;
    }
    for (double& share : shares) {
        share /= std::max(all, 1.0);
    }
    return shares;
}

/// Reads the pictures again and again, each time in order.
class Pictures {
public:
    Pictures(std::size_t count, const std::function<Picture(std::size_t)>& read) : count_(count), read_(read) {}

    std::size_t count() const { return count_; }

    Overview overview() const {
        Overview overview;
        for (std::size_t k = 0; k < count_; ++k) {
            overview.add(read_(k));
        }
        return overview;
    }

    template <class Body>
    void for_each(const Picture& frame, const Body& body) const {
        for (std::size_t k = 0; k < count_; ++k) {
            const Picture picture = read_(k);
            require_same_place(picture, frame);
            body(k, picture);
        }
    }

private:
    std::size_t count_;
    const std::function<Picture(std::size_t)>& read_;
};

/// What a sample of each picture is worth in the pixels of either half.
std::array<std::vector<double>, 2> worth_of_samples(const Pictures& pictures, const Overview& overview) {
    const int samples = overview.samples_per_pixel();
    const std::array brightness{pixel_estimates(filled_from_half(overview.frame.image, 0), samples),
                                pixel_estimates(filled_from_half(overview.frame.image, 1), samples)};
    std::vector<NoiseOfHalves> noise;
    pictures.for_each(overview.frame,
                      [&](std::size_t, const Picture& picture) { noise.push_back(noise_of(picture, brightness)); });
    return {worth_of_samples(noise, 1), worth_of_samples(noise, 0)};
}

}  // namespace

MergedPictures merge_pictures(std::size_t count, const std::function<Picture(std::size_t)>& read) {
    WEND_EXPECT(count > 0);
    const Pictures pictures(count, read);
    Overview overview = pictures.overview();
    const std::array<std::vector<double>, 2> worth = worth_of_samples(pictures, overview);

    const std::vector<double>& samples = overview.samples;
    Picture& merged = overview.frame;
    for (Layer& layer : merged.layers) {
        layer.values.resize(samples.size() * layer.channels.size());
    }
    std::vector<Sums> sums(samples.size());
    PartMeans parts(merged.layers);
    MergedObjects objects(merged.layers);
    std::vector<Halves> weights(count, Halves{0, 0});
    std::vector<double> pixel_weights(samples.size()), pixel_totals(samples.size());
    std::vector<float> pixel_shares(samples.size());
    pictures.for_each(merged, [&](std::size_t k, const Picture& picture) {
        const Estimate estimate(picture);
        for (std::size_t i = 0; i < sums.size(); ++i) {
            const double n = estimate.samples(i);
            const std::size_t half = chess_half(i, picture.image.width);
            pixel_weights[i] = n > 0 ? n * worth[half][k] : 0.0;
            if (n > 0) {
                sums[i].add(estimate, i, pixel_weights[i]);
                weights[k][half] += pixel_weights[i];
            }
            pixel_totals[i] = sums[i].weight;
            pixel_shares[i] = n > 0 ? static_cast<float>(n / samples[i]) : 0.0f;
        }
        parts.add(picture, pixel_weights, pixel_totals);
        objects.add(picture, pixel_shares);
        add_layers(merged.layers, picture, estimate, samples);
    });
    put(sums, samples, merged);
    parts.put();
    objects.put();
    return {std::move(merged), shares_of(weights), std::move(overview.left_out),
            static_cast<std::size_t>(std::count(samples.begin(), samples.end(), 0.0))};
}

}  // namespace wend
