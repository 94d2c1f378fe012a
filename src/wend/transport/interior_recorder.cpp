#include <wend/transport/interior_recorder.h>

namespace wend {

using namespace walk_events;

void InteriorRecorder::on(const Contributed& event) {
    if (InteriorWalkRecord* const walk = last()) {
        update(event.interior);
        walk->bring(event.light, event.gradient.value_or(MixGradient{now_.relative, 0}));
    }
}

void InteriorRecorder::on(const EnteredMedium& event) {
    if (walks_ && event.dense) {
        now_.walk = static_cast<int>(walks_->size());
        now_.relative = {};
        walks_->push_back({.medium = event.medium, .entry = event.position, .guided = event.guided});
    }
}

void InteriorRecorder::update(const InteriorWalk& interior) {
    if (InteriorWalkRecord* const walk = last(); walk && interior.is_inside()) {
        walk->relative = now_.relative = interior.relative_densities();
    }
}

std::optional<MixGradient> InteriorRecorder::gradient_inside(const InteriorWalk& here, const InteriorWalk& there,
                                                             float weight) const {
    if (!walks_) {
        return std::nullopt;
    }
    return MixGradient{mix(here.relative_densities(), there.relative_densities(), weight), weight - 1};
}

std::optional<MixGradient> InteriorRecorder::gradient_at_boundary(const InteriorWalk& here, float before) const {
    if (!walks_) {
        return std::nullopt;
    }
    return MixGradient{mix(now_.at_collision, here.relative_densities(), before), 0};
}

std::optional<MixGradient> InteriorRecorder::gradient_of(const EmitterHit& arriving, const LastVertex& last_vertex,
                                                         const InteriorWalk& interior) {
    if (!walks_ || now_.from_collision == 0) {
        return std::nullopt;
    }
    update(interior);
    // Light that was weighted against connections from a collision changes less than the walk's density.
    const float by_connections = arriving.by_connections / mean_value(arriving.radiance);
    const bool in_volume = last_vertex.receiver.normal == Vec3(0, 0, 0);
    return MixGradient{mix(now_.at_collision, now_.relative, by_connections * now_.from_collision),
                       in_volume ? by_connections : 0.0f};
}

}  // namespace wend
