// Phase functions. A cosine is that between the directions of propagation before and after the collision: 1 is straight
// on. All densities are per steradian and normalized, so evaluate() is also the density of sample().
#pragma once

#include <wend/core/export.h>
#include <wend/core/vector.h>
#include <wend/medium/draine.h>
#include <wend/sampling/axial_lobes.h>
#include <wend/sampling/warp.h>

#include <array>
#include <concepts>
#include <functional>
#include <memory>
#include <span>
#include <variant>

namespace wend {

/// A function that is linear in the scattering cosine between the nodes of a table, normalized. Copies share the table.
class WEND_API TabulatedPhase {
public:
    /// `cosines` increase from -1 to 1, `values` are relative to each other. Throws InputError unless there are two or
    /// more nodes, and the values are finite, not negative and not all 0.
    TabulatedPhase(std::span<const double> cosines, std::span<const double> values);

    /// Density per steradian.
    float evaluate(float cosine) const;
    /// Inverts the cumulative distribution, which grows with the cosine; u in [0,1).
    float sample_cosine(float u) const;
    /// moment(1).
    float mean_cosine() const { return static_cast<float>(moment(1)); }
    /// Whether all directions are alike.
    bool is_isotropic() const;
    /// The integral of the function times Legendre's polynomial of the scattering cosine; 0 beyond most_moments, where
    /// narrow peaks still have some.
    double moment(int degree) const;
    /// As many lobes as there is room for, fitted by expectation maximization.
    AxialLobes lobes() const;
    /// As PhaseFunction::convolved(), by a table; mean cosines beyond 0.98 are taken for that.
    float convolved(const Vec3& before, const Vec3& mean) const;

    /// How many moments are kept.
    static constexpr int most_moments = 1024;

private:
    struct Table;
    std::shared_ptr<const Table> table_;
};

/// The table of a function of the scattering angle (radians), dense towards forward scattering. Below a thousandth of a
/// radian, where single precision ends, it keeps the share of all light, but not the shape.
WEND_API TabulatedPhase tabulate_phase(const std::function<double(double)>& by_angle);

/// Fournier and Forand's function (fournier1999) of particles in water whose sizes follow a power law. `index` of
/// refraction relative to the water, above 1; `slope` of the law, in (3, 5). Throws InputError otherwise.
WEND_API TabulatedPhase fournier_forand(double index, double slope);

/// Mie's function of the droplets of fog or clouds by their diameter in micrometres, from 5 to 50, as a mixture of
/// Henyey and Greenstein's function with Draine's (jendersie2023). Throws InputError beyond.
WEND_API TabulatedPhase fog_droplets(double diameter);

/// Beyond this g the picture of a phase function in lobes is that of ±largest_pictured_g.
inline constexpr float largest_pictured_g = 0.99f;

/// Henyey and Greenstein's phase function with mean cosine g in (-1, 1).
struct WEND_API HenyeyGreenstein {
    float g = 0;  ///< mean cosine: positive scatters forwards

    /// Density per steradian.
    float evaluate(float cosine) const {
        const float d = 1 + g * (g - 2 * cosine);
        return inv_4pi * (1 - g * g) / (d * std::sqrt(d));
    }

    /// Inverts the cumulative distribution, which grows with the cosine; u in [0,1). The first form has no
    /// cancellation near g = 0, the second is accurate near |g| = 1; both are exact.
    float sample_cosine(float u) const {
        const float t = 2 * u - 1;
        if (std::abs(g) < 0.5f) {
            const float numerator = t + g * (0.5f * (3 + t * t) + g * (t + g * 0.5f * (t * t - 1)));
            return std::clamp(numerator / sqr(1 + g * t), -1.0f, 1.0f);
        }
        const float s = (1 - g * g) / (1 + g * t);
        return std::clamp((1 + g * g - s * s) / (2 * g), -1.0f, 1.0f);
    }

    /// As it was given.
    float mean_cosine() const { return g; }
    /// Whether all directions are alike.
    bool is_isotropic() const { return g == 0; }
    /// The integral of the function times Legendre's polynomial of the scattering cosine.
    double moment(int degree) const { return std::pow(static_cast<double>(g), degree); }
    /// Henyey and Greenstein's function as one to five lobes, around +z for the direction of propagation before the
    /// collision. Over the whole sphere, the ratio to the function stays within 1.022 up to |g| = 0.9, 1.065 up to
    /// 0.95, 1.17 up to 0.98 and 1.29 up to 0.99.
    AxialLobes lobes() const;

    /// Convolved with a function of this kind with mean cosine length(mean), around the direction of `mean`, which is
    /// shorter than 1: the mean cosines multiply.
    float convolved(const Vec3& before, const Vec3& mean) const {
        const float square = std::min(g * g * dot(mean, mean), 0.9999f);
        const float d = std::max(1 + square - 2 * g * dot(before, mean), 1e-8f);
        return inv_4pi * (1 - square) / (d * std::sqrt(d));
    }
};

/// A convex combination of up to four Henyey-Greenstein functions.
class WEND_API HenyeyGreensteinMixture {
public:
    /// Most functions that can be added.
    static constexpr int max_lobes = 4;

    /// Adds a lobe; weights are relative and must be positive.
    void add(float weight, float g);

    /// How many were added.
    int size() const { return count_; }
    /// The share of a lobe, between 0 and 1.
    float weight(int i) const { return weight_[static_cast<std::size_t>(i)] / total_; }
    /// The function of a lobe, in the order of add().
    const HenyeyGreenstein& lobe(int i) const { return lobe_[static_cast<std::size_t>(i)]; }

    /// Density per steradian: the sum of the parts by their shares.
    float evaluate(float cosine) const;
    /// A cosine of a part, which is chosen by the same number; u in [0,1).
    float sample_cosine(float u) const;
    /// The mean of those of the parts, by their shares.
    float mean_cosine() const;
    /// Whether all parts are isotropic.
    bool is_isotropic() const;
    /// The integral of the function times Legendre's polynomial of the scattering cosine.
    double moment(int degree) const;
    /// The lobes of its parts; the ratio stays within that of the worst part.
    AxialLobes lobes() const;
    /// As PhaseFunction::convolved(), part by part.
    float convolved(const Vec3& before, const Vec3& mean) const;

private:
    int count_ = 0;
    float total_ = 0;
    std::array<float, max_lobes> weight_{};
    std::array<HenyeyGreenstein, max_lobes> lobe_{};
};

/// What a phase function is, as a function of the scattering cosine.
template <class P>
concept PhaseFunctionKind = requires(const P& phase, float number, int degree, const Vec3& v) {
    /// Its density per steradian.
    { phase.evaluate(number) } -> std::same_as<float>;
    /// A cosine from a number in [0,1), exactly in proportion to it.
    { phase.sample_cosine(number) } -> std::same_as<float>;
    { phase.mean_cosine() } -> std::same_as<float>;
    /// Whether it is 1 / (4 pi).
    { phase.is_isotropic() } -> std::same_as<bool>;
    /// The integral of the function times Legendre's polynomial of a degree: 1, the mean cosine, ...
    { phase.moment(degree) } -> std::same_as<double>;
    /// As PhaseFunction::convolved().
    { phase.convolved(v, v) } -> std::same_as<float>;
    /// Its picture around +z for the direction of propagation before the collision, for products with learned mixtures
    /// (docs/theory/learned_field.md).
    { phase.lobes() } -> std::same_as<AxialLobes>;
};

/// The closed set of phase functions.
class WEND_API PhaseFunction {
public:
    /// Any of the kinds.
    using Variant = std::variant<HenyeyGreenstein, HenyeyGreensteinMixture, Draine, TabulatedPhase>;

    /// Isotropic.
    PhaseFunction() = default;
    /// Throws InputError for a mean cosine of -1, 1, beyond, or NaN.
    PhaseFunction(Variant kind);

    /// Density per steradian.
    float evaluate(float cosine) const {
        return std::visit([&](const auto& p) { return p.evaluate(cosine); }, kind_);
    }
    /// A direction of propagation after the collision, given the one before.
    Vec3 sample(const Vec3& before, const Vec2& u) const {
        const float cosine = std::visit([&](const auto& p) { return p.sample_cosine(u.x); }, kind_);
        return Frame::from_z(before).to_world(direction_from_cosine(cosine, u.y));
    }
    /// The mean of the scattering cosine, in (-1, 1).
    float mean_cosine() const {
        return std::visit([](const auto& p) { return p.mean_cosine(); }, kind_);
    }
    /// Whether all directions are alike.
    bool is_isotropic() const {
        return std::visit([](const auto& p) { return p.is_isotropic(); }, kind_);
    }
    /// The integral of the function times Legendre's polynomial of the scattering cosine: 1, the mean cosine, ...
    double moment(int degree) const {
        return std::visit([&](const auto& p) { return p.moment(degree); }, kind_);
    }
    /// Calls f with the function by its kind.
    template <class F>
    void visit(F&& f) const {
        std::visit(f, kind_);
    }
    /// ∫ p(before, ω) h(ω) dω for Henyey and Greenstein's function h around the direction of `mean`, whose mean cosine
    /// is the length of `mean`, less than 1.
    float convolved(const Vec3& before, const Vec3& mean) const {
        return std::visit([&](const auto& p) { return p.convolved(before, mean); }, kind_);
    }
    /// Its picture in von Mises-Fisher lobes, given the direction of propagation before the collision.
    AxialLobes lobes(const Vec3& before) const { return lobes_.around(before); }

private:
    Variant kind_;
    AxialLobes lobes_;
};

static_assert(PhaseFunctionKind<HenyeyGreenstein> && PhaseFunctionKind<HenyeyGreensteinMixture> &&
              PhaseFunctionKind<Draine> && PhaseFunctionKind<TabulatedPhase>);

}  // namespace wend
