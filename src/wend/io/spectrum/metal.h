#pragma once

#include <wend/core/colour.h>

#include <functional>

namespace wend {

/// Complex index of refraction eta + i k, a channel each.
struct MetalConstants {
    Rgb eta;
    Rgb k;
};

/// Constants of three channels that reflect what a metal does whose constants are known by wavelength (in nanometres):
/// what comes back at normal incidence has its colour under daylight. `around`: index of the medium before the metal.
MetalConstants reduce_metal(const std::function<double(double)>& eta, const std::function<double(double)>& k,
                            float around);

}  // namespace wend
