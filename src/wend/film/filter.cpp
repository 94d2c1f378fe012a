#include <wend/film/filter.h>

#include <algorithm>
#include <cmath>

namespace wend {

template <class Function>
Filter::Axis::Axis(float radius, const Function& f) : radius_(radius) {
    // The filter itself is taken to be constant over these cells, each under a hundredth of a pixel wide.
    constexpr int cells = 512;
    std::vector<float> values(cells);
    double integral = 0;
    double absolute = 0;
    for (int i = 0; i < cells; ++i) {
        const float x = (2 * (static_cast<float>(i) + 0.5f) / cells - 1) * radius;
        values[static_cast<std::size_t>(i)] = f(x);
        integral += f(x);
        absolute += std::abs(f(x));
    }
    cdf_.push_back(0);
    double sum = 0;
    for (const float v : values) {
        sum += std::abs(v);
        cdf_.push_back(static_cast<float>(sum / absolute));
        value_.push_back(static_cast<float>(std::copysign(absolute / integral, v)));
    }
    cdf_.back() = 1;
    for (std::size_t i = 0, cell = 0; i < values.size(); ++i) {
        while (cdf_[cell + 1] <= static_cast<float>(i) / cells) {
            ++cell;
        }
        first_.push_back(static_cast<std::uint16_t>(cell));
    }
}

float Filter::Axis::sample(float u, float& weight) const {
    const auto part = static_cast<std::size_t>(u * static_cast<float>(first_.size()));
    std::size_t cell = first_[std::min(part, first_.size() - 1)];
    while (cell + 1 < value_.size() && cdf_[cell + 1] <= u) {
        ++cell;
    }
    const float width = cdf_[cell + 1] - cdf_[cell];
    const float f = width > 0 ? (u - cdf_[cell]) / width : 0.5f;
    weight *= value_[cell];
    return (2 * (static_cast<float>(cell) + f) / static_cast<float>(value_.size()) - 1) * radius_;
}

Filter::Sample Filter::sample(const Vec2& u) const {
    Sample s;
    s.offset.x = x_.sample(u.x, s.weight);
    s.offset.y = y_.sample(u.y, s.weight);
    return s;
}

Filter Filter::box(float x_radius, float y_radius) {
    const auto f = [](float) { return 1.0f; };
    return {Axis(x_radius, f), Axis(y_radius, f)};
}

Filter Filter::triangle(float x_radius, float y_radius) {
    const auto axis = [](float radius) { return Axis(radius, [radius](float x) { return radius - std::abs(x); }); };
    return {axis(x_radius), axis(y_radius)};
}

Filter Filter::gaussian(float x_radius, float y_radius, float sigma) {
    const auto axis = [sigma](float radius) {
        const auto g = [sigma](float x) { return std::exp(-x * x / (2 * sigma * sigma)); };
        return Axis(radius, [g, radius](float x) { return g(x) - g(radius); });
    };
    return {axis(x_radius), axis(y_radius)};
}

Filter Filter::mitchell(float x_radius, float y_radius, float b, float c) {
    const auto axis = [b, c](float radius) {
        return Axis(radius, [b, c, radius](float offset) {
            const float x = std::abs(2 * offset / radius);
            if (x <= 1) {
                return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + (6 - 2 * b)) / 6;
            }
            return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x + (8 * b + 24 * c)) /
                   6;
        });
    };
    return {axis(x_radius), axis(y_radius)};
}

Filter Filter::sinc(float x_radius, float y_radius, float tau) {
    const auto wave = [](float x) {
        const float angle = pi * x;
        return std::abs(angle) < 1e-4f ? 1.0f : std::sin(angle) / angle;
    };
    const auto windowed = [=](float x) { return wave(x) * wave(x / tau); };
    return {Axis(x_radius, windowed), Axis(y_radius, windowed)};
}

}  // namespace wend
