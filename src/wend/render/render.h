// Rendering: passes over the picture, and training between them.
#pragma once

#include <wend/film/film.h>
#include <wend/film/filter.h>
#include <wend/guide/fit.h>
#include <wend/render/guiding_choice.h>
#include <wend/render/preset.h>
#include <wend/sampling/sampler.h>
#include <wend/transport/path_tracer.h>
#include <wend/transport/subsurface_guides.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace wend {

struct RenderSettings {
    /// Samples per pixel; ignored where `seconds` is positive.
    int samples = 16;
    /// Time to spend, training included.
    double seconds = 0;
    /// The passes of an earlier run, to repeat exactly; overrides both.
    std::vector<int> passes;

    Preset preset;
    SubsurfacePreset subsurface;
    /// What an earlier render of the scene learned; null: nothing yet.
    std::shared_ptr<const guide::Fields> fields;
    /// Samples per pixel that the fields learn from: from then on they would change little. 0: they stay as given.
    int training_samples = 63;
    /// Whether what is learned is wanted afterwards: then the last pass teaches it too.
    bool keeps_fields = false;
    /// About so many vertices of each pass teach the fields; positive. Of more walks, some are not recorded.
    double most_records = 2e6;
    /// Is shown what the walks of each pass told the field, in the order of the picture's tiles; may be empty.
    std::function<void(std::span<const guide::PathRecords>)> on_records;
    SamplerKind sampler = SamplerKind::sobol;
    std::uint64_t seed = 0;
    int threads = 0;  ///< 0: all
    int max_depth = 5;
    Filter filter = Filter::box();
    float exposure = 1;  ///< multiplies all radiances
    /// Not null: once true, walks end where they are, are forgotten, and the render with them.
    const std::atomic<bool>* stop = nullptr;
};

/// How far a render is.
struct RenderProgress {
    double fraction = 0;
    double seconds = 0;
    int samples = 0;            ///< per pixel, so far
    double relative_noise = 0;  ///< Film::relative_noise(), by the samples so far
};

/// What a render did with one kind of walks.
struct WalkKindStatistics {
    WalkKind kind;
    double share = 0;  ///< of all walks
    /// GuidingChoice::means(); 0 where they were not asked for.
    double squared_error = 0, work = 0;
};

struct RenderStatistics {
    int samples = 0;     ///< per pixel
    double seconds = 0;  ///< wall time, training included
    double training_seconds = 0;
    WalkCounts counts;
    std::size_t field_bytes = 0;
    std::vector<int> passes;  ///< samples per pixel of each pass
    std::vector<WalkKindStatistics> kinds;
    bool interrupted = false;
    std::shared_ptr<const guide::Fields> fields;  ///< what was learned; null if nothing was guided
};

/// Renders into the film. A pass that is stopped leaves its finished samples there, which do not count as a pass. A
/// time to spend stops a pass that would exceed it by a second, but the first one only if it takes ten times as long.
/// `keep_going` is called between passes, with the film complete up to there; false ends the render. Throws
/// std::runtime_error if more than one sample in 10^4 (and more than ten) was not a finite number: that is a mistake,
/// not chance.
RenderStatistics render(const Scene& scene, Film& film, const RenderSettings& settings,
                        const std::function<bool(const RenderProgress&)>& keep_going = {});

}  // namespace wend
