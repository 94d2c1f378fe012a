#include <wend/numeric/fast_math.h>
#include <wend/subsurface/interior_walk.h>

#include <algorithm>

namespace wend {

EmitterGuide::EmitterGuide(const EmitterView& view, const Rgb& extinction, int channels)
    : lamps_(view.lamps.data()), size_(std::min(view.lamps.size(), most)), diffuse_(view.diffuse) {
    // Where nothing is expected at all, walks still need somewhere to go.
    constexpr float least = 1e-20f;
    diffuse_ = {std::max(diffuse_.r, least), std::max(diffuse_.g, least), std::max(diffuse_.b, least)};
    for (std::size_t j = 0; j < size_; ++j) {
        const float way = view.depth / lamps_[j].cosine;
        for (int c = 0; c < channels; ++c) {
            arriving_[static_cast<std::size_t>(c)][j] = lamps_[j].fluence * fast_exp(-extinction[c] * way);
        }
    }
}

EmitterGuide::PerEmitter EmitterGuide::densities(const Vec3& w) const {
    PerEmitter result{};
    for (std::size_t j = 0; j < size_; ++j) {
        const Vmf& lobe = lamps_[j].lobe;
        result[j] = lamps_[j].peak * fast_exp(-0.5f * lobe.kappa * length_squared(w - lobe.mean));
    }
    return result;
}

EmitterGuide::PerEmitter EmitterGuide::phases(const PhaseFunction& phase, const Vec3& before) const {
    PerEmitter result{};
    for (std::size_t j = 0; j < size_; ++j) {
        result[j] = phase.evaluate(dot(before, lamps_[j].lobe.mean));
    }
    return result;
}

}  // namespace wend
