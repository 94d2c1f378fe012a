// Densities over rectangular windows of a picture.
#pragma once

#include <wend/core/vector.h>

#include <optional>
#include <span>
#include <vector>

namespace wend {

/// A density on a window of [0,1]² that is in proportion to weights of the cells of a regular grid. The window is
/// chosen for each sample (bitterli2015).
class WindowedPiecewiseConstant2D {
public:
    WindowedPiecewiseConstant2D() = default;
    /// Row-major weights of width x height cells, finite and not negative.
    WindowedPiecewiseConstant2D(std::span<const float> weights, int width, int height);

    struct Window {
        Vec2 min{0, 0};
        Vec2 max{1, 1};

        bool holds(const Vec2& p) const { return p.x >= min.x && p.y >= min.y && p.x <= max.x && p.y <= max.y; }
    };
    struct Sample {
        Vec2 point;
        float density;
    };
    /// Nothing where all of the window has weight 0.
    std::optional<Sample> sample(const Vec2& u, const Window& window) const;
    /// 0 outside the window.
    float density(const Vec2& point, const Window& window) const;

private:
    double entry(int x, int y) const {
        return sums_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_ + 1) + static_cast<std::size_t>(x)];
    }
    float weight(const Vec2& point) const;
    /// The integral from (0, 0) to (x, y), both in cells.
    double sum_up_to(double x, double y) const;
    double integral(double x0, double y0, double x1, double y1) const {
        return sum_up_to(x1, y1) - sum_up_to(x0, y1) - sum_up_to(x1, y0) + sum_up_to(x0, y0);
    }

    int width_ = 0;
    int height_ = 0;
    std::vector<float> weights_;
    std::vector<double> sums_;  ///< of all weights left of and below a corner of the grid
};

}  // namespace wend
