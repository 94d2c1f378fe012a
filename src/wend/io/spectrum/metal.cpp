#include <wend/io/spectrum/metal.h>

#include <wend/core/vector.h>
#include <wend/io/spectrum/colorimetry.h>

#include <algorithm>
#include <cmath>

namespace wend {

MetalConstants reduce_metal(const std::function<double(double)>& eta, const std::function<double(double)>& k,
                            float around) {
    const double n = static_cast<double>(around);
    const auto reflectance_at = [&](double wavelength) {
        const double e = eta(wavelength) / n, a = sqr(k(wavelength) / n);
        return (sqr(e - 1) + a) / (sqr(e + 1) + a);
    };
    const Rgb reflectance = rgb_from_spectrum(reflectance_at, SpectrumKind::reflectance);
    MetalConstants result;
    result.eta = rgb_from_spectrum(eta, SpectrumKind::unbounded);
    for (int c = 0; c < 3; ++c) {
        // Of the two constants one can be chosen: the other is that of the mean.
        const float r = std::min(reflectance[c], 0.9999f), e = result.eta[c] / around;
        const float k_squared = (r * sqr(e + 1) - sqr(e - 1)) / (1 - r);
        if (k_squared >= 0) {
            result.k[c] = std::sqrt(k_squared) * around;
        } else {
            const float root = std::sqrt(r);
            result.k[c] = 0;
            result.eta[c] = (e < 1 ? (1 - root) / (1 + root) : (1 + root) / (1 - root)) * around;
        }
    }
    return result;
}

}  // namespace wend
