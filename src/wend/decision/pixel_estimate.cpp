#include <wend/decision/roulette_splitting.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace wend {
namespace {

/// Sums over the rectangles between the origin and each pixel.
class SummedArea {
public:
    explicit SummedArea(const Image& picture)
        : stride_(static_cast<std::size_t>(picture.width) + 1),
          sums_(stride_ * (static_cast<std::size_t>(picture.height) + 1)) {
        for (int y = 0; y < picture.height; ++y) {
            double row = 0;
            for (int x = 0; x < picture.width; ++x) {
                row += static_cast<double>(mean_value(picture.at(x, y)));
                sums_[index(x + 1, y + 1)] = sums_[index(x + 1, y)] + row;
            }
        }
    }

    /// Over [x0, x1) × [y0, y1).
    double sum(int x0, int y0, int x1, int y1) const {
        return sums_[index(x1, y1)] - sums_[index(x0, y1)] - sums_[index(x1, y0)] + sums_[index(x0, y0)];
    }

private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * stride_ + static_cast<std::size_t>(x);
    }

    std::size_t stride_;
    std::vector<double> sums_;
};

}  // namespace

std::vector<float> pixel_estimates(const Image& picture, int samples) {
    // As many samples as the estimate of a hard pixel wants.
    constexpr double enough = 1000;
    constexpr int largest_radius = 16;
    const int radius =
        std::min(largest_radius, static_cast<int>(std::ceil(std::sqrt(enough / std::max(1, samples)) / 2)));

    const SummedArea area(picture);
    const double mean = area.sum(0, 0, picture.width, picture.height) / static_cast<double>(picture.pixels.size());
    std::vector<float> estimates;
    estimates.reserve(picture.pixels.size());
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const int x0 = std::max(0, x - radius), x1 = std::min(picture.width, x + radius + 1);
            const int y0 = std::max(0, y - radius), y1 = std::min(picture.height, y + radius + 1);
            const double local = area.sum(x0, y0, x1, y1) / (static_cast<double>(x1 - x0) * (y1 - y0));
            estimates.push_back(static_cast<float>(std::hypot(local, 0.1 * mean)));
        }
    }
    return estimates;
}

}  // namespace wend
