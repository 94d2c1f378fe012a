#include <wend/transport/walk_recorder.h>

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

void WalkRecorder::bring(float light, const std::optional<MixGradient>& slope, const InteriorWalk& interior) {
    boundaries_.bring(now_.boundary, light);
    if (InteriorWalkRecord* const interior_walk = last_interior_walk()) {
        update(interior);
        interior_walk->bring(light, slope.value_or(MixGradient{now_.relative, 0}));
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
        const ReflectionRecord record = reflection_probability_.record(v.side(), dot(s.direction, v.facing) > 0, 0);
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

void WalkRecorder::hint_at_caustics(const Vertex& v, const InteriorWalk& interior, Pcg32& random) {
    if (!to_.log || !to_.caustics || (v.in_volume() && interior.is_inside())) {
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
    if (to_.interior_walks) {
        now_.interior_walk = static_cast<int>(to_.interior_walks->size());
        now_.relative = {};
        to_.interior_walks->push_back({.medium = medium, .entry = position, .guided = guided});
    }
}

void WalkRecorder::fly(MediumId medium) {
    if (InteriorWalkRecord* const interior_walk = interior_walk_in(medium)) {
        ++interior_walk->flights;
    }
}

void WalkRecorder::connected(MediumId medium, bool through_boundaries) {
    if (InteriorWalkRecord* const interior_walk = interior_walk_in(medium)) {
        (through_boundaries ? interior_walk->connected_through : interior_walk->connected) = true;
    }
}

void WalkRecorder::update(const InteriorWalk& interior) {
    if (InteriorWalkRecord* const interior_walk = last_interior_walk(); interior_walk && interior.is_inside()) {
        interior_walk->relative = now_.relative = interior.relative_densities();
    }
}

void WalkRecorder::turn(const InteriorWalk& interior) {
    now_.at_collision =
        to_.interior_walks && interior.is_inside() ? interior.relative_densities() : InteriorGuide::Shares{};
}

std::optional<MixGradient> WalkRecorder::slope_inside(const InteriorWalk& here, const InteriorWalk& there,
                                                      float weight) const {
    if (!to_.interior_walks) {
        return std::nullopt;
    }
    return MixGradient{mix(here.relative_densities(), there.relative_densities(), weight), weight - 1};
}

std::optional<MixGradient> WalkRecorder::slope_at_boundary(const InteriorWalk& here, float before) const {
    if (!to_.interior_walks) {
        return std::nullopt;
    }
    return MixGradient{mix(now_.at_collision, here.relative_densities(), before), 0};
}

std::optional<MixGradient> WalkRecorder::slope_of(const EmitterHit& arriving, const LastVertex& last,
                                                  const InteriorWalk& interior) {
    if (!to_.interior_walks || now_.from_collision == 0) {
        return std::nullopt;
    }
    update(interior);
    // Light that was weighted against connections from a collision changes less than the walk's density.
    const float by_connections = arriving.by_connections / mean_value(arriving.radiance);
    const bool in_volume = last.receiver.normal == Vec3(0, 0, 0);
    return MixGradient{mix(now_.at_collision, now_.relative, by_connections * now_.from_collision),
                       in_volume ? by_connections : 0.0f};
}

}  // namespace wend
