// The random walk of a camera sample through surfaces and volumes. Every decision it takes is one of decision/; the
// walk itself only follows rays, connects to lights, and multiplies weights.
#pragma once

#include <wend/decision/direction.h>
#include <wend/decision/guided_distance.h>
#include <wend/decision/roulette_splitting.h>
#include <wend/film/film.h>
#include <wend/light/light_selection.h>
#include <wend/sampling/sampler.h>
#include <wend/scene/scene.h>
#include <wend/transport/recorders.h>
#include <wend/transport/reflection_probability.h>
#include <wend/transport/subsurface_guides.h>

#include <atomic>
#include <cstdint>

namespace wend {

/// Counted work of walks.
struct WalkCounts {
    std::uint64_t paths = 0;
    std::uint64_t segments = 0;
    std::uint64_t rejected = 0;

    WalkCounts& operator+=(const WalkCounts& o) {
        paths += o.paths;
        segments += o.segments;
        rejected += o.rejected;
        return *this;
    }
};

/// What a walk found. The radiance may be not finite: the caller counts and rejects.
struct WalkResult {
    FilmSample sample;
};

/// The decisions of a walk, as a bundle of values.
template <class D>
concept WalkDecisions = requires(const D& d) {
    requires DistanceDecision<decltype(d.distance)>;
    requires RouletteSplittingDecision<decltype(d.survival)>;
    d.direction;
};

struct ClassicalDecisions {
    ClassicalDistance distance;
    ClassicalDirection direction;
    ClassicalRoulette survival;
};

template <class Field, class Distance, class Survival>
struct GuidedDecisions {
    Distance distance;
    GuidedDirection<Field> direction;
    Survival survival;
};
// C++20 deduces this by itself, but clang only from version 17 on.
template <class Field, class Distance, class Survival>
GuidedDecisions(Distance, GuidedDirection<Field>, Survival) -> GuidedDecisions<Field, Distance, Survival>;

/// Walks through a scene with given decisions, seen by given recorders: at least those of StandardRecorders. A vertex
/// is a scattering event: interfaces are passed for free.
template <class Decisions, class Recorders = StandardRecorders>
class PathTracer {
public:
    /// All but `max_depth`, the largest number of vertices (pbrt's maxdepth), are referred to. Walks end as they are
    /// once `stop` is true, which may be null.
    PathTracer(const Scene& scene, const Decisions& decisions, const SubsurfaceGuides& subsurface,
               const LightSelection& lights, const ReflectionProbability& reflections, int max_depth,
               const std::atomic<bool>* stop = nullptr)
        : scene_(scene),
          decisions_(decisions),
          subsurface_(subsurface),
          lights_(lights),
          reflections_(reflections),
          max_depth_(max_depth),
          stop_(stop) {}

    /// Radiance arriving along the ray, of which `expected` is an estimate for decisions on survival; 0 where there is
    /// none.
    WalkResult trace(const Ray& ray, float expected, Sampler& sampler, const Recorders& recorders = Recorders()) const;

private:
    class Walk;

    const Scene& scene_;
    const Decisions& decisions_;
    const SubsurfaceGuides& subsurface_;
    const LightSelection& lights_;
    const ReflectionProbability& reflections_;
    int max_depth_;
    const std::atomic<bool>* stop_;
};

}  // namespace wend
