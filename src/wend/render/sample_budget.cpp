#include <wend/core/random.h>
#include <wend/film/chess_board.h>
#include <wend/render/sample_budget.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace wend {
namespace {

/// Half the side of the squares that variance is averaged over.
constexpr int reach = 4;
/// Of the picture's mean variance: where less is seen, a rare value may not have been seen yet.
constexpr double least_variance = 0.05;
/// And beyond which more is a rare value that happened to be seen.
constexpr double most_variance = 16;

/// Sums over rectangles of a picture.
class SummedArea {
public:
    SummedArea(int width, int height)
        : width_(width), height_(height), sums_(static_cast<std::size_t>(width + 1) * (height + 1)) {}

    /// In the order of rows.
    void set(int x, int y, double value) { at(x + 1, y + 1) = value + at(x, y + 1) + at(x + 1, y) - at(x, y); }
    /// Around a pixel.
    double square(int x, int y, int half) const {
        const int x0 = std::max(x - half, 0), y0 = std::max(y - half, 0);
        const int x1 = std::min(x + half + 1, width_), y1 = std::min(y + half + 1, height_);
        return at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0);
    }

private:
    double& at(int x, int y) { return sums_[index(x, y)]; }
    double at(int x, int y) const { return sums_[index(x, y)]; }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_ + 1) + static_cast<std::size_t>(x);
    }

    int width_, height_;
    std::vector<double> sums_;
};

/// How much a pixel is worth beside others: the root of its variance over its work, as its neighbours of the other half
/// show them.
std::vector<double> worth_of_pixels(const std::vector<PixelNoise>& noise, int width) {
    const int height = static_cast<int>(noise.size()) / width;
    double all_variance = 0, all_work = 0;
    for (const PixelNoise& pixel : noise) {
        all_variance += pixel.variance;
        all_work += pixel.work;
    }
    const double mean_variance = all_variance / static_cast<double>(noise.size());
    const double mean_work = all_work / static_cast<double>(noise.size());
    std::vector<double> worth(noise.size(), 1);
    if (!(mean_variance > 0) || !(mean_work > 0)) {
        return worth;
    }
    for (std::size_t half = 0; half < 2; ++half) {
        SummedArea variance(width, height), work(width, height), pixels(width, height);
        for (std::size_t i = 0; i < noise.size(); ++i) {
            const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
            const bool shows = chess_half(i, width) != half;
            variance.set(x, y, shows ? std::min(noise[i].variance, most_variance * mean_variance) : 0.0);
            work.set(x, y, shows ? noise[i].work : 0.0);
            pixels.set(x, y, shows ? 1 : 0);
        }
        for (std::size_t i = 0; i < noise.size(); ++i) {
            const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
            const double count = pixels.square(x, y, reach);
            if (chess_half(i, width) == half && count > 0) {
                const double seen = variance.square(x, y, reach) / count + least_variance * mean_variance;
                // A ray, its shading and its place on the film are work as well.
                worth[i] = std::sqrt(seen / (work.square(x, y, reach) / count + 1));
            }
        }
    }
    return worth;
}

}  // namespace

std::vector<std::uint32_t> sample_counts(const std::vector<PixelNoise>& noise, int width, int count,
                                         std::uint64_t seed) {
    const std::vector<double> worth = worth_of_pixels(noise, width);
    const double wanted = count * static_cast<double>(noise.size());
    const auto missing = [&](std::size_t i, double level) {
        return std::max(0.0, level * worth[i] - noise[i].samples);
    };
    // The level to which all are filled up, as water finds it.
    double low = 0, high = 1;
    const auto filled = [&](double level) {
        double sum = 0;
        for (std::size_t i = 0; i < noise.size(); ++i) {
            sum += missing(i, level);
        }
        return sum;
    };
    while (filled(high) < wanted) {
        high *= 2;
    }
    constexpr int halvings = 40;
    for (int i = 0; i < halvings; ++i) {
        const double middle = (low + high) / 2;
        (filled(middle) < wanted ? low : high) = middle;
    }
    std::vector<std::uint32_t> counts(noise.size());
    for (std::size_t i = 0; i < noise.size(); ++i) {
        constexpr std::uint64_t purpose = 0x62756467;
        const double chance = Pcg32(hash_of(seed, i, noise[i].count, purpose)).uniform_double();
        counts[i] = static_cast<std::uint32_t>(missing(i, high) + chance);
    }
    return counts;
}

}  // namespace wend
