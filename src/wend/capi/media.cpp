#include <wend/capi/media.h>

#include <wend/capi/boundary.h>

#include <cmath>
#include <cstddef>

namespace wend::capi {

PhaseFunction to_phase(std::span<const wend_phase_part> parts) {
    require(parts.size() <= HenyeyGreensteinMixture::max_lobes, "a phase function has 1 to 4 parts");
    HenyeyGreensteinMixture phase;
    float total = 0;
    for (const wend_phase_part& part : parts) {
        require(part.weight > 0 && std::isfinite(part.weight), "the weight of a part must be positive and finite");
        require(std::abs(part.g) < 1, "the mean cosine of a part must be between -1 and 1");
        phase.add(part.weight, part.g);
        total += part.weight;
    }
    require(std::isfinite(total), "the weights of the parts must have a finite sum");
    // One part is less work by itself.
    return parts.empty()       ? PhaseFunction()
           : parts.size() == 1 ? PhaseFunction(HenyeyGreenstein{parts[0].g})
                               : PhaseFunction(phase);
}

HomogeneousMedium to_medium(const wend_medium* medium) {
    require(medium, "the medium is null");
    HomogeneousMedium result;
    result.absorption = to_weight(medium->absorption, "the absorption coefficients");
    result.scattering = to_weight(medium->scattering, "the scattering coefficients");
    require(is_finite(result.extinction()), "the coefficients of a medium must have finite sums");
    require(medium->phase_parts >= 0 && medium->phase_parts <= 4, "a medium has 0 to 4 parts of a phase function");
    result.phase = to_phase({medium->phase, static_cast<std::size_t>(medium->phase_parts)});
    return result;
}

}  // namespace wend::capi
