// Colour as three linear channels (Rec. 709 primaries, D65 white): radiance, reflectance, extinction, albedo.
#pragma once

#include <algorithm>
#include <cmath>

namespace wend {

/// One value a colour channel. Arithmetic is per channel.
struct Rgb {
    float r = 0;  ///< red
    float g = 0;  ///< green
    float b = 0;  ///< blue

    /// Black.
    constexpr Rgb() = default;
    /// The same in all channels.
    constexpr explicit Rgb(float grey) : r(grey), g(grey), b(grey) {}
    /// One number a channel.
    constexpr Rgb(float red, float green, float blue) : r(red), g(green), b(blue) {}

    /// Channel 0, 1 or 2: red, green, blue; to be written.
    constexpr float& operator[](int c) { return c == 0 ? r : c == 1 ? g : b; }
    /// Channel 0, 1 or 2: red, green, blue.
    constexpr float operator[](int c) const { return c == 0 ? r : c == 1 ? g : b; }

    /// Adds another colour.
    constexpr Rgb& operator+=(const Rgb& o) { return *this = {r + o.r, g + o.g, b + o.b}; }
    /// Multiplies by another colour, as by an albedo or a transmittance.
    constexpr Rgb& operator*=(const Rgb& o) { return *this = {r * o.r, g * o.g, b * o.b}; }
    /// Scales all channels alike.
    constexpr Rgb& operator*=(float s) { return *this = {r * s, g * s, b * s}; }

    /// Sum.
    friend constexpr Rgb operator+(const Rgb& x, const Rgb& y) { return {x.r + y.r, x.g + y.g, x.b + y.b}; }
    /// Difference; channels may become negative.
    friend constexpr Rgb operator-(const Rgb& x, const Rgb& y) { return {x.r - y.r, x.g - y.g, x.b - y.b}; }
    /// Product.
    friend constexpr Rgb operator*(const Rgb& x, const Rgb& y) { return {x.r * y.r, x.g * y.g, x.b * y.b}; }
    /// All channels times a number.
    friend constexpr Rgb operator*(const Rgb& x, float s) { return {x.r * s, x.g * s, x.b * s}; }
    /// A number times all channels.
    friend constexpr Rgb operator*(float s, const Rgb& x) { return x * s; }
    /// Quotient; a channel of `y` that is 0 gives infinity or NaN.
    friend constexpr Rgb operator/(const Rgb& x, const Rgb& y) { return {x.r / y.r, x.g / y.g, x.b / y.b}; }
    /// All channels times the reciprocal of a number.
    friend constexpr Rgb operator/(const Rgb& x, float s) { return x * (1.0f / s); }
    /// Whether all channels are equal.
    friend constexpr bool operator==(const Rgb&, const Rgb&) = default;
};

/// Mean of the channels, by a factor of 1/3: at times the last bit differs from mean_value().
constexpr float mean(const Rgb& c) {
    return (c.r + c.g + c.b) * (1.0f / 3.0f);
}
/// The largest channel.
constexpr float max_value(const Rgb& c) {
    return std::max({c.r, c.g, c.b});
}
/// The smallest channel.
constexpr float min_value(const Rgb& c) {
    return std::min({c.r, c.g, c.b});
}
/// Mean of the channels, by a division.
constexpr float mean_value(const Rgb& c) {
    return (c.r + c.g + c.b) / 3;
}

/// Relative luminance (ITU-R BT.709).
constexpr float luminance(const Rgb& c) {
    return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}
/// Whether all channels are 0.
constexpr bool is_black(const Rgb& c) {
    return c.r == 0 && c.g == 0 && c.b == 0;
}
/// Whether no channel is infinite or NaN.
inline bool is_finite(const Rgb& c) {
    return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}
/// e to the power of each channel: a transmittance, of minus an optical depth.
inline Rgb exp(const Rgb& c) {
    return {std::exp(c.r), std::exp(c.g), std::exp(c.b)};
}

}  // namespace wend
