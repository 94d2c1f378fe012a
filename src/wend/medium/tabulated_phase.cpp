#include <wend/core/contracts.h>
#include <wend/core/error.h>
#include <wend/medium/phase.h>
#include <wend/numeric/legendre.h>
#include <wend/sampling/vmf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace wend {
namespace {

/// Of the table of convolutions, by the mean cosine and by the angle.
constexpr int blurs = 65;
constexpr double most_blurred = 0.98;
constexpr int blurred_angles = 257;

/// Closer together towards straight on, where functions are peaked.
double blurred_angle(int i) {
    return static_cast<double>(pi) * sqr(static_cast<double>(i) / (blurred_angles - 1));
}

/// Evenly in -log(1 - m): peaks grow as 1 / (1 - m)².
double blur_position(double mean_cosine) {
    return std::log1p(-mean_cosine) / std::log1p(-most_blurred) * (blurs - 1);
}
double blur_at(int i) {
    return -std::expm1(std::log1p(-most_blurred) * i / (blurs - 1));
}

void check(std::span<const double> cosines, std::span<const double> values) {
    if (cosines.size() < 2 || cosines.size() != values.size()) {
        throw InputError("a phase function by a table needs as many angles as values, two at least");
    }
    if (std::abs(cosines.front() + 1) > 1e-6 || std::abs(cosines.back() - 1) > 1e-6) {
        throw InputError("a phase function by a table must reach from straight on to straight back");
    }
    for (std::size_t i = 0; i < cosines.size(); ++i) {
        if (!std::isfinite(values[i]) || values[i] < 0) {
            throw InputError("a phase function by a table: values must be finite and not negative");
        }
        if (i > 0 && !(cosines[i] > cosines[i - 1])) {
            throw InputError("a phase function by a table: angles must be in order, each once");
        }
    }
}

}  // namespace

struct TabulatedPhase::Table {
    std::vector<float> cosine;
    std::vector<float> density;      ///< per steradian
    std::vector<double> cumulative;  ///< up to each node
    std::vector<double> moments;
    std::vector<float> blurred;  ///< by blur, then by angle

    /// Index of the piece that a cosine lies in.
    std::size_t piece(float c) const {
        const auto above = std::upper_bound(cosine.begin() + 1, cosine.end() - 1, c);
        return static_cast<std::size_t>(above - cosine.begin()) - 1;
    }

    void compute_moments();
    void compute_blurred();
};

TabulatedPhase::TabulatedPhase(std::span<const double> cosines, std::span<const double> values) {
    check(cosines, values);
    auto table = std::make_shared<Table>();
    // Nodes that single precision cannot tell apart are one.
    std::vector<double> kept;
    for (std::size_t i = 0; i < cosines.size(); ++i) {
        const auto c = std::clamp(static_cast<float>(cosines[i]), -1.0f, 1.0f);
        if (table->cosine.empty() || c > table->cosine.back()) {
            table->cosine.push_back(c);
            kept.push_back(values[i]);
        }
    }
    const std::size_t n = table->cosine.size();
    if (n < 2) {
        throw InputError("a phase function by a table needs angles further apart");
    }
    table->cumulative.assign(n, 0);
    for (std::size_t i = 1; i < n; ++i) {
        const double width = static_cast<double>(table->cosine[i]) - static_cast<double>(table->cosine[i - 1]);
        table->cumulative[i] =
            table->cumulative[i - 1] + 2 * static_cast<double>(pi) * width * 0.5 * (kept[i] + kept[i - 1]);
    }
    const double total = table->cumulative.back();
    if (!(total > 0) || !std::isfinite(total)) {
        throw InputError("a phase function by a table: some of the values must be above 0");
    }
    for (std::size_t i = 0; i < n; ++i) {
        table->density.push_back(static_cast<float>(kept[i] / total));
        table->cumulative[i] /= total;
    }
    table->compute_moments();
    table->compute_blurred();
    table_ = std::move(table);
}

void TabulatedPhase::Table::compute_moments() {
    moments.assign(most_moments, 0);
    std::vector<double> polynomials(most_moments);
    // Gauss's rule of three points, in parts that are short against the last polynomial's waves.
    constexpr std::array place = {-0.774596669241483, 0.0, 0.774596669241483};
    constexpr std::array weight = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    constexpr double longest = 0.001;
    for (std::size_t i = 1; i < cosine.size(); ++i) {
        const double begin = static_cast<double>(cosine[i - 1]), width = static_cast<double>(cosine[i]) - begin;
        const auto parts = static_cast<int>(std::ceil(width / longest));
        for (int part = 0; part < parts; ++part) {
            for (std::size_t k = 0; k < place.size(); ++k) {
                const double t = (part + 0.5 + 0.5 * place[k]) / parts;
                const double d = std::lerp(static_cast<double>(density[i - 1]), static_cast<double>(density[i]), t);
                legendre_polynomials(begin + t * width, polynomials);
                const double share = 2 * static_cast<double>(pi) * d * width / parts * weight[k];
                for (std::size_t l = 0; l < moments.size(); ++l) {
                    moments[l] += share * polynomials[l];
                }
            }
        }
    }
}

void TabulatedPhase::Table::compute_blurred() {
    blurred.resize(static_cast<std::size_t>(blurs) * blurred_angles);
    std::vector<double> polynomials(most_moments);
    for (int a = 0; a < blurred_angles; ++a) {
        legendre_polynomials(std::cos(blurred_angle(a)), polynomials);
        for (int b = 0; b < blurs; ++b) {
            const double m = blur_at(b);
            double sum = 0, power = 1;
            for (std::size_t l = 0; l < moments.size() && power > 1e-12; ++l, power *= m) {
                sum += (2 * static_cast<double>(l) + 1) * moments[l] * power * polynomials[l];
            }
            blurred[static_cast<std::size_t>(b * blurred_angles + a)] =
                static_cast<float>(std::max(sum * static_cast<double>(inv_4pi), 0.0));
        }
    }
}

float TabulatedPhase::evaluate(float c) const {
    const std::size_t i = table_->piece(c);
    const float t = (c - table_->cosine[i]) / (table_->cosine[i + 1] - table_->cosine[i]);
    return std::lerp(table_->density[i], table_->density[i + 1], std::clamp(t, 0.0f, 1.0f));
}

float TabulatedPhase::sample_cosine(float u) const {
    WEND_EXPECT(u >= 0 && u < 1);
    const auto& cumulative = table_->cumulative;
    const auto above = std::upper_bound(cumulative.begin() + 1, cumulative.end() - 1, static_cast<double>(u));
    const auto i = static_cast<std::size_t>(above - cumulative.begin()) - 1;
    const double c0 = static_cast<double>(table_->cosine[i]), width = static_cast<double>(table_->cosine[i + 1]) - c0;
    const double f0 = static_cast<double>(table_->density[i]), f1 = static_cast<double>(table_->density[i + 1]);
    // The part of the piece's mass f0 t + (f1 - f0) t² / 2, solved without cancellation.
    const double mass = (static_cast<double>(u) - cumulative[i]) / (2 * static_cast<double>(pi) * width);
    const double root = f0 + std::sqrt(std::max(f0 * f0 + 2 * (f1 - f0) * mass, 0.0));
    const double t = root > 0 ? std::clamp(2 * mass / root, 0.0, 1.0) : 0.5;
    return static_cast<float>(c0 + t * width);
}

bool TabulatedPhase::is_isotropic() const {
    const auto [low, high] = std::minmax_element(table_->density.begin(), table_->density.end());
    return *high - *low <= 1e-6f * *high;
}

double TabulatedPhase::moment(int degree) const {
    return degree < most_moments ? table_->moments[static_cast<std::size_t>(degree)] : 0.0;
}

float TabulatedPhase::convolved(const Vec3& before, const Vec3& mean) const {
    const float size = length(mean);
    const float cosine = size > 0 ? std::clamp(dot(before, mean) / size, -1.0f, 1.0f) : 1.0f;
    const float b = std::min(static_cast<float>(blur_position(std::min(static_cast<double>(size), most_blurred))),
                             static_cast<float>(blurs - 1));
    const float a = std::sqrt(std::acos(cosine) * inv_pi) * (blurred_angles - 1);
    const int b0 = std::min(static_cast<int>(b), blurs - 2), a0 = std::min(static_cast<int>(a), blurred_angles - 2);
    const float tb = b - static_cast<float>(b0), ta = a - static_cast<float>(a0);
    const float* row = &table_->blurred[static_cast<std::size_t>(b0 * blurred_angles + a0)];
    return std::lerp(std::lerp(row[0], row[1], ta), std::lerp(row[blurred_angles], row[blurred_angles + 1], ta), tb);
}

AxialLobes TabulatedPhase::lobes() const {
    // Concentrations are fixed, a factor apart in both directions; shares follow. Where the sharpest forward lobe is
    // wider than the function's peak, weights of guided directions vary by as much as it is too low.
    constexpr std::size_t count = AxialLobes::capacity;
    constexpr int backward = 8;
    std::array<float, count> kappa{};
    std::array<double, count> share{};
    for (std::size_t j = 1; j < count; ++j) {
        const int k = static_cast<int>(j) - backward - 1;
        constexpr int sharpest = static_cast<int>(count) - backward - 2;
        kappa[j] = k < 0 ? -std::exp2(static_cast<float>(j - 1))
                         : std::pow(Vmf::max_kappa, static_cast<float>(k) / static_cast<float>(sharpest));
    }
    share.fill(1.0 / count);
    constexpr int rounds = 200;
    const std::size_t cells = table_->cosine.size() - 1;
    std::vector<double> density(cells * count);
    for (std::size_t i = 0; i < cells; ++i) {
        const float middle = 0.5f * (table_->cosine[i] + table_->cosine[i + 1]);
        for (std::size_t j = 0; j < count; ++j) {
            const float size = std::abs(kappa[j]), along = kappa[j] < 0 ? -middle : middle;
            density[i * count + j] = static_cast<double>(vmf_peak(size) * std::exp(size * (along - 1)));
        }
    }
    for (int round = 0; round < rounds; ++round) {
        std::array<double, count> next{};
        for (std::size_t i = 0; i < cells; ++i) {
            double sum = 0;
            for (std::size_t j = 0; j < count; ++j) {
                sum += share[j] * density[i * count + j];
            }
            const double mass = table_->cumulative[i + 1] - table_->cumulative[i];
            for (std::size_t j = 0; sum > 0 && j < count; ++j) {
                next[j] += mass * share[j] * density[i * count + j] / sum;
            }
        }
        share = next;
    }
    std::vector<AxialLobe> lobes;
    for (std::size_t j = 0; j < count; ++j) {
        if (share[j] > 1e-5) {
            lobes.push_back({static_cast<float>(share[j]), kappa[j]});
        }
    }
    return AxialLobes(lobes);
}

TabulatedPhase tabulate_phase(const std::function<double(double)>& by_angle) {
    // From straight on: a factor apart as long as that is the shorter step.
    constexpr double least = 1e-3, factor = 1.02, step = 0.01;
    std::vector<double> angles = {0, least};
    while (angles.back() < static_cast<double>(pi) - step) {
        angles.push_back(angles.back() + std::min(angles.back() * (factor - 1), step));
    }
    angles.push_back(static_cast<double>(pi));
    std::vector<double> cosines, values;
    for (std::size_t i = angles.size(); i-- > 0;) {
        cosines.push_back(std::cos(angles[i]));
        values.push_back(by_angle(std::max(angles[i], least)));
    }
    cosines.front() = -1;
    // What is closer to straight on than that keeps its share.
    constexpr int steps = 1000;
    constexpr double nearest = 1e-12;
    double share = 0;
    for (int i = 0; i < steps; ++i) {
        const double angle = least * std::pow(nearest, (i + 0.5) / steps);
        share += by_angle(angle) * std::sin(angle) * angle * -std::log(nearest) / steps;
    }
    const double width = 2 * sqr(std::sin(least / 2));
    values.back() = std::max(2 * share / width - by_angle(least), 0.0);
    return TabulatedPhase(cosines, values);
}

TabulatedPhase fournier_forand(double index, double slope) {
    if (!(index > 1 && index < 10)) {
        throw InputError("Fournier and Forand's phase function: the index must be above 1 and below 10");
    }
    if (!(slope > 3 && slope < 5)) {
        throw InputError("Fournier and Forand's phase function: the slope must be between 3 and 5");
    }
    const double v = (3 - slope) / 2, unit = 4 / (3 * sqr(index - 1));
    const double back = std::pow(unit, v);  // delta^v at straight back, where delta is `unit`
    return tabulate_phase([&](double angle) {
        const double s2 = sqr(std::sin(angle / 2));
        // Where delta is 1, the function goes on, but its terms do not.
        const double delta = std::abs(unit * s2 - 1) < 1e-4 ? 1 + 1e-4 : unit * s2, power = std::pow(delta, v);
        const double c = std::cos(angle);
        const double main =
            (v * (1 - delta) - (1 - power) + (delta * (1 - power) - v * (1 - delta)) / s2) / (sqr(1 - delta) * power);
        // Both terms have 1 / (4 pi), which the table's normalization makes up for.
        const double rest = (1 - back) / (4 * (unit - 1) * back) * (3 * c * c - 1);
        return std::max(main + rest, 0.0);
    });
}

TabulatedPhase fog_droplets(double diameter) {
    if (!(diameter >= 5 && diameter <= 50)) {
        throw InputError("the diameter of fog droplets must be from 5 to 50 micrometres");
    }
    const HenyeyGreenstein peak{static_cast<float>(std::exp(-0.0990567 / (diameter - 1.67154)))};
    const Draine rest(static_cast<float>(std::exp(-2.20679 / (diameter + 3.91029) - 0.428934)),
                      static_cast<float>(std::exp(3.62489 - 8.29288 / (diameter + 5.52825))));
    const double share = std::exp(-0.599085 / (diameter - 0.641583) - 0.665888);
    return tabulate_phase([&](double angle) {
        const auto c = static_cast<float>(std::cos(angle));
        return (1 - share) * static_cast<double>(peak.evaluate(c)) + share * static_cast<double>(rest.evaluate(c));
    });
}

}  // namespace wend
