// Names of what may be guided: "classical", or decisions joined by '+'.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace wend {

/// Which decisions follow the learned field.
struct Preset {
    bool direction = false;

    bool is_classical() const { return !direction; }
    friend bool operator==(const Preset&, const Preset&) = default;
};

/// Parses a value of --sampling. Throws InputError, listing the names that are known, for any other.
Preset parse_preset(std::string_view text);

/// The canonical name.
std::string to_string(const Preset& preset);

/// Names of the decisions that can be guided.
std::vector<std::string> guidable_decisions();

}  // namespace wend
