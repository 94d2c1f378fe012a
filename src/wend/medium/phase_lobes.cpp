#include <wend/medium/phase.h>

#include <wend/sampling/vmf.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wend {
namespace {

constexpr int most_lobes = 5;
// Draine's function has two for each.
static_assert(most_lobes * std::max(HenyeyGreensteinMixture::max_lobes, 2) <= AxialLobes::capacity);

/// With x = 2 g (1 - cos) / (1 - g)², Henyey and Greenstein's function is (1 + x)^(-3/2) but for a factor, and
///     (1 + x)^(-3/2) ≈ Σ exp(log_share - e^log_rate x)
/// minimizes the largest |log ratio| over 0 <= x <= 4 g / (1 - g)², which is the sphere.
struct Row {
    int lobes;
    float g;
    float log_share[most_lobes];
    float log_rate[most_lobes];
};

/// Where the number of lobes grows, there is a row for either number.
constexpr std::array table = {
    Row{1, 0.0f, {0.000f}, {0.405f}},
    Row{1, 0.0516f, {-0.004f}, {0.300f}},
    Row{1, 0.1f, {-0.015f}, {0.198f}},
    Row{2, 0.1f, {-0.342f, -1.238f}, {-0.297f, 1.205f}},
    Row{2, 0.1865f, {-0.505f, -0.928f}, {-0.502f, 1.027f}},
    Row{2, 0.2702f, {-0.705f, -0.688f}, {-0.723f, 0.849f}},
    Row{2, 0.35f, {-0.941f, -0.510f}, {-0.960f, 0.673f}},
    Row{3, 0.35f, {-1.354f, -0.655f, -1.506f}, {-1.281f, 0.211f, 1.245f}},
    Row{3, 0.442f, {-1.734f, -0.720f, -1.094f}, {-1.591f, -0.061f, 1.049f}},
    Row{3, 0.5255f, {-2.153f, -0.849f, -0.796f}, {-1.916f, -0.338f, 0.865f}},
    Row{3, 0.6f, {-2.603f, -1.029f, -0.584f}, {-2.254f, -0.617f, 0.691f}},
    Row{4, 0.6f, {-2.965f, -1.535f, -0.820f, -1.233f}, {-2.490f, -0.970f, 0.109f, 1.108f}},
    Row{4, 0.6796f, {-3.571f, -1.939f, -0.881f, -0.892f}, {-2.922f, -1.357f, -0.189f, 0.921f}},
    Row{4, 0.7458f, {-4.203f, -2.380f, -1.010f, -0.655f}, {-3.365f, -1.747f, -0.479f, 0.749f}},
    Row{4, 0.8f, {-4.855f, -2.845f, -1.188f, -0.490f}, {-3.818f, -2.139f, -0.762f, 0.588f}},
    Row{5, 0.8f, {-5.160f, -3.395f, -1.963f, -0.892f, -0.900f}, {-4.004f, -2.440f, -1.274f, -0.175f, 0.925f}},
    Row{5, 0.854f, {-6.019f, -4.095f, -2.408f, -1.018f, -0.652f}, {-4.592f, -2.973f, -1.704f, -0.480f, 0.746f}},
    Row{5, 0.8942f, {-6.895f, -4.807f, -2.881f, -1.200f, -0.485f}, {-5.190f, -3.507f, -2.125f, -0.773f, 0.581f}},
    Row{5, 0.9238f, {-7.782f, -5.522f, -3.370f, -1.419f, -0.372f}, {-5.795f, -4.038f, -2.538f, -1.057f, 0.426f}},
    Row{5, 0.9454f, {-8.678f, -6.240f, -3.870f, -1.664f, -0.301f}, {-6.408f, -4.569f, -2.945f, -1.333f, 0.279f}},
    Row{5, 0.961f, {-9.577f, -6.954f, -4.372f, -1.925f, -0.259f}, {-7.025f, -5.095f, -3.344f, -1.602f, 0.141f}},
    Row{5, 0.9722f, {-10.478f, -7.667f, -4.878f, -2.198f, -0.240f}, {-7.645f, -5.619f, -3.740f, -1.865f, 0.009f}},
    Row{5, 0.9802f, {-11.376f, -8.373f, -5.381f, -2.478f, -0.238f}, {-8.266f, -6.136f, -4.128f, -2.123f, -0.118f}},
    Row{5, 0.9859f, {-12.271f, -9.075f, -5.881f, -2.759f, -0.250f}, {-8.887f, -6.650f, -4.511f, -2.375f, -0.239f}},
    Row{5, 0.99f, {-13.175f, -9.782f, -6.386f, -3.048f, -0.271f}, {-9.517f, -7.166f, -4.896f, -2.628f, -0.360f}},
};
static_assert(table.back().g == largest_pictured_g);

class LobeList {
public:
    void add(float weight, const HenyeyGreenstein& phase) {
        const float g = std::min(std::abs(phase.g), largest_pictured_g);
        std::size_t next = 1;
        while (g > table[next].g) {
            ++next;
        }
        const Row &low = table[next - 1], &high = table[next];
        // Logarithms are smoothest in the artanh of g.
        const float t = (std::atanh(g) - std::atanh(low.g)) / (std::atanh(high.g) - std::atanh(low.g));
        const int first = size_;
        float total = 0;
        for (int j = 0; j < low.lobes; ++j) {
            const float share = std::exp(std::lerp(low.log_share[j], high.log_share[j], t));
            const float rate = std::exp(std::lerp(low.log_rate[j], high.log_rate[j], t));
            const float kappa = rate * 2 * g / sqr(1 - g);
            lobes_[size_] = {share / vmf_peak(kappa), std::copysign(kappa, phase.g)};
            total += lobes_[size_++].weight;
        }
        for (int j = first; j < size_; ++j) {
            lobes_[j].weight *= weight / total;
        }
    }
    operator AxialLobes() const { return AxialLobes(std::span(lobes_, size_)); }

private:
    int size_ = 0;
    AxialLobe lobes_[AxialLobes::capacity];
};

}  // namespace

AxialLobes HenyeyGreenstein::lobes() const {
    LobeList list;
    list.add(1, *this);
    return list;
}

AxialLobes HenyeyGreensteinMixture::lobes() const {
    LobeList list;
    for (int i = 0; i < size(); ++i) {
        list.add(weight(i), lobe(i));
    }
    return list;
}

}  // namespace wend
