#include <wend/decision/lamp_guide.h>
#include <wend/numeric/fast_exp.h>

#include <algorithm>

namespace wend {

LampGuide::LampGuide(const LampView& view, const Rgb& extinction, int channels)
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

LampGuide::PerLamp LampGuide::densities(const Vec3& w) const {
    PerLamp result{};
    for (std::size_t j = 0; j < size_; ++j) {
        const Vmf& lobe = lamps_[j].lobe;
        result[j] = lamps_[j].peak * fast_exp(-0.5f * lobe.kappa * length_squared(w - lobe.mean));
    }
    return result;
}

LampGuide::PerLamp LampGuide::phases(const PhaseFunction& phase, const Vec3& before) const {
    PerLamp result{};
    for (std::size_t j = 0; j < size_; ++j) {
        result[j] = phase.evaluate(dot(before, lamps_[j].lobe.mean));
    }
    return result;
}

}  // namespace wend
