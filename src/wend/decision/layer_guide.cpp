#include <wend/decision/layer_guide.h>
#include <wend/decision/planar_space.h>
#include <wend/medium/averaged_phase.h>
#include <wend/medium/phase.h>

#include <algorithm>
#include <cmath>
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
    const auto last = static_cast<double>(layers_.size() - 1);
    const double size = std::clamp(std::round(std::log2(std::max(thickness, 1.0))), 0.0, last);
    const Layer& layer = *layers_[static_cast<std::size_t>(size)];
    const double deepest = layer.adjoint.slab().thickness;
    const double far = std::isinf(deepest) ? 0.0 : static_cast<double>(place.far);
    return {View{&layer, place.near, clamped(depth, deepest), 1},
            View{&layer, far, clamped(thickness - depth, deepest), -1}};
}

double LayerGuide::radiance(const LayerPlace& place, const Vec3& w, double t) const {
    double sum = 0;
    for (const View& view : views(place)) {
        if (view.light > 0) {
            const PlanarAdjoint& adjoint = view.layer->adjoint;
            const double mu = view.side * static_cast<double>(dot(w, place.inward));
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
            const double mu = view.side * static_cast<double>(dot(w, place.inward));
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
    std::array<double, 2> expected{};
    for (std::size_t i = 0; i < both.size(); ++i) {
        const double mu = both[i].side * static_cast<double>(dot(w, place.inward));
        expected[i] = both[i].light > 0 ? both[i].light * both[i].layer->adjoint.radiance(both[i].depth, mu) : 0.0;
    }
    const View& view = both[random.uniform_double() * (expected[0] + expected[1]) < expected[0] ? 0 : 1];
    const ModalFlight flight(view.layer->adjoint);
    PlanarAdjoint::Site from, to;
    flight.at(view.depth, from);
    const PlanarFlight outcome = flight.sample(from, view.side * static_cast<double>(dot(w, place.inward)), random, to);
    const double beyond = outcome.scatters ? 0.0 : -std::log1p(-random.uniform_double());
    return (outcome.length + beyond) / extinction_;
}

LayerGuide::Directions::Directions(const LayerGuide& guide, const LayerPlace& place, const Vec3& before)
    : guide_(&guide), place_(place), before_(before) {
    const std::array<View, 2> both = guide.views(place);
    for (std::size_t i = 0; i < both.size(); ++i) {
        if (both[i].light > 0) {
            PlanarAdjoint::Site site;
            both[i].layer->adjoint.at(both[i].depth, site);
            const double mu = both[i].side * static_cast<double>(dot(before, place.inward));
            share_[i] = both[i].light * both[i].layer->adjoint.source(site, mu).value;
        }
    }
    const double total = share_[0] + share_[1];
    share_[0] = total > 0 ? share_[0] / total : 1.0;
    share_[1] = 1 - share_[0];
}

Vec3 LayerGuide::Directions::sample(Pcg32& random) const {
    const View view = guide_->views(place_)[random.uniform_double() < share_[0] ? 0 : 1];
    const Vec3 inward = place_.inward * static_cast<float>(view.side);
    return sample_in_space(view.layer->direction, guide_->g_, view.depth, before_, inward, random).direction;
}

double LayerGuide::Directions::density(const Vec3& w) const {
    const std::array<View, 2> both = guide_->views(place_);
    double boost = 0;
    for (std::size_t i = 0; i < both.size(); ++i) {
        if (share_[i] > 0) {
            const Vec3 inward = place_.inward * static_cast<float>(both[i].side);
            boost += share_[i] * boost_in_space(both[i].layer->direction, both[i].depth, before_, w, inward);
        }
    }
    return boost * static_cast<double>(HenyeyGreenstein{static_cast<float>(guide_->g_)}.evaluate(dot(before_, w)));
}

}  // namespace wend
