#include <wend/sampling/windowed.h>

#include <wend/core/contracts.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// A place and the whole number below.
struct CellPlace {
    int cell;
    double at;

    /// Divided by the number of cells, and still in its cell.
    float coordinate(int cells) const {
        const auto value = static_cast<float>(at / cells);
        const int rounded = static_cast<int>(value * static_cast<float>(cells));
        return rounded == cell ? value : std::nextafter(value, rounded > cell ? -1.0f : 2.0f);
    }
};

/// Where an integral that grows from `low` to `high`, linearly between whole numbers, reaches a share of what it is in
/// the end.
template <class Integral>
CellPlace invert(double low, double high, double share, const Integral& integral) {
    const double target = share * integral(high);
    int first = static_cast<int>(std::floor(low)), last = static_cast<int>(std::ceil(high));
    while (last - first > 1) {
        const int middle = (first + last) / 2;
        (integral(std::clamp(static_cast<double>(middle), low, high)) <= target ? first : last) = middle;
    }
    const double from = std::max(static_cast<double>(first), low), to = std::min(static_cast<double>(last), high);
    const double before = integral(from), after = integral(to);
    const double part = after > before ? std::clamp((target - before) / (after - before), 0.0, 1.0) : 0.5;
    return {first, from + part * (to - from)};
}

}  // namespace

WindowedPiecewiseConstant2D::WindowedPiecewiseConstant2D(std::span<const float> weights, int width, int height)
    : width_(width),
      height_(height),
      weights_(weights.begin(), weights.end()),
      sums_(static_cast<std::size_t>(width + 1) * static_cast<std::size_t>(height + 1)) {
    WEND_EXPECT(weights.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const auto row = static_cast<std::size_t>(width + 1);
    for (int y = 0; y < height; ++y) {
        double in_row = 0;
        for (int x = 0; x < width; ++x) {
            in_row += static_cast<double>(
                weights_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]);
            sums_[static_cast<std::size_t>(y + 1) * row + static_cast<std::size_t>(x + 1)] = entry(x + 1, y) + in_row;
        }
    }
}

float WindowedPiecewiseConstant2D::weight(const Vec2& point) const {
    const int x = std::clamp(static_cast<int>(point.x * static_cast<float>(width_)), 0, width_ - 1);
    const int y = std::clamp(static_cast<int>(point.y * static_cast<float>(height_)), 0, height_ - 1);
    return weights_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
}

double WindowedPiecewiseConstant2D::sum_up_to(double x, double y) const {
    const int i = std::clamp(static_cast<int>(x), 0, width_ - 1), j = std::clamp(static_cast<int>(y), 0, height_ - 1);
    const double fx = x - i, fy = y - j;
    // Exact, as within a cell the sum is bilinear.
    return (entry(i, j) * (1 - fx) + entry(i + 1, j) * fx) * (1 - fy) +
           (entry(i, j + 1) * (1 - fx) + entry(i + 1, j + 1) * fx) * fy;
}

std::optional<WindowedPiecewiseConstant2D::Sample> WindowedPiecewiseConstant2D::sample(const Vec2& u,
                                                                                       const Window& window) const {
    const double x0 = double{window.min.x} * width_, x1 = double{window.max.x} * width_;
    const double y0 = double{window.min.y} * height_, y1 = double{window.max.y} * height_;
    if (!(x1 > x0 && y1 > y0) || !(integral(x0, y0, x1, y1) > 0)) {
        return std::nullopt;
    }
    const CellPlace x = invert(x0, x1, double{u.x}, [&](double to) { return integral(x0, y0, to, y1); });
    // Within the column of cells that holds x all rows are in proportion to their weights.
    const double left = x.cell;
    const CellPlace y = invert(y0, y1, double{u.y}, [&](double to) { return integral(left, y0, left + 1, to); });
    const Vec2 point(std::clamp(x.coordinate(width_), window.min.x, window.max.x),
                     std::clamp(y.coordinate(height_), window.min.y, window.max.y));
    const float found = density(point, window);
    return found > 0 ? std::optional(Sample{point, found}) : std::nullopt;
}

float WindowedPiecewiseConstant2D::density(const Vec2& point, const Window& window) const {
    if (!window.holds(point)) {
        return 0;
    }
    const double all = integral(double{window.min.x} * width_, double{window.min.y} * height_,
                                double{window.max.x} * width_, double{window.max.y} * height_);
    return all > 0 ? static_cast<float>(double{weight(point)} * width_ * height_ / all) : 0.0f;
}

}  // namespace wend
