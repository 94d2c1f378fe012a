#include <wend/render/sample_budget.h>

#include <wend/core/random.h>
#include <wend/film/chess_board.h>

#include <algorithm>
#include <array>
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

/// Around each pixel, what the pixels of one half show as a mean.
struct Surroundings {
    std::vector<double> variance, work;
};

Surroundings surroundings(const std::vector<PixelNoise>& noise, int width, std::size_t half, double most) {
    const int height = static_cast<int>(noise.size()) / width;
    SummedArea variance(width, height), work(width, height), pixels(width, height);
    for (std::size_t i = 0; i < noise.size(); ++i) {
        const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
        const bool shows = chess_half(i, width) == half;
        variance.set(x, y, shows ? std::min(noise[i].variance, most) : 0.0);
        work.set(x, y, shows ? noise[i].work : 0.0);
        pixels.set(x, y, shows ? 1 : 0);
    }
    Surroundings result;
    for (std::size_t i = 0; i < noise.size(); ++i) {
        const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
        const double count = std::max(pixels.square(x, y, reach), 1.0);
        result.variance.push_back(variance.square(x, y, reach) / count);
        result.work.push_back(work.square(x, y, reach) / count);
    }
    return result;
}

/// How far two independent views of the same differences agree, 0 to 1: of what one shows, the part that is no chance.
double reliability(const std::vector<double>& a, const std::vector<double>& b) {
    const auto n = static_cast<double>(a.size());
    const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / n;
    const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
    double both = 0, square_a = 0, square_b = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        both += (a[i] - mean_a) * (b[i] - mean_b);
        square_a += (a[i] - mean_a) * (a[i] - mean_a);
        square_b += (b[i] - mean_b) * (b[i] - mean_b);
    }
    const double size = std::sqrt(square_a * square_b);
    return size > 0 ? std::clamp(both / size, 0.0, 1.0) : 0.0;
}

/// How much a pixel is worth beside others: the root of its variance over its work, as its neighbours of the other half
/// show them.
std::vector<double> worth_of_pixels(const std::vector<PixelNoise>& noise, int width) {
    const auto count = static_cast<double>(noise.size());
    const double mean = std::accumulate(noise.begin(), noise.end(), 0.0,
                                        [](double sum, const PixelNoise& pixel) { return sum + pixel.variance; }) /
                        count;
    std::vector<double> worth(noise.size(), 1);
    if (!(mean > 0)) {
        return worth;
    }
    const std::array<Surroundings, 2> shown = {surroundings(noise, width, 0, most_variance * mean),
                                               surroundings(noise, width, 1, most_variance * mean)};
    const double certainty = reliability(shown[0].variance, shown[1].variance);
    for (std::size_t i = 0; i < noise.size(); ++i) {
        const Surroundings& around = shown[1 - chess_half(i, width)];
        const double variance = certainty * around.variance[i] + (1 - certainty + least_variance) * mean;
        // A ray, its shading and its place on the film are work as well.
        worth[i] = std::sqrt(variance / (around.work[i] + 1));
    }
    return worth;
}

}  // namespace

std::vector<std::uint32_t> sample_counts(const std::vector<PixelNoise>& noise, int width, int count, std::uint64_t seed,
                                         const std::vector<double>& most) {
    const std::vector<double> worth = worth_of_pixels(noise, width);
    double wanted = count * static_cast<double>(noise.size());
    if (!most.empty()) {
        wanted = std::min(wanted, std::accumulate(most.begin(), most.end(), 0.0));
    }
    const auto missing = [&](std::size_t i, double level) {
        const double samples = std::max(0.0, level * worth[i] - noise[i].samples);
        return most.empty() ? samples : std::min(samples, most[i]);
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
