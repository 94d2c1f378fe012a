// Layers of a film that are there only where they are asked for.
#pragma once

#include <string>
#include <vector>

namespace wend {

/// What a film holds beside what every film does.
struct FilmLayers {
    std::vector<std::string> parts;  ///< names of colours that are weighted as the beauty is, such as parts of it
    /// `half_a` and `half_b`, of half of the samples each: see Film::picture().
    bool halves = false;
    bool geometry = false;  ///< `position` and `face_normal` of what rays show
    bool objects = false;   ///< which objects rays show: cryptomatte_layers()
};

/// Names of parts that are one light group's.
inline constexpr const char* light_group_prefix = "light_";

/// Whether a layer is a part of the beauty, or one of its halves: it counts in sums as the beauty does.
bool counts_as_beauty(const std::string& layer);

}  // namespace wend
