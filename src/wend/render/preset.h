// Names of ways to sample: "classical", decisions joined by '+', or "full" for all of them, guided where each pays.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace wend {

/// The share of guided flights that follow the medium alone, whatever the guide says (docs/theory/distance.md).
inline constexpr float classical_flights = 0.25f;

/// Which decisions follow what was learned.
struct Preset {
    bool scatter = false;   ///< whether to scatter in a medium or reach its end
    bool distance = false;  ///< where to scatter as well
    bool direction = false;
    bool roulette = false;
    bool splitting = false;
    /// Whether pixels get samples by their noise, and not all as many (render/sample_budget.h).
    bool adaptive = false;
    /// Whether these decisions are guided only in those parts of the picture where that is found to pay
    /// (GuidingChoice).
    bool where_it_pays = false;

    /// Whether nothing is guided.
    bool is_classical() const {
        Preset paths = *this;
        paths.adaptive = false;
        return paths == Preset();
    }
    bool guides_distance() const { return scatter || distance; }
    /// Whether walks end or split by expected contribution.
    bool guides_survival() const { return roulette || splitting; }
    friend bool operator==(const Preset&, const Preset&) = default;
};

/// Parses a value of --sampling. Throws InputError, listing the names that are known, for any other.
Preset parse_preset(std::string_view text);

/// The canonical name.
std::string to_string(const Preset& preset);

/// Classical sampling, each decision guided alone, all of them, and all but each: what tells how much each one brings.
/// A guided distance comes with a guided choice to scatter, so leaving out scatter leaves out both.
std::vector<Preset> ablation_presets();

/// The decision that a preset of the ablation has alone ("only distance") or leaves out ("no distance"); empty for
/// others.
std::string ablation_role(const Preset& preset);

/// Names of the decisions that can be joined.
std::vector<std::string> guidable_decisions();

}  // namespace wend
