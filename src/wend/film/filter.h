#pragma once

#include <wend/core/vector.h>

#include <cstdint>
#include <vector>

namespace wend {

/// A separable pixel reconstruction filter, used by importance sampling (ernst2006): each sample belongs to one pixel,
/// from whose centre it is displaced by the filter's own density, so pixels are independent of each other.
class Filter {
public:
    static Filter box(float x_radius = 0.5f, float y_radius = 0.5f);
    static Filter triangle(float x_radius = 2, float y_radius = 2);
    /// exp(-x²/(2 sigma²)) less its value at the radius.
    static Filter gaussian(float x_radius = 1.5f, float y_radius = 1.5f, float sigma = 0.5f);
    /// Mitchell and Netravali's cubic, which is negative in places.
    static Filter mitchell(float x_radius = 2, float y_radius = 2, float b = 1.0f / 3, float c = 1.0f / 3);

    /// sin(pi x) / (pi x), windowed by the same of x / tau (Lanczos); negative in places.
    static Filter sinc(float x_radius = 4, float y_radius = 4, float tau = 3);

    struct Sample {
        Vec2 offset;       ///< from the pixel's centre
        float weight = 1;  ///< filter over density; its mean is 1
    };
    Sample sample(const Vec2& u) const;

private:
    /// One axis as a density that is constant over cells.
    class Axis {
    public:
        template <class Function>
        Axis(float radius, const Function& f);
        float sample(float u, float& weight) const;

    private:
        float radius_;
        std::vector<float> cdf_;            // of |f|
        std::vector<std::uint16_t> first_;  // of as many equal parts of [0,1), the cell in which each begins
        std::vector<float> value_;          // f at the cells' centres, over the cell's density and the integral of f
    };

    Filter(Axis x, Axis y) : x_(std::move(x)), y_(std::move(y)) {}

    Axis x_;
    Axis y_;
};

}  // namespace wend
