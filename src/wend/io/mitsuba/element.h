// A Mitsuba 3 scene as its XML has it, with parameters, includes and aliases worked out: no meaning yet.
#pragma once

#include <wend/io/pbrt/location.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace wend::mitsuba {

/// `<tag name="value" ...> children </tag>`.
struct Element {
    std::string tag;
    std::vector<std::pair<std::string, std::string>> attributes;
    std::vector<std::unique_ptr<Element>> children;
    pbrt::Location place;

    /// The attribute's value; empty where it is absent.
    std::string_view attribute(std::string_view name) const {
        for (const auto& [key, value] : attributes) {
            if (key == name) {
                return value;
            }
        }
        return {};
    }
    bool has(std::string_view name) const {
        for (const auto& [key, value] : attributes) {
            if (key == name) {
                return true;
            }
        }
        return false;
    }
};

/// All that a scene's files hold.
struct Document {
    std::unique_ptr<Element> root;  ///< `<scene>`
    /// What references refer to, aliases included.
    std::unordered_map<std::string, const Element*> ids;
    std::vector<std::filesystem::path> files;    ///< that were read; none if the text is no file
    std::vector<std::filesystem::path> folders;  ///< where `<path>` says that files are, the last one first
    std::filesystem::path base_directory;        ///< of the main file
};

}  // namespace wend::mitsuba
