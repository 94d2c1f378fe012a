#include <wend/io/spectrum/colorimetry.h>

#include <wend/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wend {
namespace {

constexpr int first_wavelength = 360, last_wavelength = 830;

/// A bell with different widths on its two sides.
double lobe(double wavelength, double centre, double width_below, double width_above) {
    const double t = (wavelength - centre) / (wavelength < centre ? width_below : width_above);
    return std::exp(-0.5 * t * t);
}

// wyman2013, table 1
Xyz fitted_matching(double w) {
    return {
        1.056 * lobe(w, 599.8, 37.9, 31.0) + 0.362 * lobe(w, 442.0, 16.0, 26.7) - 0.065 * lobe(w, 501.1, 20.4, 26.2),
        0.821 * lobe(w, 568.8, 46.9, 40.5) + 0.286 * lobe(w, 530.9, 16.3, 31.1),
        1.217 * lobe(w, 437.0, 11.8, 36.0) + 0.681 * lobe(w, 459.0, 26.0, 13.8)};
}

/// Relative power of CIE standard illuminant D65 every 10 nm from 380 to 780 (cie15).
constexpr std::array<double, 41> d65_power{
    49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861, 115.923,
    108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046, 100.000, 96.3342, 95.7880, 88.6856,
    90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091,
    74.3490, 61.6040, 69.8856, 75.0870, 63.5927, 46.4182, 66.8054, 63.3828};

double d65(double wavelength) {
    const double at = std::clamp((wavelength - 380) / 10, 0.0, d65_power.size() - 1.0);
    const auto i = std::min(static_cast<std::size_t>(at), d65_power.size() - 2);
    return std::lerp(d65_power[i], d65_power[i + 1], at - static_cast<double>(i));
}

template <class Spectrum>
Xyz integrate(const Spectrum& spectrum, Xyz (*matching)(double)) {
    Xyz sum;
    for (int w = first_wavelength; w <= last_wavelength; ++w) {
        const Xyz m = matching(w);
        const double s = spectrum(w);
        sum = {sum.x + m.x * s, sum.y + m.y * s, sum.z + m.z * s};
    }
    return sum;
}

constexpr ColourMatrix to_rec709{
    {{{3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}}}};
/// The tristimulus values that this matrix maps to (1, 1, 1).
constexpr Xyz white_point{0.95047, 1.0, 1.08883};

Xyz matching(double wavelength) {
    static const Xyz scale = [] {
        const Xyz fit = integrate(d65, fitted_matching);
        return Xyz{white_point.x * fit.y / fit.x, 1, white_point.z * fit.y / fit.z};
    }();
    const Xyz fit = fitted_matching(wavelength);
    return {fit.x * scale.x, fit.y, fit.z * scale.z};
}

Rgb clamp_below(const Rgb& c) {
    return {std::max(c.r, 0.0f), std::max(c.g, 0.0f), std::max(c.b, 0.0f)};
}

double interpolate(std::span<const SpectrumSample> samples, double wavelength) {
    const auto above = std::upper_bound(samples.begin(), samples.end(), wavelength,
                                        [](double w, const SpectrumSample& s) { return w < s.wavelength; });
    if (above == samples.begin()) {
        return 0;
    }
    const SpectrumSample& low = *(above - 1);
    if (above == samples.end()) {
        return wavelength == low.wavelength ? low.value : 0;
    }
    const double t = (wavelength - low.wavelength) / (static_cast<double>(above->wavelength) - low.wavelength);
    return std::lerp(static_cast<double>(low.value), static_cast<double>(above->value), t);
}

}  // namespace

Xyz xyz_from_spectrum(const std::function<double(double)>& spectrum) {
    return integrate(spectrum, matching);
}

Rgb rgb_from_xyz(const Xyz& xyz) {
    Rgb rgb;
    for (int c = 0; c < 3; ++c) {
        const auto& row = to_rec709.m[static_cast<std::size_t>(c)];
        const double of_white = row[0] * white_point.x + row[1] * white_point.y + row[2] * white_point.z;
        rgb[c] = static_cast<float>((row[0] * xyz.x + row[1] * xyz.y + row[2] * xyz.z) / of_white);
    }
    return rgb;
}

const ColourMatrix& rgb_from_xyz_matrix() {
    return to_rec709;
}

Rgb rgb_from_chromaticity(double x, double y) {
    return clamp_below(rgb_from_xyz({x / y, 1, (1 - x - y) / y}));
}

Rgb rgb_of_reflectance(const std::function<double(double)>& spectrum) {
    const Xyz xyz = integrate([&](double w) { return spectrum(w) * d65(w); }, matching);
    static const double y_of_white = integrate(d65, matching).y;
    return rgb_from_xyz({xyz.x / y_of_white, xyz.y / y_of_white, xyz.z / y_of_white});
}

Rgb rgb_from_spectrum(const std::function<double(double)>& spectrum, SpectrumKind kind) {
    if (kind == SpectrumKind::illuminant) {
        const Xyz xyz = xyz_from_spectrum(spectrum);
        return xyz.y > 0 ? clamp_below(rgb_from_xyz({xyz.x / xyz.y, 1, xyz.z / xyz.y})) : Rgb();
    }
    const Rgb rgb = clamp_below(rgb_of_reflectance(spectrum));
    return kind == SpectrumKind::unbounded ? rgb
                                           : Rgb(std::min(rgb.r, 1.0f), std::min(rgb.g, 1.0f), std::min(rgb.b, 1.0f));
}

std::function<double(double)> spectrum_from_pairs(std::vector<SpectrumSample> samples) {
    if (samples.empty()) {
        throw InputError("a spectrum needs at least one pair of a wavelength and a value");
    }
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (!std::isfinite(samples[i].wavelength) || (i > 0 && !(samples[i].wavelength > samples[i - 1].wavelength))) {
            throw InputError(fmt::format("the wavelengths of a spectrum must increase, but {} nm is next after {} nm",
                                         samples[i].wavelength, i > 0 ? samples[i - 1].wavelength : 0));
        }
        if (!std::isfinite(samples[i].value) || samples[i].value < 0) {
            throw InputError(fmt::format("the value {} of a spectrum at {} nm is negative or not finite",
                                         samples[i].value, samples[i].wavelength));
        }
    }
    return [samples = std::move(samples)](double w) { return interpolate(samples, w); };
}

Rgb rgb_from_pairs(std::span<const SpectrumSample> samples, SpectrumKind kind) {
    return rgb_from_spectrum(spectrum_from_pairs({samples.begin(), samples.end()}), kind);
}

}  // namespace wend
