#include <wend/integrator/walk_recorder.h>

#include <limits>

namespace wend {

void WalkRecorder::start() {
    if (to_.log) {
        to_.log->start();
    }
    boundaries_.start();
}

void WalkRecorder::finish() {
    if (to_.reflections) {
        boundaries_.finish(*to_.reflections);
    }
}

WalkRecorder::Branch WalkRecorder::branch() const {
    Branch branch = now_;
    if (to_.log) {
        branch.path = to_.log->branch();
    }
    return branch;
}

void WalkRecorder::resume(const Branch& branch) {
    now_ = branch;
    if (to_.log) {
        to_.log->resume(branch.path);
    }
}

void WalkRecorder::bring(float light, const std::optional<StaySlope>& slope, const SlabWalk& slab) {
    boundaries_.bring(now_.boundary, light);
    if (Stay* const stay = last_stay()) {
        update(slab);
        stay->bring(light, slope.value_or(StaySlope{now_.relative, 0}));
    }
}

void WalkRecorder::collide(const Medium& medium, const Vec3& position) {
    if (to_.log && now_.is_logged) {
        to_.log->collide(mean_value(extinction_at(medium, position)));
    }
}

void WalkRecorder::scatter(const DirectionSample& s, const Vertex& v, const Rgb& throughput) {
    if (!to_.log) {
        return;
    }
    if (v.in_volume() && !now_.is_logged) {
        to_.log->weigh(s.weight());
    } else {
        to_.log->scatter(v.position, s.direction, s.specular ? 0 : s.density, s.weight(), v.in_volume(),
                         s.classical_density, s.guided_density);
    }
    // In a channel without throughput the walk draws nothing, and what it finds there says nothing.
    to_.log->weigh({throughput.r > 0 ? 1.0f : 0.0f, throughput.g > 0 ? 1.0f : 0.0f, throughput.b > 0 ? 1.0f : 0.0f});
}

void WalkRecorder::reflect(const DirectionSample& s, const Vertex& v, float worth) {
    if (to_.reflections) {
        const ReflectionRecord record = reflection_choices_.record(v.side(), dot(s.direction, v.facing) > 0, 0);
        now_.boundary = boundaries_.note(now_.boundary, record, worth);
    }
}

void WalkRecorder::connect(const Vertex& v, int light, float choice_probability, float times, const Vec3& to_light,
                           float distance, float fluence, const Rgb& brought) {
    if (to_.lights) {
        to_.lights->push_back(choices_.record(v.receiver(), light, mean_value(brought) * times * choice_probability));
    }
    if (to_.log && (now_.is_logged || !v.in_volume())) {
        to_.log->connect(to_light, distance, fluence, brought);
    }
}

void WalkRecorder::connect_at_boundary(const Vec3& w, const Rgb& phase, const Rgb& brought) {
    gather(brought);
    if (to_.log && now_.is_logged) {
        to_.log->connect(w, std::numeric_limits<float>::infinity(), mean_value(brought) / mean_value(phase), brought);
    }
}

void WalkRecorder::hint_at_caustics(const Vertex& v, const SlabWalk& slab, Pcg32& random) {
    if (!to_.log || !to_.caustics || (v.in_volume() && slab.is_inside())) {
        return;
    }
    if (const auto seen = to_.caustics->near(v.position, v.facing, random)) {
        hint({{v.position, seen->towards, mean_value(seen->fluence), 1, seen->distance, 0, 0, 0, seen->fluence},
              v.in_volume()});
    }
}

void WalkRecorder::choose_recording(bool guided, float probability, Pcg32& random) {
    now_.is_logged = !to_.log || !guided || random.uniform() < probability;
}

void WalkRecorder::enter(MediumId medium, const Vec3& position, bool guided) {
    if (to_.stays) {
        now_.stay = static_cast<int>(to_.stays->size());
        now_.relative = {};
        to_.stays->push_back({.medium = medium, .entry = position, .guided = guided});
    }
}

void WalkRecorder::fly(MediumId medium) {
    if (Stay* const stay = stay_in(medium)) {
        ++stay->flights;
    }
}

void WalkRecorder::connected(MediumId medium, bool through_boundaries) {
    if (Stay* const stay = stay_in(medium)) {
        (through_boundaries ? stay->connected_through : stay->connected) = true;
    }
}

void WalkRecorder::update(const SlabWalk& slab) {
    if (Stay* const stay = last_stay(); stay && slab.is_inside()) {
        stay->relative = now_.relative = slab.relative_densities();
    }
}

void WalkRecorder::turn(const SlabWalk& slab) {
    now_.at_collision = to_.stays && slab.is_inside() ? slab.relative_densities() : SlabGuide::Shares{};
}

std::optional<StaySlope> WalkRecorder::slope_inside(const SlabWalk& here, const SlabWalk& there, float weight) const {
    if (!to_.stays) {
        return std::nullopt;
    }
    return StaySlope{mix(here.relative_densities(), there.relative_densities(), weight), weight - 1};
}

std::optional<StaySlope> WalkRecorder::slope_at_boundary(const SlabWalk& here, float before) const {
    if (!to_.stays) {
        return std::nullopt;
    }
    return StaySlope{mix(now_.at_collision, here.relative_densities(), before), 0};
}

std::optional<StaySlope> WalkRecorder::slope_of(const MetLight& arriving, const LastVertex& last,
                                                const SlabWalk& slab) {
    if (!to_.stays || now_.from_collision == 0) {
        return std::nullopt;
    }
    update(slab);
    // Light that was weighted against connections from a collision changes less than the walk's density.
    const float by_connections = arriving.by_connections / mean_value(arriving.radiance);
    const bool in_volume = last.receiver.normal == Vec3(0, 0, 0);
    return StaySlope{mix(now_.at_collision, now_.relative, by_connections * now_.from_collision),
                     in_volume ? by_connections : 0.0f};
}

}  // namespace wend
