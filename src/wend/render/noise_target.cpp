#include <wend/render/noise_target.h>

#include <wend/film/chess_board.h>
#include <wend/render/sample_budget.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace wend {
namespace {

/// Of the mean variance of the squares around one, and of the picture's: what a square has at least.
constexpr double least_of_neighbours = 0.5, least_of_picture = 0.05;

}  // namespace

double SquaresNoise::Half::needed(double target) const {
    return samples > 0 ? variance / (samples * target * target) : 0.0;
}

std::size_t SquaresNoise::square_of(std::size_t pixel) const {
    const auto width = static_cast<std::size_t>(width_);
    return pixel / width / side * static_cast<std::size_t>(columns_) + pixel % width / side;
}

SquaresNoise::SquaresNoise(const std::vector<PixelNoise>& pixels, int width)
    : pixels_(pixels),
      width_(width),
      columns_((width + side - 1) / side),
      rows_((static_cast<int>(pixels.size()) / width + side - 1) / side),
      squares_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        Half& half = squares_[square_of(i)][chess_half(i, width)];
        ++half.pixels;
        half.samples += pixels[i].samples;
        half.variance += pixels[i].samples > 0 ? pixels[i].variance / pixels[i].samples : 0.0;
    }
    // The mean squared error, by as many samples as there are in the mean.
    for (Square& square : squares_) {
        for (Half& half : square) {
            if (half.pixels > 0) {
                half.samples /= half.pixels;
                half.variance *= half.samples / half.pixels;
            }
        }
    }
    const std::vector<Square> seen = squares_;
    for (std::size_t half = 0; half < 2; ++half) {
        const std::vector<double> shown = variances_shown(seen, 1 - half);
        for (std::size_t i = 0; i < squares_.size(); ++i) {
            squares_[i][half].variance = shown[i];
        }
    }
}

std::vector<double> SquaresNoise::variances_shown(const std::vector<Square>& seen, std::size_t half) const {
    double whole = 0, pixels = 0;
    for (const Square& square : seen) {
        whole += square[half].pixels * square[half].variance;
        pixels += square[half].pixels;
    }
    whole /= std::max(pixels, 1.0);
    std::vector<double> shown;
    shown.reserve(seen.size());
    for (int y = 0; y < rows_; ++y) {
        for (int x = 0; x < columns_; ++x) {
            double sum = 0, count = 0;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, rows_ - 1); ++v) {
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, columns_ - 1); ++u) {
                    const Half& near = seen[static_cast<std::size_t>(v * columns_ + u)][half];
                    sum += near.pixels * near.variance;
                    count += near.pixels;
                }
            }
            const double around = count > 0 ? sum / count : whole;
            const double own = seen[static_cast<std::size_t>(y * columns_ + x)][half].variance;
            shown.push_back(std::max({own, least_of_neighbours * around, least_of_picture * whole}));
        }
    }
    return shown;
}

double SquaresNoise::worst() const {
    double worst = 0;
    for (const Square& square : squares_) {
        for (const Half& half : square) {
            worst = std::max(worst, half.needed(1));
        }
    }
    return std::sqrt(worst);
}

double SquaresNoise::missing(double target, bool to_those_in_need) const {
    double sum = 0, most = 0;
    for (const Square& square : squares_) {
        for (const Half& half : square) {
            const double lacking = half.samples * std::max(half.needed(target) - 1, 0.0);
            most = std::max(most, lacking);
            sum += half.pixels * lacking;
        }
    }
    return to_those_in_need ? sum / static_cast<double>(pixels_.size()) : most;
}

std::vector<double> SquaresNoise::most_samples(double target) const {
    // A little more than it lacks, lest it take many short passes; least and most are in samples that it has had.
    constexpr double margin = 1.05, least = 0.125, most = 1;
    std::vector<double> result(pixels_.size());
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const double needed = squares_[square_of(i)][chess_half(i, width_)].needed(target);
        const double more = needed > 1 ? std::clamp(margin * needed - 1, least, most) : 0.0;
        result[i] = std::ceil(more * std::max<double>(pixels_[i].count, 1));
    }
    return result;
}

NoiseLeft noise_left(const Film& film, const RenderSettings& settings, int samples) {
    const std::vector<PixelNoise> pixels = film.noise();
    const SquaresNoise noise(pixels, film.crop().width());
    const double missing = noise.missing(settings.noise, settings.preset.adaptive);
    return {noise.worst(), std::max<double>(samples + missing, known_noise)};
}

std::vector<std::uint32_t> counts_to_noise(const Film& film, const RenderSettings& settings, int count) {
    const std::vector<PixelNoise> pixels = film.noise();
    const int width = film.crop().width();
    return sample_counts(pixels, width, count, settings.seed, SquaresNoise(pixels, width).most_samples(settings.noise));
}

}  // namespace wend
