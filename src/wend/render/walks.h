// The walks of a pass, drawn as its kinds of walks say.
#pragma once

#include <wend/decision/guided_distance.h>
#include <wend/film/film.h>
#include <wend/guide/field.h>
#include <wend/guide/fit.h>
#include <wend/light/beams.h>
#include <wend/render/guiding_choice.h>
#include <wend/render/learners.h>
#include <wend/render/pass.h>

#include <vector>

namespace wend {

/// Turns a kind of walks into the decisions of a path tracer. What it is made of must outlive it.
class Walks {
public:
    Walks(const Scene& scene, Film& film, const RenderSettings& settings, const GuidingChoice& choice,
          const Learners& learners);

    /// Goes on in a tile with walks of its next kind, until they are done or it is time to rest; whether they are done.
    bool walk(const PassPlan& plan, const Rest& rest, Tile& tile, Learners::Records& records) const;

private:
    template <class Run>
    bool walk_guided(const Preset& preset, const PassPlan& plan, const Run& run_with) const;

    const Scene& scene_;
    Film& film_;
    const RenderSettings& settings_;
    const GuidingChoice& choice_;
    const Learners& learners_;
    const std::vector<Beam> beams_;
    /// Fields that never learn, for flights that follow beams alone.
    const guide::Fields unknown_;
    const GuidedDistance<guide::Field> towards_beams_;
};

}  // namespace wend
