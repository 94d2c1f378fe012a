// Colour as three linear channels (Rec. 709 primaries, D65 white): radiance, reflectance, extinction, albedo.
#pragma once

#include <algorithm>
#include <cmath>

namespace wend {

/// One value a colour channel. Arithmetic is per channel.
struct Rgb {
    float r = 0, g = 0, b = 0;

    constexpr Rgb() = default;
    constexpr explicit Rgb(float grey) : r(grey), g(grey), b(grey) {}
    constexpr Rgb(float red, float green, float blue) : r(red), g(green), b(blue) {}

    constexpr float& operator[](int c) { return c == 0 ? r : c == 1 ? g : b; }
    constexpr float operator[](int c) const { return c == 0 ? r : c == 1 ? g : b; }

    constexpr Rgb& operator+=(const Rgb& o) { return *this = {r + o.r, g + o.g, b + o.b}; }
    constexpr Rgb& operator*=(const Rgb& o) { return *this = {r * o.r, g * o.g, b * o.b}; }
    constexpr Rgb& operator*=(float s) { return *this = {r * s, g * s, b * s}; }

    friend constexpr Rgb operator+(const Rgb& x, const Rgb& y) { return {x.r + y.r, x.g + y.g, x.b + y.b}; }
    friend constexpr Rgb operator-(const Rgb& x, const Rgb& y) { return {x.r - y.r, x.g - y.g, x.b - y.b}; }
    friend constexpr Rgb operator*(const Rgb& x, const Rgb& y) { return {x.r * y.r, x.g * y.g, x.b * y.b}; }
    friend constexpr Rgb operator*(const Rgb& x, float s) { return {x.r * s, x.g * s, x.b * s}; }
    friend constexpr Rgb operator*(float s, const Rgb& x) { return x * s; }
    friend constexpr Rgb operator/(const Rgb& x, const Rgb& y) { return {x.r / y.r, x.g / y.g, x.b / y.b}; }
    friend constexpr Rgb operator/(const Rgb& x, float s) { return x * (1.0f / s); }
    friend constexpr bool operator==(const Rgb&, const Rgb&) = default;
};

constexpr float mean(const Rgb& c) {
    return (c.r + c.g + c.b) * (1.0f / 3.0f);
}
constexpr float max_value(const Rgb& c) {
    return std::max({c.r, c.g, c.b});
}
constexpr float min_value(const Rgb& c) {
    return std::min({c.r, c.g, c.b});
}
/// Mean of the channels.
constexpr float mean_value(const Rgb& c) {
    return (c.r + c.g + c.b) / 3;
}

/// Relative luminance (ITU-R BT.709).
constexpr float luminance(const Rgb& c) {
    return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}
constexpr bool is_black(const Rgb& c) {
    return c.r == 0 && c.g == 0 && c.b == 0;
}
inline bool is_finite(const Rgb& c) {
    return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}
inline Rgb exp(const Rgb& c) {
    return {std::exp(c.r), std::exp(c.g), std::exp(c.b)};
}

}  // namespace wend
