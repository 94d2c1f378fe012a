#include <wend/medium/averaged_phase.h>
#include <wend/medium/phase.h>
#include <wend/planar/space.h>
#include <wend/subsurface/layer_guide.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace wend {
namespace {

/// Rows of the tables of directions.
constexpr ModalDirection::Resolution isotropic_rows{65, 1};
constexpr ModalDirection::Resolution anisotropic_rows{17, 33};

/// Inside, or at the boundary that was passed.
double clamped(double depth, double thickness) {
    return std::clamp(depth, 0.0, thickness);
}

}  // namespace

LayerGuide::LayerGuide(double extinction, double mean_cosine, std::vector<PlanarAdjoint> layers)
    : extinction_(extinction), g_(std::clamp(mean_cosine, -0.95, 0.95)) {
    for (PlanarAdjoint& adjoint : layers) {
        ModalDirection direction(adjoint, g_, g_ == 0 ? isotropic_rows : anisotropic_rows);
        layers_.push_back(std::make_shared<const Layer>(Layer{std::move(adjoint), std::move(direction)}));
    }
}

std::array<LayerGuide::View, 2> LayerGuide::views(const LayerPlace& place) const {
    const double thickness = static_cast<double>(place.thickness) * extinction_;
    const double depth = static_cast<double>(place.depth) * extinction_;
    const auto last = static_cast<int>(layers_.size()) - 1;
    // The nearest power of two.
    const int size = std::clamp(std::ilogb(std::max(thickness, 1.0) * std::numbers::sqrt2), 0, last);
    const Layer& layer = *layers_[static_cast<std::size_t>(size)];
    const double deepest = layer.adjoint.slab().thickness;
    const double far = std::isinf(deepest) ? 0.0 : static_cast<double>(place.far);
    return {View{&layer, place.near, clamped(depth, deepest), place.inward},
            View{&layer, far, clamped(thickness - depth, deepest), -place.inward}};
}

double LayerGuide::radiance(const LayerPlace& place, const Vec3& w, double t) const {
    double sum = 0;
    for (const View& view : views(place)) {
        if (view.light > 0) {
            const PlanarAdjoint& adjoint = view.layer->adjoint;
            const double mu = view.cosine(w);
            sum +=
                view.light * adjoint.radiance(clamped(view.depth + t * extinction_ * mu, adjoint.slab().thickness), mu);
        }
    }
    return sum;
}

double LayerGuide::source(const LayerPlace& place, const Vec3& w, double t) const {
    double sum = 0;
    for (const View& view : views(place)) {
        if (view.light > 0) {
            const PlanarAdjoint& adjoint = view.layer->adjoint;
            const double mu = view.cosine(w);
            const double depth = view.depth + t * extinction_ * mu;
            const double inside = clamped(depth, adjoint.slab().thickness);
            if (depth == inside) {
                PlanarAdjoint::Site site;
                adjoint.at(depth, site);
                sum += view.light * adjoint.source(site, mu).value;
            } else {
                sum += view.light * adjoint.radiance(inside, mu);
            }
        }
    }
    return sum;
}

double LayerGuide::sample_distance(const LayerPlace& place, const Vec3& w, Pcg32& random) const {
    const std::array<View, 2> both = views(place);
    const auto expected = [&](const View& view) {
        return view.light > 0 ? view.light * view.layer->adjoint.radiance(view.depth, view.cosine(w)) : 0.0;
    };
    const double near = expected(both[0]), far = expected(both[1]);
    if (!(near + far > 0)) {
        // Nothing is expected from here; in case the layers are wrong, go on classically.
        return -std::log1p(-random.uniform_double()) / extinction_;
    }
    const View& view = both[random.uniform_double() * (near + far) < near ? 0 : 1];
    const ModalFlight flight(view.layer->adjoint);
    PlanarAdjoint::Site from, to;
    flight.at(view.depth, from);
    const PlanarFlight outcome = flight.sample(from, view.cosine(w), random, to);
    const double beyond = outcome.scatters ? 0.0 : -std::log1p(-random.uniform_double());
    return (outcome.length + beyond) / extinction_;
}

double LayerGuide::flight(const LayerPlace& place, const Vec3& w, double expected, double t, bool collides) const {
    const double classical = std::exp(-extinction_ * t) * (collides ? extinction_ : 1.0);
    if (!(expected > 0)) {
        return classical;
    }
    return classical * (collides ? source(place, w, t) : radiance(place, w, t)) / expected;
}

LayerGuide::Directions::Directions(const LayerGuide& guide, const LayerPlace& place, const Vec3& before)
    : g_(guide.g_), before_(before), views_(guide.views(place)) {
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const View& view = views_[i];
        if (view.light > 0) {
            PlanarAdjoint::Site site;
            view.layer->adjoint.at(view.depth, site);
            share_[i] = view.light * view.layer->adjoint.source(site, view.cosine(before)).value;
        }
    }
    const double total = share_[0] + share_[1];
    share_[0] = total > 0 ? share_[0] / total : 1.0;
    share_[1] = 1 - share_[0];
}

Vec3 LayerGuide::Directions::sample(Pcg32& random) const {
    const View& view = views_[random.uniform_double() < share_[0] ? 0 : 1];
    return sample_in_space(view.layer->direction, g_, view.depth, before_, view.inward, random).direction;
}

double LayerGuide::Directions::density(const Vec3& w) const {
    double density_ratio = 0;
    for (std::size_t i = 0; i < views_.size(); ++i) {
        if (share_[i] > 0) {
            const View& view = views_[i];
            density_ratio +=
                share_[i] * density_ratio_in_space(view.layer->direction, view.depth, before_, w, view.inward);
        }
    }
    return density_ratio * static_cast<double>(HenyeyGreenstein{static_cast<float>(g_)}.evaluate(dot(before_, w)));
}

}  // namespace wend
