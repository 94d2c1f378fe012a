// In which medium a walk is where boundaries touch, overlap or lie within each other.
#pragma once

#include <wend/scene/traced_ray.h>

#include <array>
#include <cstdint>
#include <vector>

namespace wend {

struct SceneDescription;
struct Surface;

/// Index of a medium in the scene's list; `vacuum` is none.
using MediumId = int;
inline constexpr MediumId vacuum = -1;

/// The medium that a walk is in, and the regions that it is in where the scene tells them apart. A small value.
class MediumState {
public:
    MediumState() = default;
    explicit MediumState(MediumId medium) : id(medium) {}

    friend bool operator==(const MediumState&, const MediumState&) = default;

    MediumId id = vacuum;

private:
    friend class MediumRegions;

    static constexpr std::int32_t nowhere = -1;

    /// Parts of the regions that it is in (MediumRegions), the smallest region first, then `nowhere`. What there is no
    /// room for is the largest.
    std::array<std::int32_t, 6> inside_{nowhere, nowhere, nowhere, nowhere, nowhere, nowhere};
};

/// The regions of space that the boundaries of media enclose: one for each closed part of a boundary that hangs
/// together, in each place where it stands. As long as each is apart from all others, or lies within a medium that its
/// surfaces name as their exterior, surfaces tell the media on their sides, and there is nothing else to know: then
/// this is empty. Where boundaries touch, overlap or lie in a medium that they do not name, a walk is in the smallest
/// of the regions it is in, whatever the order in which it crossed their boundaries. So it is where boundaries or the
/// camera move: then what the camera is in depends on the time. Beyond a surface that encloses nothing a walk is where
/// that surface says.
class MediumRegions {
public:
    /// No region: of surfaces that enclose nothing.
    static constexpr std::int32_t none = -1;

    /// None.
    MediumRegions() = default;
    explicit MediumRegions(const SceneDescription& scene);

    bool is_empty() const { return media_of_parts_.empty(); }

    /// A walk goes through a surface that bounds a medium: to its interior, or to its exterior.
    void cross(MediumState& state, const Surface& surface, const SurfaceElement& element, bool inwards) const;

    /// The region of an element of a boundary, or none. There must be regions.
    int region(const SurfaceElement& element) const;

private:
    std::vector<std::vector<std::int32_t>> parts_;  ///< by surface and primitive, or for all its primitives
    std::vector<std::int32_t> first_;               ///< by instance, after the world itself: its first region
    std::vector<std::int32_t> rank_;                ///< of regions by their size
    /// The media that each region's boundary names as its interior, by rank: several where walls part it.
    std::vector<MediumId> media_of_parts_;
    std::vector<std::int32_t> first_part_{0};  ///< of each region, by rank; at last the end
};

}  // namespace wend
