#include <wend/medium/draine.h>

#include <wend/core/contracts.h>
#include <wend/core/error.h>
#include <wend/core/vector.h>
#include <wend/medium/phase.h>
#include <wend/sampling/vmf.h>

#include <algorithm>
#include <span>

namespace wend {
namespace {

/// The cosine as a function of x, the cumulative distribution of Henyey and Greenstein's function of 0 <= g < 1 there,
/// and what Draine's adds: with c for the cosine,
///     ∫ c² dx = x (m² + (1 - g) (1 + g)^4 x² / (3 d³)),  m = (1 - g - x (1 + g²)) / d,  d = 1 - g + 2 g x.
/// Nothing cancels at any g.
struct Quantile {
    float cosine, sum_of_squares;

    Quantile(float g, float x) {
        const float inverse = 1 / (1 - g + 2 * g * x);
        const float y = x * inverse;
        const float rise = 2 * (1 + g) * y;
        cosine = rise - 1 + g * rise * (1 - g) * (1 - x) * inverse;
        const float m = (1 - g - x * (1 + g * g)) * inverse;
        sum_of_squares = x * (m * m + (1 - g) * sqr(sqr(1 + g)) * y * y * inverse * (1.0f / 3));
    }
};

}  // namespace

Draine::Draine(float g, float alpha) : g_(g), alpha_(alpha) {
    if (!(std::abs(g) < 1)) {
        throw InputError("a phase function: g must be within (-1, 1)");
    }
    if (!(alpha >= 0 && alpha <= largest_alpha)) {
        throw InputError("a phase function: alpha must be within 0 and a million");
    }
    total_ = 1 + alpha * (1 + 2 * g * g) / 3;
    factor_ = inv_4pi * (1 - g * g) / total_;
    // Where the cosine is 0, the slope is least (below): the first step from there goes beyond any solution.
    const float size = std::abs(g), square = 1 + g * g;
    const float middle = (1 - size) / (square + (1 + size) * std::sqrt(square));
    for (int i = 0; i <= steps; ++i) {
        starts_[static_cast<std::size_t>(i)] = search(static_cast<float>(i) / steps, middle);
    }
}

float Draine::search(float u, float x) const {
    // In x, the distribution is (x + alpha ∫ c² dx) / total. Its slope grows away from where c = 0. So Newton's method
    // passes the solution with the first step, if at all, and all others go towards it.
    const float size = std::abs(g_), wanted = total_ * u;
    // A step of 1e-4 leaves less than 1e-7 in u. The cap is for cosines close to 0 at huge alpha.
    constexpr int most_steps = 20;
    constexpr float small = 1e-4f;
    for (int i = 0; i < most_steps; ++i) {
        const Quantile q(size, x);
        const float step = (x + alpha_ * q.sum_of_squares - wanted) / (1 + alpha_ * q.cosine * q.cosine);
        x = std::clamp(x - step, 0.0f, 1.0f);
        if (!(std::abs(step) > small * x)) {
            break;
        }
    }
    return x;
}

float Draine::sample_cosine(float u) const {
    WEND_EXPECT(u >= 0 && u < 1);
    const float mirrored = g_ < 0 ? 1 - u : u;
    const float at = mirrored * steps;
    const auto i = static_cast<std::size_t>(std::min(static_cast<int>(at), steps - 1));
    const float start = starts_[i] + (at - static_cast<float>(i)) * (starts_[i + 1] - starts_[i]);
    const float cosine = std::clamp(Quantile(std::abs(g_), search(mirrored, start)).cosine, -1.0f, 1.0f);
    return g_ < 0 ? -cosine : cosine;
}

double Draine::moment(int degree) const {
    // c² P_l in Legendre's polynomials of degrees l - 2, l and l + 2, each of which has the moment g^degree.
    const double g = g_, l = degree;
    const double above = (l + 1) * (l + 2) / ((2 * l + 1) * (2 * l + 3));
    const double same = sqr(l + 1) / ((2 * l + 1) * (2 * l + 3)) + l * l / ((2 * l + 1) * (2 * l - 1));
    double sum = std::pow(g, degree) * (1 + alpha_ * (above * g * g + same));
    if (degree >= 2) {
        sum += alpha_ * l * (l - 1) / ((2 * l + 1) * (2 * l - 1)) * std::pow(g, degree - 2);
    }
    return sum / (1 + alpha_ * (1 + 2 * g * g) / 3);
}

float Draine::convolved(const Vec3& before, const Vec3& mean) const {
    // Be D(x) = 1 + x² - 2 x cos. As cos is (1 + g² - D(g)) / (2 g), the function is a sum of D(g)^(-3/2), D(g)^(-1/2)
    // and D(g)^(1/2). By their Legendre series, the first two turn into functions of D(g |mean|), and the last into one
    // of it and of ∫ s² D(g |mean| s²)^(-1/2) ds over [0,1]. Put together like this, nothing cancels.
    const float g2 = g_ * g_, m2 = std::min(dot(mean, mean), 1.0f), square = std::min(g2 * m2, 0.9999f);
    const float along = dot(before, mean);
    const auto d_at = [&](float s2) { return std::max(1 + s2 * (s2 * square - 2 * g_ * along), 1e-8f); };
    // Gauss's rule of five points over [-1,1], of which the middle has no weight here.
    const float integral = 0.138778f / std::sqrt(d_at(0.289949f)) + 0.194555f / std::sqrt(d_at(0.821162f));
    const float d = d_at(1), power = d * std::sqrt(d);
    const float squares = sqr(g_ * (1 - m2) + 2 * along) + (1 - m2) * (sqr(1 + g2) / (1 - g2) + integral * power);
    return inv_4pi / (total_ * power) * (1 - square + 0.25f * alpha_ * (1 - g2) * squares);
}

AxialLobes Draine::lobes() const {
    const AxialLobes parts = HenyeyGreenstein{g_}.lobes();
    const float k = std::acosh(1 + alpha_);
    std::array<AxialLobe, AxialLobes::capacity> lobes;
    std::size_t size = 0;
    for (int j = 0; j < parts.size(); ++j) {
        for (const float kappa : {parts.kappa(j) + k, parts.kappa(j) - k}) {
            const float amplitude = parts.amplitude(j) * std::exp(std::abs(kappa) - std::abs(parts.kappa(j)) - k);
            lobes[size++] = {amplitude / vmf_peak(std::abs(kappa)), kappa};
        }
    }
    return AxialLobes(std::span(lobes.data(), size));
}

}  // namespace wend
