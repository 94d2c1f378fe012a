// Rendering: passes over the picture, and training between them. A render can be watched, stopped, saved and resumed.
#pragma once

#include <wend/core/archive.h>
#include <wend/core/colour_matrix.h>
#include <wend/core/ranks.h>
#include <wend/film/film.h>
#include <wend/film/filter.h>
#include <wend/guide/fit.h>
#include <wend/render/guiding_choice.h>
#include <wend/render/preset.h>
#include <wend/sampling/sampler.h>
#include <wend/subsurface/preset.h>
#include <wend/transport/first_surface.h>
#include <wend/transport/light_parts.h>
#include <wend/transport/walk_result.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace wend {

struct RenderSettings {
    /// So many samples a pixel can have.
    static constexpr int most_samples = 1 << 30;

    /// Samples per pixel; ignored where `seconds` is positive.
    int samples = 16;
    /// Time to spend, training included.
    double seconds = 0;
    /// Not 0: the picture is done once none of its squares of 16x16 pixels has more noise than this (SquaresNoise), as
    /// far as can be told from 15 samples on.
    double noise = 0;
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
    float exposure = 1;    ///< multiplies all radiances
    ColourMatrix balance;  ///< multiplies them as well, once they are on the film; not singular
    /// Which parts of the beauty the film gets, as many as its FilmLayers::parts.
    PartsPlan parts;
    ObjectIds objects;                ///< not empty: the film gets which of them it shows (FilmLayers::objects)
    std::vector<std::string> layers;  ///< that were asked for, by name, for those who describe the render
    /// Not null: once true, walks are dropped where they are. They are walked again if the render goes on.
    const std::atomic<bool>* stop = nullptr;
    /// Not null: this is one of several processes that render the same picture together, and all of them get it. They
    /// make the same calls of Render, in the same order.
    Ranks* ranks = nullptr;
};

/// How far a render is.
struct RenderProgress {
    double fraction = 0;
    double seconds = 0;
    double seconds_left = 0;    ///< at the pace of the last pass
    int samples = 0;            ///< per pixel, so far
    double relative_noise = 0;  ///< after the last pass; of the noisiest square where noise is to end it
    bool learns = false;        ///< whether walks are there to learn from
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
    int ranks = 1;
    double waiting_seconds = 0;                   ///< of this rank for others, messages included
    std::uint64_t bytes_sent = 0;                 ///< by this rank, to others
    std::shared_ptr<const guide::Fields> fields;  ///< what was learned; null if nothing was guided
};

/// A render. The picture does not depend on how it is divided into steps, nor on whether it was saved and restored in
/// between, as long as it is not time that ends it.
class Render {
public:
    /// Samples are added to the film. Scene and film must outlive it.
    Render(const Scene& scene, Film& film, RenderSettings settings);
    Render(const Render&) = delete;
    Render& operator=(const Render&) = delete;
    ~Render();

    static constexpr double endless = std::numeric_limits<double>::infinity();

    /// Goes on for about so many seconds, or to the end of a pass if that comes first. Whether there is more to do: not
    /// at the end, which may be in the middle of a pass where time is up. Once RenderSettings::stop is true it returns
    /// at once, or after what is learned from a pass. In between the film holds all walks that have ended.
    bool step(double seconds = endless);
    /// Whether a pass has been begun and not ended.
    bool is_within_pass() const;
    /// Whether the last step found that RenderSettings::stop is true, in any rank.
    bool is_stopped() const;
    /// Tells all ranks what each has done in the pass at hand, so that film and state are whole in each; before save(),
    /// or where the film is looked at in between.
    void share();

    RenderProgress progress() const;
    /// So far; without fields.
    RenderStatistics statistics() const;
    /// A copy of what was learned so far; null where nothing is guided. Not within a step.
    std::shared_ptr<const guide::Fields> fields() const;
    /// With a copy of what was learned. Throws std::runtime_error if more than one sample in 10^4 (and more than ten)
    /// was not a finite number: that is a mistake, not chance.
    RenderStatistics result() const;

    /// All that is needed to go on, the film included.
    void save(ArchiveWriter& bytes) const;
    /// Goes on where another render of the same scene and settings was saved; samples and time to spend may differ.
    /// Throws InputError for other bytes: then it is of no use any more.
    void restore(ArchiveReader& bytes);

private:
    class Work;
    std::unique_ptr<Work> work_;
};

/// Renders into the film, to the end. `keep_going` is called between passes; false ends the render. A pass that is
/// stopped leaves its finished samples in the film, which do not count as a pass. Throws like Render.
RenderStatistics render(const Scene& scene, Film& film, const RenderSettings& settings,
                        const std::function<bool(const RenderProgress&)>& keep_going = {});

}  // namespace wend
