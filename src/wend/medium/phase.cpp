#include <wend/medium/phase.h>

#include <wend/core/contracts.h>
#include <wend/core/error.h>

#include <algorithm>

namespace wend {

void HenyeyGreensteinMixture::add(float weight, float g) {
    WEND_EXPECT(count_ < max_lobes && weight > 0 && std::abs(g) < 1);
    weight_[static_cast<std::size_t>(count_)] = weight;
    lobe_[static_cast<std::size_t>(count_)] = {g};
    total_ += weight;
    ++count_;
}

float HenyeyGreensteinMixture::evaluate(float cosine) const {
    float sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
        sum += weight_[i] * lobe_[i].evaluate(cosine);
    }
    return sum / total_;
}

float HenyeyGreensteinMixture::sample_cosine(float u) const {
    float rest = u * total_;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
        if (rest < weight_[i] || i + 1 == static_cast<std::size_t>(count_)) {
            return lobe_[i].sample_cosine(std::min(rest / weight_[i], one_minus_epsilon));
        }
        rest -= weight_[i];
    }
    return 1;
}

float HenyeyGreensteinMixture::mean_cosine() const {
    float sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
        sum += weight_[i] * lobe_[i].g;
    }
    return sum / total_;
}

bool HenyeyGreensteinMixture::is_isotropic() const {
    return std::all_of(lobe_.begin(), lobe_.begin() + count_, [](const auto& lobe) { return lobe.is_isotropic(); });
}

double HenyeyGreensteinMixture::moment(int degree) const {
    double sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
        sum += static_cast<double>(weight_[i]) * lobe_[i].moment(degree);
    }
    return sum / static_cast<double>(total_);
}

float HenyeyGreensteinMixture::convolved(const Vec3& before, const Vec3& mean) const {
    float sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
        sum += weight_[i] * lobe_[i].convolved(before, mean);
    }
    return sum / total_;
}

PhaseFunction::PhaseFunction(Variant kind) : kind_(std::move(kind)) {
    if (!(std::abs(mean_cosine()) < 1)) {
        throw InputError("a phase function: the mean cosine must be within (-1, 1)");
    }
    lobes_ = std::visit([](const auto& p) { return p.lobes(); }, kind_);
}

}  // namespace wend
