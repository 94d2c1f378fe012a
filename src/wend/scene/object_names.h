// What a scene calls its shapes and media.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace wend {

/// Names take little memory where they are the places in files that shapes come from.
struct ObjectNames {
    struct Name {
        int text = -1;  ///< an index of `texts`; -1: there is none
        int line = 0;   ///< in the file that the text then is; 0: the text is the name
    };

    std::vector<std::string> texts;  ///< given names, and names of files
    std::vector<Name> of_surfaces;   ///< by surface, as far as there are any
    std::vector<std::string> of_media;

    /// "lamp" if the scene says so, "room.pbrt:12" otherwise; by its number where nothing is known.
    std::string surface(std::size_t i) const {
        if (i >= of_surfaces.size() || of_surfaces[i].text < 0) {
            return "surface " + std::to_string(i);
        }
        const Name& name = of_surfaces[i];
        const std::string& text = texts[static_cast<std::size_t>(name.text)];
        return name.line == 0 ? text : text + ':' + std::to_string(name.line);
    }
    std::string medium(std::size_t i) const {
        return i < of_media.size() && !of_media[i].empty() ? of_media[i] : "medium " + std::to_string(i);
    }
};

}  // namespace wend
