#include <wend/transport/interior_recorder.h>

namespace wend {

void InteriorRecorder::on(const walk_events::Contributed& event) {
    if (InteriorWalkRecord* const walk = last()) {
        update(event.technique);
        walk->bring(event.light, gradient_of(event.found, event.technique));
    }
}

void InteriorRecorder::on(const walk_events::EnteredMedium& event) {
    if (walks_ && event.dense) {
        now_.walk = static_cast<int>(walks_->size());
        now_.relative = {};
        walks_->push_back({.medium = event.medium, .entry = event.position, .guided = event.guided});
    }
}

void InteriorRecorder::update(const PathTechnique& technique) {
    const InteriorWalk* const interior = interior_of(technique);
    if (InteriorWalkRecord* const walk = last(); walk && interior) {
        walk->relative = now_.relative = interior->relative_densities();
    }
}

MixGradient InteriorRecorder::gradient_of(const walk_events::LightFound& found, const PathTechnique& technique) const {
    const InteriorWalk* const here = interior_of(technique);
    if (found.towards && here) {
        return gradient_of_connection(here->relative_densities(), found.towards->relative_densities(),
                                      found.by_connections);
    }
    if (found.from_collision > 0 && here) {
        return {mix(now_.at_collision, here->relative_densities(), found.from_collision), 0};
    }
    if (found.hit && now_.from_collision > 0) {
        const float by_connections = found.hit->by_connections / mean_value(found.hit->radiance);
        if (found.last->receiver.normal == Vec3(0, 0, 0)) {
            return gradient_of_hit(now_.at_collision, now_.relative, by_connections * now_.from_collision);
        }
        // What connects at the boundary has no preference.
        return {mix(now_.at_collision, now_.relative, by_connections * now_.from_collision), 0};
    }
    return {now_.relative, 0};
}

}  // namespace wend
