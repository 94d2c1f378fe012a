#include <wend/planar/crossing.h>

#include <wend/numeric/interpolation.h>
#include <wend/sampling/warp.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wend {
namespace {

const PlanarBoundary& boundary_of(const PlanarSlab& slab, bool at_far) {
    return at_far ? slab.far : slab.near;
}

double cosine_outside(const PlanarBoundary& boundary, double cosine) {
    return boundary.ior == 1 ? cosine
                             : std::sqrt(std::max(0.0, 1 - (1 - cosine * cosine) * boundary.ior * boundary.ior));
}

/// Draws the outcome of a smooth boundary, given the probability of leaving.
PlanarCrossing cross(const PlanarBoundary& boundary, double cosine, double probability, Pcg32& random) {
    const double reflectance = boundary.reflectance(cosine);
    if (probability >= 1 || (probability > 0 && random.uniform_double() < probability)) {
        return {true, cosine_outside(boundary, cosine), (1 - reflectance) / probability};
    }
    return {false, cosine, reflectance / (1 - probability)};
}

}  // namespace

double ClassicalCrossing::leaving_probability(bool at_far, double cosine) const {
    return 1 - boundary_of(*slab_, at_far).reflectance(cosine);
}

PlanarCrossing ClassicalCrossing::sample(bool at_far, double cosine, Pcg32& random) const {
    const PlanarBoundary& boundary = boundary_of(*slab_, at_far);
    if (!boundary.rough) {
        return cross(boundary, cosine, leaving_probability(at_far, cosine), random);
    }
    const RoughBoundary::Encounter e = boundary.rough->encounter_from_inside(cosine, random.uniform2());
    const double total = e.transmitted_weight + e.reflected_weight;
    if (random.uniform_double() * total < e.transmitted_weight) {
        return {true, e.transmitted_cosine, total};
    }
    return {false, e.reflected_cosine, total};
}

GuidedCrossing::GuidedCrossing(const PlanarAdjoint& adjoint) : adjoint_(&adjoint) {
    constexpr int steps = 256;
    for (const bool at_far : {false, true}) {
        if (boundary_of(adjoint.slab(), at_far).rough && !(at_far && std::isinf(adjoint.slab().thickness))) {
            for (int i = 0; i <= steps; ++i) {
                inward_[at_far ? 1 : 0].push_back(radiance_inward(at_far, std::max(i, 1) / static_cast<double>(steps)));
            }
        }
    }
}

double GuidedCrossing::radiance_inward(bool at_far, double cosine) const {
    return std::max(0.0, adjoint_->radiance(at_far ? adjoint_->slab().thickness : 0, at_far ? -cosine : cosine));
}

double GuidedCrossing::leaving_probability(bool at_far, double cosine) const {
    const PlanarBoundary& boundary = boundary_of(adjoint_->slab(), at_far);
    if (boundary.ior == 1) {
        return 1;
    }
    const double leaving = boundary.illumination_inside(cosine);
    const double reflectance = boundary.reflectance(cosine);
    const double staying = reflectance * radiance_inward(at_far, cosine);
    if (!(leaving + staying > 0)) {
        return 1 - reflectance;
    }
    // What the adjoint thinks worthless keeps a small chance, in case it is wrong.
    constexpr double least = 1e-3;
    const double probability = leaving / (leaving + staying);
    const bool may_leave = leaving > 0, may_stay = reflectance > 0;
    return may_stay ? (may_leave ? std::clamp(probability, least, 1 - least) : 0) : 1;
}

PlanarCrossing GuidedCrossing::sample(bool at_far, double cosine, Pcg32& random) const {
    const PlanarBoundary& boundary = boundary_of(adjoint_->slab(), at_far);
    return boundary.rough ? sample_rough(at_far, cosine, random)
                          : cross(boundary, cosine, leaving_probability(at_far, cosine), random);
}

PlanarCrossing GuidedCrossing::sample_rough(bool at_far, double cosine, Pcg32& random) const {
    const PlanarBoundary& boundary = boundary_of(adjoint_->slab(), at_far);
    constexpr int candidates = 16;
    const std::vector<double>& inward = inward_[at_far ? 1 : 0];
    const Vec2 shift = random.uniform2();
    struct Candidate {
        PlanarCrossing crossing;
        double value = 0;  // expected contribution
    };
    std::array<Candidate, 2 * candidates> all;
    double total = 0;
    for (std::size_t i = 0; i < candidates; ++i) {
        const RoughBoundary::Encounter e =
            boundary.rough->encounter_from_inside(cosine, golden_lattice_point(static_cast<int>(i), candidates, shift));
        Candidate& leaving = all[2 * i];
        leaving.crossing = {true, e.transmitted_cosine, e.transmitted_weight};
        if (e.transmitted_weight > 0 && boundary.illumination) {
            leaving.value = e.transmitted_weight * boundary.illumination(e.transmitted_cosine);
        }
        Candidate& staying = all[2 * i + 1];
        staying.crossing = {false, e.reflected_cosine, e.reflected_weight};
        if (e.reflected_weight > 0) {
            staying.value = e.reflected_weight * interpolate(inward, e.reflected_cosine);
        }
        total += leaving.value + staying.value;
    }
    if (!(total > 0)) {
        return {true, 1, 0};
    }
    double u = random.uniform_double() * total;
    std::size_t chosen = 0;
    for (std::size_t i = 0; i < all.size() && u >= 0; ++i) {
        if (all[i].value > 0) {
            chosen = i;
            u -= all[i].value;
        }
    }
    PlanarCrossing crossing = all[chosen].crossing;
    crossing.weight *= total / (candidates * all[chosen].value);
    return crossing;
}

}  // namespace wend
