// How walks are guided inside dense media: the values of --subsurface.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace wend {

/// Which outward normal a walk inside a dense medium takes the boundary to have.
enum class InteriorStrategy {
    entry,     ///< that where it entered (krivanek2014)
    closest,   ///< that of the boundary closest to each collision (meng2016)
    incident,  ///< towards the light that diffuses in from outside (after meng2016)
    learned,   ///< as incident, and to the lamps that are seen from the closest boundary (after gouder2025)
};

/// A value of --subsurface.
struct SubsurfacePreset {
    std::optional<InteriorStrategy> strategy;  ///< beside classical sampling

    bool is_classical() const { return !strategy; }
    friend bool operator==(const SubsurfacePreset&, const SubsurfacePreset&) = default;
};

/// Parses a value of --subsurface; `learned` is another name of `auto`, and what was `planar` is `closest`. Throws
/// InputError, listing the names that there are, for any other.
SubsurfacePreset parse_subsurface(std::string_view text);

/// The canonical name.
std::string to_string(const SubsurfacePreset& preset);

/// The canonical names, separated by commas.
std::string subsurface_names();

}  // namespace wend
