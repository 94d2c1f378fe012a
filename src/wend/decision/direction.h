// Decision 2: where to go after a collision or from a surface.
#pragma once

#include <wend/adjoint/adjoint.h>
#include <wend/core/colour.h>
#include <wend/core/contracts.h>
#include <wend/core/random.h>
#include <wend/decision/caustic_map.h>
#include <wend/decision/roulette_splitting.h>
#include <wend/medium/phase.h>
#include <wend/sampling/axial_lobes.h>

#include <algorithm>
#include <concepts>
#include <optional>
#include <type_traits>
#include <utility>

namespace wend {

/// A direction drawn from a scattering function or a decision about it.
struct DirectionSample {
    Vec3 direction;           ///< of propagation, unit length
    Rgb value;                ///< the scattering function there, cosine included
    float density = 0;        ///< per steradian; a probability if specular
    bool specular = false;    ///< drawn from a discrete set of directions
    float density_ratio = 1;  ///< density over what the scattering function's own sampling would have had
    /// What the scattering function's own sampling had, where it was drawn from a mixture with a guide's; otherwise 0.
    float classical_density = 0;
    /// What the guide had, likewise.
    float guided_density = 0;

    /// What the walk's throughput is multiplied by.
    Rgb weight() const { return value * (1 / density); }
};

/// What scatters: a phase function with a direction of arrival, or a BSDF at a point with its cosine. `lobes` is its
/// shape, for an estimate of incident radiance to be multiplied with; uniform where lobes are no fair picture of it. A
/// function that is specular, or so peaked that a guide would rather disturb its sampling, is not guidable.
template <class F>
concept ScatteringFunction = requires(const F& f, const Vec3& w, float u, const Vec2& u2) {
    { f.evaluate(w) } -> std::same_as<Rgb>;
    { f.density(w) } -> std::same_as<float>;
    { f.sample(u, u2) } -> std::same_as<std::optional<DirectionSample>>;
    { f.lobes() } -> std::same_as<AxialLobes>;
    { f.is_specular() } -> std::same_as<bool>;
    { f.is_guidable() } -> std::same_as<bool>;
    { F::in_volume } -> std::convertible_to<bool>;
};

/// Directions in proportion to the scattering function alone.
class ClassicalDirection {
public:
    /// The directions at one vertex. Refers to the scattering function.
    template <ScatteringFunction F>
    class Distribution {
    public:
        /// Those of `f`, which must outlive it.
        explicit Distribution(const F& f) : f_(f) {}
        /// As F::sample(): nothing where the direction would carry nothing.
        std::optional<DirectionSample> sample(float u, const Vec2& u2) const { return f_.sample(u, u2); }
        /// The same by the next numbers of a generator.
        std::optional<DirectionSample> sample(Pcg32& random) const {
            const float u = random.uniform();
            return sample(u, random.uniform2());
        }
        /// Per steradian, of any direction; discrete ones have none.
        float density(const Vec3& w) const { return f_.density(w); }
        /// Nothing: no adjoint is known.
        std::optional<Rgb> in_scattered() const { return std::nullopt; }

    private:
        const F& f_;
    };

    /// The distribution at a vertex; `f` must outlive it.
    template <ScatteringFunction F>
    Distribution<F> at(const Vec3& /*position*/, const F& f, float /*weight*/ = 0) const {
        return Distribution<F>(f);
    }
};

/// Adjoints by place: the one that answers around a position, or null where nothing is known.
template <class F>
concept AdjointField = requires(const F& field, const Vec3& position) {
    { *field.find(position) } -> Adjoint;
};

/// Directions from a mixture of the scattering function and its product with an adjoint's incident radiance
/// (herholz2019), and towards caustic lobes where there are some. Surfaces and volumes have a field each.
template <AdjointField Field>
class GuidedDirection {
public:
    /// What the fields tell around a position.
    using LocalAdjoint = std::remove_cvref_t<decltype(*std::declval<Field>().find(Vec3()))>;
    /// The distribution of what scatters times incident radiance.
    using Product = std::remove_cvref_t<decltype(std::declval<LocalAdjoint>().incident(Vec3()).product(AxialLobes()))>;

    /// The fields are not owned. `defensive_fraction` in (0,1] is the probability of sampling the scattering function
    /// alone, where caustic lobes have nothing to say: it bounds the weight by 1/defensive_fraction times the classical
    /// one. Nothing: each adjoint's own. CausticLobes may be null.
    GuidedDirection(const Field* surface, const Field* volume, std::optional<float> defensive_fraction = std::nullopt,
                    const CausticMap* surface_caustics = nullptr, const CausticMap* volume_caustics = nullptr)
        : surface_(surface),
          volume_(volume),
          defensive_fraction_(defensive_fraction),
          surface_caustics_(surface_caustics),
          volume_caustics_(volume_caustics) {}

    /// Of a pair of fields (guide::Fields), which must stay where they are; others may be assigned to them.
    template <class Fields>
    requires std::same_as<std::remove_cvref_t<decltype(std::declval<Fields>().surface)>, Field>
    explicit GuidedDirection(const Fields& fields) : GuidedDirection(&fields.surface, &fields.volume) {}

    /// The directions at one vertex. Refers to the scattering function and to the adjoint.
    template <ScatteringFunction F>
    class Distribution {
    public:
        /// `adjoint` and `caustics` may be null. `least_defensive_fraction` in [0,1]: of the density of `f` alone,
        /// what is always left of it.
        Distribution(const F& f, const LocalAdjoint* adjoint, const Vec3& position, float defensive_fraction,
                     const CausticMap::Cell* caustics, float least_defensive_fraction)
            : f_(f), adjoint_(adjoint) {
            if (caustics) {
                caustic_lobes_ = CausticLobeMixture(*caustics, position, f);
                caustic_share_ = caustic_lobes_.is_empty() ? 0.0f
                                                           : std::min(share_of(caustics->fluence(F::in_volume)),
                                                                      1 - least_defensive_fraction);
            }
            defensive_fraction_ = std::max(defensive_fraction, least_defensive_fraction / (1 - caustic_share_));
            WEND_ENSURE(caustic_share_ >= 0 && caustic_share_ < 1);
            WEND_ENSURE(defensive_fraction_ >= 0 && defensive_fraction_ < 1.0001f);
            WEND_ENSURE((1 - caustic_share_) * defensive_fraction_ > 0.9999f * least_defensive_fraction ||
                        least_defensive_fraction == 0);
            if (adjoint) {
                product_.emplace(InPlace{*adjoint, position, f});
            }
        }

        /// A direction, from a number of [0,1), which chooses where it is drawn from, and a point of [0,1)²; nothing
        /// where it would carry nothing.
        std::optional<DirectionSample> sample(float u, const Vec2& u2) const {
            if (caustic_share_ == 0 && (!product_ || defensive_fraction_ >= 1)) {
                return f_.sample(u, u2);
            }
            const float own_share = product_ ? defensive_fraction_ : 1.0f;
            const bool by_caustics = u < caustic_share_;
            u = std::min(by_caustics ? u / caustic_share_ : (u - caustic_share_) / (1 - caustic_share_),
                         one_minus_epsilon);
            DirectionSample s;
            if (!by_caustics && u < own_share) {
                const auto classical = f_.sample(u / own_share, u2);
                if (!classical) {
                    return std::nullopt;
                }
                s = *classical;
                if (s.specular) {
                    s.density_ratio = (1 - caustic_share_) * own_share;
                    s.density *= s.density_ratio;
                    return s;
                }
            } else {
                s.direction = by_caustics ? caustic_lobes_.sample(u, u2) : product_->sample(u2);
                s.value = f_.evaluate(s.direction);
                s.density = f_.density(s.direction);
            }
            const float own = s.density;
            const float lobe = caustic_share_ > 0 ? caustic_share_ * caustic_lobes_.density(s.direction) : 0.0f;
            const float classical = (1 - caustic_share_) * own + lobe;
            if (product_) {
                s.classical_density = classical;
                s.guided_density = (1 - caustic_share_) * product_->density(s.direction) + lobe;
                s.density = mixed(s.classical_density, s.guided_density);
            } else {
                s.density = classical;
            }
            s.density_ratio = own > 0 ? s.density / own : 1.0f;
            return is_black(s.value) || !(s.density > 0) ? std::nullopt : std::optional(s);
        }
        /// The same by the next numbers of a generator.
        std::optional<DirectionSample> sample(Pcg32& random) const {
            const float u = random.uniform();
            return sample(u, random.uniform2());
        }
        /// Per steradian, of any direction, however it might be drawn: for multiple importance sampling. Discrete ones
        /// have none.
        float density(const Vec3& w) const {
            const float others =
                product_ && defensive_fraction_ < 1 ? mixed(f_.density(w), product_->density(w)) : f_.density(w);
            return caustic_share_ > 0 ? (1 - caustic_share_) * others + caustic_share_ * caustic_lobes_.density(w)
                                      : others;
        }

        /// The adjoint's ∫ f L dω over the albedo of f, by channel; nothing where it is not known.
        std::optional<Rgb> in_scattered() const {
            return product_ ? std::optional(adjoint_->in_scattered(*product_)) : std::nullopt;
        }

    private:
        /// Of directions, for caustic lobes of that fluence. They are never many: it suffices that what chance would
        /// not find is tried at all, and what is found by other means as well suffers.
        float share_of(float fluence) const {
            constexpr float least = 0.1f, most = 0.25f;
            const float all = adjoint_ ? adjoint_->fluence() : 0.0f;
            return all > 0 ? std::clamp(fluence / all, least, most) : least;
        }

        float mixed(float classical, float guided) const {
            return defensive_fraction_ * classical + (1 - defensive_fraction_) * guided;
        }

        /// Becomes the product where it is needed: that is large, and is not copied on its way.
        struct InPlace {
            const LocalAdjoint& adjoint;
            const Vec3& position;
            const F& f;
            operator Product() const { return adjoint.incident(position).product(f.lobes()); }
        };

        const F& f_;
        std::optional<Product> product_;
        const LocalAdjoint* adjoint_;
        float defensive_fraction_;
        float caustic_share_ = 0;
        CausticLobeMixture caustic_lobes_;
    };

    /// `weight` is the walk's (ExpectedContribution::weight) and raises the classical share of one that has become
    /// heavy; 0 leaves it alone. From weight_bound on the adjoint tells no more than what is to be expected.
    template <ScatteringFunction F>
    Distribution<F> at(const Vec3& position, const F& f, float weight = 0) const {
        const LocalAdjoint* adjoint = f.is_guidable() ? (F::in_volume ? volume_ : surface_)->find(position) : nullptr;
        const CausticMap* caustics = F::in_volume ? volume_caustics_ : surface_caustics_;
        const CausticMap::Cell* known = caustics && f.is_guidable() ? caustics->find(position) : nullptr;
        const float share = adjoint ? defensive_fraction_.value_or(adjoint->defensive_fraction()) : 1.0f;
        return Distribution<F>(f, adjoint, position, share, known, least_defensive_fraction(weight));
    }

private:
    const Field* surface_;
    const Field* volume_;
    std::optional<float> defensive_fraction_;
    const CausticMap* surface_caustics_;
    const CausticMap* volume_caustics_;
};

/// Of a pair of fields, such as guide::Fields.
template <class Fields>
GuidedDirection(const Fields& fields) -> GuidedDirection<std::remove_cvref_t<decltype(fields.surface)>>;

/// A phase function, which must outlive it, given the direction of propagation before the collision.
class VolumeScattering {
public:
    /// The field of volumes is asked.
    static constexpr bool in_volume = true;

    /// `before` has unit length.
    VolumeScattering(const PhaseFunction& phase, const Vec3& before) : phase_(phase), before_(before) {}

    /// The phase function in a direction of propagation, in 1/sr; the same in all channels.
    Rgb evaluate(const Vec3& w) const { return Rgb(density(w)); }
    /// The same number: sample() is exact.
    float density(const Vec3& w) const { return phase_.evaluate(dot(before_, w)); }
    /// A direction in proportion to the phase function, from a point of [0,1)².
    std::optional<DirectionSample> sample(float, const Vec2& u2) const {
        const Vec3 w = phase_.sample(before_, u2);
        const float p = density(w);
        return DirectionSample{w, Rgb(p), p};
    }
    /// The phase function's picture around the direction before.
    AxialLobes lobes() const { return phase_.lobes(before_); }
    /// Never.
    bool is_specular() const { return false; }
    /// The guide has no picture of what is still more peaked.
    bool is_guidable() const { return std::abs(phase_.mean_cosine()) <= largest_pictured_g; }
    /// The direction of propagation before the collision.
    const Vec3& before() const { return before_; }
    /// A collision does not change the refractive index.
    float index_ratio(const Vec3&) const { return 1; }
    /// Absorption is the flight's matter.
    Rgb albedo() const { return Rgb(1.0f); }

private:
    const PhaseFunction& phase_;
    Vec3 before_;
};

static_assert(ScatteringFunction<VolumeScattering>);

}  // namespace wend
