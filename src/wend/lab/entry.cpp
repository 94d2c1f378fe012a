#include <wend/lab/entry.h>

#include <wend/medium/fresnel.h>
#include <wend/numeric/quadrature.h>

#include <cmath>
#include <vector>

namespace wend {
namespace {

double cosine_inside(double outside, double ior) {
    return std::sqrt(1 - (1 - outside * outside) / (ior * ior));
}

}  // namespace

PlanarEntry::PlanarEntry(const PlanarSlab& slab, double cosine) : slab_(&slab), cosine_(cosine) {
}

PlanarEntry::PlanarEntry(const PlanarSlab& slab, const PlanarAdjoint* adjoint) : slab_(&slab) {
    if (adjoint) {
        constexpr int cells = 128, resolution = 256;
        table_.emplace(std::vector<double>{0, 1}, cells, 1);
        std::vector<double> density = table_->places(0, resolution);
        for (double& squared : density) {
            const double outside = std::sqrt(std::max(squared, 1e-18));
            squared = value(*adjoint, outside) + reflection(outside);
        }
        table_->set_row(0, density, resolution);
    }
}

double PlanarEntry::value(const PlanarAdjoint& adjoint, double outside) const {
    const PlanarBoundary& near = slab_->near;
    const auto radiance = [&](double inside) { return adjoint.radiance(0, inside); };
    if (near.rough) {
        return near.rough->transmitted_from_outside(outside, radiance);
    }
    if (near.ior == 1) {
        return radiance(outside);
    }
    return (1 - fresnel_dielectric(outside, near.ior)) * radiance(cosine_inside(outside, near.ior));
}

PlanarEntry::Outcome PlanarEntry::enter(double outside, Pcg32& random) const {
    const PlanarBoundary& near = slab_->near;
    const double sky = near.illumination ? near.illumination(outside) : 0;
    Outcome entry;
    entry.outside = outside;
    entry.cosine = outside;
    if (near.rough) {
        const RoughBoundary::Encounter e = near.rough->encounter_from_outside(outside, random.uniform2());
        entry.reflected = e.reflected_weight > 0 && near.illumination
                              ? e.reflected_weight * near.illumination(e.reflected_cosine)
                              : 0;
        entry.cosine = e.transmitted_cosine;
        entry.weight = e.transmitted_weight;
    } else if (near.ior > 1) {
        const double reflectance = fresnel_dielectric(outside, near.ior);
        entry.reflected = reflectance * sky;
        entry.cosine = cosine_inside(outside, near.ior);
        entry.weight = 1 - reflectance;
    }
    return entry;
}

PlanarEntry::Outcome PlanarEntry::sample(Pcg32& random) const {
    if (cosine_) {
        return enter(*cosine_, random);
    }
    // Never 0, where a ray would not enter.
    const double u = 1 - random.uniform_double();
    if (!table_) {
        return enter(std::sqrt(u), random);
    }
    const QuantileTable::Sample squared = table_->sample({}, u);
    Outcome entry = enter(std::sqrt(std::max(squared.value, 1e-24)), random);
    entry.density_ratio = squared.density;
    entry.reflected /= entry.density_ratio;
    entry.weight /= entry.density_ratio;
    return entry;
}

double PlanarEntry::density_ratio(double outside) const {
    return table_ ? table_->density({}, outside * outside) : 1;
}

double PlanarEntry::expected(const PlanarAdjoint& adjoint) const {
    if (cosine_) {
        return value(adjoint, *cosine_);
    }
    // The square root of the cosine squared crowds where radiance is singular.
    const Quadrature rule = gauss_legendre(slab_->near.rough ? 24 : 96);
    double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double cosine = rule.nodes[i] * rule.nodes[i];
        sum += rule.weights[i] * 2 * rule.nodes[i] * 2 * cosine * value(adjoint, cosine);
    }
    return sum;
}

double PlanarEntry::reflection(double outside) const {
    const PlanarBoundary& near = slab_->near;
    if (!near.illumination || near.ior == 1) {
        return 0;
    }
    return near.rough ? near.rough->reflected_from_outside(outside, near.illumination)
                      : fresnel_dielectric(outside, near.ior) * near.illumination(outside);
}

double PlanarEntry::expected_reflection() const {
    if (cosine_) {
        return reflection(*cosine_);
    }
    const Quadrature rule = gauss_legendre(slab_->near.rough ? 24 : 96);
    double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        sum += rule.weights[i] * 2 * rule.nodes[i] * reflection(rule.nodes[i]);
    }
    return sum;
}

}  // namespace wend
