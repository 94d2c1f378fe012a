#include <wend/planar/adjoint.h>

#include <wend/core/vector.h>
#include <wend/medium/fresnel.h>
#include <wend/numeric/interpolation.h>
#include <wend/numeric/quadrature.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace wend {
namespace {

/// Rows of the table of amplitudes over direction, at equal angles.
constexpr int direction_rows = 1025;
/// The source keeps at least this part of its positive terms.
constexpr double least_part = 1e-3;
/// Below this exponent a difference of exponentials is taken from its series.
constexpr double series_limit = 1e-4;

double legendre_sum(const std::vector<double>& coefficients, double mu) {
    double sum = 0, before = 0, p = 1;
    for (std::size_t l = 0; l < coefficients.size(); ++l) {
        sum += coefficients[l] * p;
        const double next =
            (static_cast<double>(2 * l + 1) * mu * p - static_cast<double>(l) * before) / static_cast<double>(l + 1);
        before = p;
        p = next;
    }
    return sum;
}

/// start · (1 - exp(-rate · length)) / rate, where `end` = start · exp(-rate · length) is known without overflow.
inline double attenuated_integral(double start, double end, double rate, double length) {
    const double z = rate * length;
    return std::abs(z) < series_limit ? start * length * (1 - z * (0.5 - z / 6)) : (start - end) / rate;
}

}  // namespace

double PlanarBoundary::reflectance(double t) const {
    return ior == 1 ? 0 : fresnel_dielectric(-t, ior);
}

double PlanarBoundary::illumination_inside(double t) const {
    if (!illumination) {
        return 0;
    }
    if (ior == 1) {
        return illumination(t);
    }
    if (rough) {
        return rough->transmitted_from_inside(t, illumination);
    }
    const double cos2 = 1 - (1 - t * t) * ior * ior;
    return cos2 <= 0 ? 0 : (1 - reflectance(t)) * illumination(std::sqrt(cos2));
}

PlanarAdjoint::PlanarAdjoint(const PlanarModes& modes, PlanarSlab slab)
    : slab_(std::move(slab)), count_(static_cast<int>(modes.modes.size())) {
    if (count_ > max_modes) {
        throw std::invalid_argument("a planar adjoint has too many modes");
    }
    const bool half_space = std::isinf(slab_.thickness);
    bool directional = false;
    for (std::size_t k = 0; k < modes.modes.size(); ++k) {
        const PlanarModes::Mode& mode = modes.modes[k];
        bool finite = std::isfinite(mode.near) && std::isfinite(mode.far) && mode.length > 0;
        for (const double coefficient : mode.shape) {
            finite = finite && std::isfinite(coefficient);
        }
        if (!finite) {
            throw std::invalid_argument("a mode of a planar adjoint is not finite");
        }
        rate_[k] = 1 / mode.length;
        through_[k] = half_space ? 0 : std::exp(-slab_.thickness * rate_[k]);
        has_far_ = has_far_ || (mode.far != 0 && !half_space);
        directional = directional || mode.shape.size() > 1;
    }
    rows_ = directional ? direction_rows : 1;
    const auto size = static_cast<std::size_t>(rows_) * modes.modes.size();
    near_.resize(size);
    far_.resize(size);
    for (int row = 0; row < rows_; ++row) {
        const double mu = rows_ == 1 ? 0 : std::cos(std::numbers::pi * row / (rows_ - 1));
        for (std::size_t k = 0; k < modes.modes.size(); ++k) {
            const PlanarModes::Mode& mode = modes.modes[k];
            const std::size_t at = static_cast<std::size_t>(row) * modes.modes.size() + k;
            near_[at] = mode.near * legendre_sum(mode.shape, mu);
            far_[at] = has_far_ ? mode.far * legendre_sum(mode.shape, -mu) : 0;
            all_positive_ = all_positive_ && near_[at] >= 0 && far_[at] >= 0;
        }
    }
    at(0, ends_[0]);
    if (!half_space) {
        at(slab_.thickness, ends_[1]);
    }
    tabulate_rough_arrivals();
}

// Amplitudes are linear in the cosine's angle between rows, so what holds at the rows holds between them.
double PlanarAdjoint::keep_positive() {
    if (all_positive_) {
        return 1;
    }
    raise_longest(near_);
    raise_longest(far_);
    constexpr int depths = 400;
    const double reach = std::isinf(slab_.thickness) ? 1e4 : slab_.thickness;
    std::vector<double> lower(static_cast<std::size_t>(rows_), 1.0);
    const auto modes = static_cast<std::size_t>(count_);
    for (int i = 0; i <= depths; ++i) {
        // Dense at both ends, down to a millionth of the thickness.
        const double u = static_cast<double>(i) / depths;
        const double v = has_far_ ? std::min(u, 1 - u) * 2 : u;
        const double from_end = v == 0 ? 0 : std::pow(10.0, 7 * (v - 1)) * (has_far_ ? reach / 2 : reach);
        Site site;
        at(has_far_ && u > 0.5 ? slab_.thickness - from_end : from_end, site);
        for (std::size_t row = 0; row < lower.size(); ++row) {
            double positive = 0, negative = 0;
            for (std::size_t k = 0; k < modes; ++k) {
                const double near = near_[row * modes + k] * site.near[k];
                const double far = has_far_ ? far_[row * modes + k] * site.far[k] : 0;
                positive += std::max(near, 0.0) + std::max(far, 0.0);
                negative -= std::min(near, 0.0) + std::min(far, 0.0);
            }
            if (negative > 0) {
                lower[row] = std::min(lower[row], (1 - least_part) * positive / negative);
            }
        }
    }
    const double lowest = *std::min_element(lower.begin(), lower.end());
    if (lowest < 1) {
        for (std::vector<double>* table : {&near_, &far_}) {
            for (std::size_t i = 0; i < table->size(); ++i) {
                double& amplitude = (*table)[i];
                amplitude = amplitude < 0 ? amplitude * lower[i / modes] : amplitude;
            }
        }
    }
    tabulate_rough_arrivals();
    return lowest;
}

// Deep inside the longest mode is all there is. It comes first, and is positive in truth; the sum of its first Legendre
// polynomials may not be.
void PlanarAdjoint::raise_longest(std::vector<double>& amplitudes) const {
    const auto modes = static_cast<std::size_t>(count_);
    double largest = 0, sum = 0;
    for (std::size_t i = 0; i < amplitudes.size(); i += modes) {
        largest = std::max(largest, amplitudes[i]);
        sum += amplitudes[i];
    }
    for (std::size_t i = 0; sum > 0 && i < amplitudes.size(); i += modes) {
        amplitudes[i] = amplitudes[i] < 0 ? least_part * largest : amplitudes[i];
    }
}

void PlanarAdjoint::at(double depth, Site& site) const {
    site.depth = depth;
    for (int k = 0; k < count_; ++k) {
        const auto i = static_cast<std::size_t>(k);
        site.near[i] = std::exp(-depth * rate_[i]);
    }
    if (has_far_) {
        const double rest = slab_.thickness - depth;
        for (int k = 0; k < count_; ++k) {
            const auto i = static_cast<std::size_t>(k);
            site.far[i] = std::exp(-rest * rate_[i]);
        }
    }
}

double PlanarAdjoint::radiance(double depth, double mu) const {
    Site site;
    at(depth, site);
    return ray(site, mu).radiance();
}

/// Calls use(near amplitudes, far amplitudes) for a direction.
template <class Use>
void PlanarAdjoint::with_amplitudes(double mu, const Use& use) const {
    if (rows_ == 1) {
        use(near_.data(), far_.data());
        return;
    }
    const double row = std::acos(std::clamp(mu, -1.0, 1.0)) * ((rows_ - 1) / std::numbers::pi);
    const int below = std::min(static_cast<int>(row), rows_ - 2);
    const double f = row - below;
    const std::size_t first = static_cast<std::size_t>(below) * static_cast<std::size_t>(count_);
    const std::size_t second = first + static_cast<std::size_t>(count_);
    std::array<double, max_modes> near, far;  // NOLINT: the first count_ are set below
    for (std::size_t k = 0; k < static_cast<std::size_t>(count_); ++k) {
        near[k] = (1 - f) * near_[first + k] + f * near_[second + k];
    }
    if (has_far_) {
        for (std::size_t k = 0; k < static_cast<std::size_t>(count_); ++k) {
            far[k] = (1 - f) * far_[first + k] + f * far_[second + k];
        }
    }
    use(near.data(), far.data());
}

void PlanarAdjoint::trace(const Site& site, double mu, Ray& ray) const {
    const double t = std::max(std::abs(mu), 1e-300);
    ray.cosine = t;
    ray.deeper = mu >= 0;
    ray.length = (ray.deeper ? slab_.thickness - site.depth : site.depth) / t;
    ray.pass = std::exp(-ray.length);
    with_amplitudes(mu, [&](const double* near, const double* far) {
        double sum = 0, positive = 0;
        for (std::size_t k = 0; k < static_cast<std::size_t>(count_); ++k) {
            const double rate = ray.deeper ? 1 + t * rate_[k] : 1 - t * rate_[k];
            const double end = ray.deeper ? through_[k] * ray.pass : ray.pass;
            ray.near[k] = near[k] * attenuated_integral(site.near[k], end, rate, ray.length);
            sum += ray.near[k];
            positive += std::max(ray.near[k], 0.0);
        }
        if (has_far_) {
            for (std::size_t k = 0; k < static_cast<std::size_t>(count_); ++k) {
                const double rate = ray.deeper ? 1 - t * rate_[k] : 1 + t * rate_[k];
                const double end = ray.deeper ? ray.pass : through_[k] * ray.pass;
                ray.far[k] = far[k] * attenuated_integral(site.far[k], end, rate, ray.length);
                sum += ray.far[k];
                positive += std::max(ray.far[k], 0.0);
            }
        }
        ray.scattered = sum;
        ray.positive = positive;
    });
}

PlanarAdjoint::Ray PlanarAdjoint::ray(const Site& site, double mu) const {
    Ray ray;
    trace(site, mu, ray);
    ray.arrival = ray.deeper && std::isinf(slab_.thickness) ? 0 : arrival(ray.deeper, ray.cosine);
    return ray;
}

PlanarAdjoint::Source PlanarAdjoint::source(const Site& site, double mu) const {
    Source source;
    with_amplitudes(mu, [&](const double* near, const double* far) {
        for (std::size_t k = 0; k < static_cast<std::size_t>(count_); ++k) {
            const double term = near[k] * site.near[k];
            source.value += term;
            source.positive += std::max(term, 0.0);
        }
        if (has_far_) {
            for (std::size_t k = 0; k < static_cast<std::size_t>(count_); ++k) {
                const double term = far[k] * site.far[k];
                source.value += term;
                source.positive += std::max(term, 0.0);
            }
        }
    });
    return source;
}

double PlanarAdjoint::arrival(bool at_far, double t) const {
    const std::vector<double>& table = rough_arrival_[at_far ? 1 : 0];
    return table.empty() ? smooth_arrival(at_far, t) : interpolate(table, t);
}

double PlanarAdjoint::smooth_arrival(bool at_far, double t) const {
    const PlanarBoundary& here = at_far ? slab_.far : slab_.near;
    const double leaving = here.illumination_inside(t);
    if (here.ior == 1) {
        return leaving;
    }
    // What is reflected crosses the medium and may be reflected there, and so on: two equations for the two values.
    Ray inward;
    trace(ends_[at_far ? 1 : 0], at_far ? -t : t, inward);
    const double reflectance = here.reflectance(t);
    if (std::isinf(slab_.thickness)) {
        return leaving + reflectance * inward.scattered;
    }
    const PlanarBoundary& there = at_far ? slab_.near : slab_.far;
    if (there.rough) {
        return leaving + reflectance * (inward.scattered + inward.pass * arrival(!at_far, t));
    }
    Ray back;
    trace(ends_[at_far ? 0 : 1], at_far ? t : -t, back);
    const double there_reflectance = there.reflectance(t);
    const double there_leaving = there.illumination_inside(t);
    const double once =
        leaving + reflectance * (inward.scattered + inward.pass * (there_leaving + there_reflectance * back.scattered));
    return once / (1 - reflectance * there_reflectance * inward.pass * inward.pass);
}

// What a rough boundary reflects goes into all cosines. Two of them see each other through the slab: iterated.
void PlanarAdjoint::tabulate_rough_arrivals() {
    constexpr int steps = 128;
    const Quadrature rule = gauss_legendre(48);
    const bool half_space = std::isinf(slab_.thickness);
    struct Side {
        std::vector<double> leaving;
        std::vector<std::vector<double>> reflection;  // by step and node of the rule, weights included
    };
    std::array<Side, 2> sides;
    for (std::size_t side = 0; side < (half_space ? 1u : 2u); ++side) {
        const PlanarBoundary& boundary = side == 0 ? slab_.near : slab_.far;
        if (!boundary.rough) {
            continue;
        }
        for (int i = 0; i <= steps; ++i) {
            const double t = std::max(static_cast<double>(i) / steps, 1e-4);
            sides[side].leaving.push_back(boundary.illumination_inside(t));
            std::vector<double>& row = sides[side].reflection.emplace_back();
            for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
                row.push_back(rule.weights[j] * boundary.rough->reflection(t, rule.nodes[j]));
            }
        }
        rough_arrival_[side] = sides[side].leaving;
    }
    // Each round trip through the slab loses part of it, however thin: the bound is never met in practice.
    constexpr int rounds = 1000;
    constexpr double enough = 1e-13;
    double change = 1;
    for (int round = 0; round < rounds && change > enough; ++round) {
        change = 0;
        for (std::size_t side = 0; side < sides.size(); ++side) {
            if (sides[side].leaving.empty()) {
                continue;
            }
            std::vector<double> inward;
            for (const double t : rule.nodes) {
                Ray ray;
                trace(ends_[side], side == 0 ? t : -t, ray);
                ray.arrival = half_space ? 0 : arrival(side == 0, t);
                inward.push_back(ray.radiance());
            }
            for (std::size_t i = 0; i < sides[side].leaving.size(); ++i) {
                double value = sides[side].leaving[i];
                for (std::size_t j = 0; j < inward.size(); ++j) {
                    value += sides[side].reflection[i][j] * inward[j];
                }
                change = std::max(change, std::abs(value - rough_arrival_[side][i]));
                rough_arrival_[side][i] = value;
            }
        }
        change = half_space ? 0 : change;
    }
}

}  // namespace wend
