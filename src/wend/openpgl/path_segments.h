// From the segments of a path to samples, in one sweep from its end.
#pragma once

#include <openpgl/data.h>
#include <wend/core/colour.h>
#include <wend/openpgl/sample_store.h>

#include <cstddef>
#include <span>
#include <vector>

namespace wend::openpgl {

/// What of the light that a path met counts in its samples.
struct LightRules {
    /// Light at the very next vertex has its weight of multiple importance sampling, as light further on always has.
    bool weights_next = false;
    /// Light at the very next vertex counts at all.
    bool counts_next = false;
    /// Light that was met is divided by the survival just before it.
    bool divides_by_survival = true;
};

/// The segments of one path.
class PathSegments {
public:
    /// Room for so many. Another number than before drops those that are there.
    void reserve(std::size_t most);
    void clear();

    /// A new segment of default values, where it stays until reserve(); null if there is no room.
    PGLPathSegmentData* next();
    /// The segments so far.
    std::span<const PGLPathSegmentData> segments() const { return {segments_.data(), size_}; }

    /// A sample beside those of the path.
    void add_sample(const PGLSampleData& sample);

    /// Makes a sample of every segment but the last, in place of those made before: the radiance that arrived along its
    /// direction,
    ///     L_i = t_i (s_{i+1} + e_{i+1} + w_{i+1} / q_{i+1} · L'_{i+1}),
    /// with the flight's weight t, scattered light s, the scattering function's weight w, survival q, the light met e
    /// by the rules, and L' as L but for light at the next vertex, which counts, weighted. The survival q_i is not in
    /// it, since a path that ended there has no sample of i. There is none for mirrors. Nothing is clamped. Where L is
    /// zero it is one of value zero.
    void prepare(const LightRules& rules);

    /// Those that were made and those that were added.
    std::span<const Sample> samples() const { return samples_; }
    /// The same without colours.
    std::span<const PGLSampleData> plain_samples() const { return plain_; }
    std::span<const PGLZeroValueSampleData> zero_samples() const { return zeros_; }

    /// What the path brought to its first vertex and from there to where it began, by the segments.
    Rgb estimate(bool divides_by_survival) const;

    /// Half of what the distance of a sample may be.
    float max_distance = 1e6f;

private:
    std::vector<PGLPathSegmentData> segments_;
    std::size_t size_ = 0;
    std::vector<Sample> samples_, added_;
    std::vector<PGLSampleData> plain_;
    std::vector<PGLZeroValueSampleData> zeros_;
};

/// Whether a segment's numbers are finite and in their ranges.
bool is_usable(const PGLPathSegmentData& segment);

}  // namespace wend::openpgl
