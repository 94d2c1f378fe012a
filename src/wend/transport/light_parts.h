// The light that a path brings, sorted by what the path did and by where the light comes from.
#pragma once

#include <wend/core/colour.h>
#include <wend/scene/media_at.h>
#include <wend/scene/scene.h>
#include <wend/transport/path_state.h>

#include <array>
#include <cstddef>
#include <vector>

namespace wend {

/// By what a path did between the camera and the light. Each path is of one of these, so that they add up to all.
enum class PathPart {
    emission,    ///< nothing: the light, or a medium that glows, is seen as it is
    background,  ///< the same, and the light is at infinity
    direct,      ///< it was scattered once, by a surface
    indirect,    ///< several times, first by a surface
    volume       ///< first in a medium
};
inline constexpr std::size_t path_parts = 5;

/// Where light comes from: one of the scene's lights, or a medium.
struct LightOrigin {
    int light = -1;            ///< an index of Scene::lights(); -1: a medium's own
    MediumId medium = vacuum;  ///< of that
};

/// Which parts are wanted: for each a number, or `none`.
struct PartsPlan {
    static constexpr int none = -1;

    int count = 0;
    std::array<int, path_parts> by_path{none, none, none, none, none};
    std::vector<int> by_light, by_medium;  ///< empty where these do not matter
    std::vector<bool> is_at_infinity;      ///< by light

    bool is_empty() const { return count == 0; }
};

/// The sums of one walk, with all its branches. Counts in doubles, so that the parts add up to the whole as far as the
/// whole is exact.
class LightParts {
public:
    using Sum = std::array<double, 3>;

    explicit LightParts(const PartsPlan& plan) : plan_(plan), sums_(static_cast<std::size_t>(plan.count)) {}

    void start() { std::fill(sums_.begin(), sums_.end(), Sum{}); }

    /// Light with its weight, brought by a path that has met so much.
    void add(const Rgb& light, const PathCounts& counts, const LightOrigin& origin) {
        add(plan_.by_path[static_cast<std::size_t>(part_of(counts, origin))], light);
        if (!plan_.by_light.empty()) {
            add(origin.light >= 0 ? plan_.by_light[static_cast<std::size_t>(origin.light)]
                                  : plan_.by_medium[static_cast<std::size_t>(origin.medium)],
                light);
        }
    }

    const std::vector<Sum>& sums() const { return sums_; }

private:
    PathPart part_of(const PathCounts& counts, const LightOrigin& origin) const {
        if (counts.vertices == 0) {
            const bool is_far = origin.light >= 0 && plan_.is_at_infinity[static_cast<std::size_t>(origin.light)];
            // What is not told apart is a part of what is seen.
            const bool is_apart = plan_.by_path[static_cast<std::size_t>(PathPart::background)] != PartsPlan::none;
            return is_far && is_apart ? PathPart::background : PathPart::emission;
        }
        return counts.begins_in_medium ? PathPart::volume
               : counts.vertices == 1  ? PathPart::direct
                                       : PathPart::indirect;
    }
    void add(int part, const Rgb& light) {
        if (part != PartsPlan::none) {
            Sum& sum = sums_[static_cast<std::size_t>(part)];
            for (int c = 0; c < 3; ++c) {
                sum[static_cast<std::size_t>(c)] += static_cast<double>(light[c]);
            }
        }
    }

    const PartsPlan& plan_;
    std::vector<Sum> sums_;
};

}  // namespace wend
