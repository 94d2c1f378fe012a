// Names that a scene gives to its lights, for pictures of some of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace wend {

struct LightGroups {
    static constexpr int none = -1;
    /// What no group is called: those that are in none together.
    static constexpr const char* rest = "rest";

    std::vector<std::string> names;
    std::vector<int> of_lights;  ///< by light, as far as there are any: an index of names, or none
    std::vector<int> of_media;   ///< the same of media that glow

    /// The index of a name, which is added where it is new.
    int index_of(const std::string& name) {
        const auto index = static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
        if (index == static_cast<int>(names.size())) {
            names.push_back(name);
        }
        return index;
    }
    static int get(const std::vector<int>& groups, std::size_t i) { return i < groups.size() ? groups[i] : none; }
    /// Those from `begin` to before `end` are in a group.
    static void set(std::vector<int>& groups, std::size_t begin, std::size_t end, int group) {
        groups.resize(std::max(groups.size(), end), none);
        std::fill(groups.begin() + static_cast<std::ptrdiff_t>(begin),
                  groups.begin() + static_cast<std::ptrdiff_t>(end), group);
    }
};

}  // namespace wend
