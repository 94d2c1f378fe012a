// What the walk of integrator/path_tracer.inl, which includes this, multiplies and adds, and tells those that learn.
#pragma once

#include <wend/integrator/path_tracer.h>
#include <wend/integrator/scattering.h>

#include <optional>

namespace wend {

template <class Decisions>
void PathTracer<Decisions>::Walk::weigh(const Rgb& weight) {
    now_.throughput *= weight;
    if (log_) {
        log_->weigh(weight);
    }
}

template <class Decisions>
void PathTracer<Decisions>::Walk::gather(const Rgb& radiance, const std::optional<StaySlope>& slope) {
    bring(now_.throughput * radiance, slope);
    if (log_) {
        log_->gather(radiance);
    }
}

template <class Decisions>
void PathTracer<Decisions>::Walk::glow(const Rgb& radiance, float distance) {
    bring(now_.throughput * radiance, {});
    if (log_) {
        log_->glow(radiance, distance);
    }
}

template <class Decisions>
void PathTracer<Decisions>::Walk::bring(const Rgb& light, const std::optional<StaySlope>& slope) {
    radiance_ += light;
    boundaries_.bring(now_.boundary, mean_value(light));
    if (Stay* const stay = last_stay()) {
        update_stay();
        stay->bring(mean_value(light), slope.value_or(StaySlope{now_.relative, 0}));
    }
}

template <class Decisions>
void PathTracer<Decisions>::Walk::meet() {
    if (log_) {
        log_->meet(now_.travelled);
    }
}

template <class Decisions>
void PathTracer<Decisions>::Walk::scatter_into(const DirectionSample& s, const Vertex& v) {
    now_.throughput *= s.weight();
    if (log_) {
        if (v.in_volume() && !now_.is_told) {
            log_->weigh(s.weight());
        } else {
            log_->scatter(v.position, s.direction, s.specular ? 0 : s.density, s.weight(), v.in_volume(),
                          s.classical_density, s.guided_density);
        }
        // In a channel without throughput the walk draws nothing, and what it finds there says nothing.
        log_->weigh({now_.throughput.r > 0 ? 1.0f : 0.0f, now_.throughput.g > 0 ? 1.0f : 0.0f,
                     now_.throughput.b > 0 ? 1.0f : 0.0f});
    }
}

template <class Decisions>
void PathTracer<Decisions>::Walk::note_reflection(const SurfaceScattering& f, const DirectionSample& s,
                                                  const Vertex& v) {
    if (reflections_ && f.reflects_or_refracts()) {
        const ReflectionRecord record = tracer_.reflections_.record(v.side(), dot(s.direction, v.facing) > 0, 0);
        now_.boundary = boundaries_.note(now_.boundary, record, mean_value(now_.throughput) / s.boost);
    }
}

}  // namespace wend
