// The comparisons of several scenes, as one report that grows from scene to scene.
#pragma once

#include <wend/app/comparison.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace wend {

/// A scene that could not be compared, and why.
struct FailedScene {
    std::string scene;
    std::string error;
};

class ComparisonReport {
public:
    /// Empty folder: nothing is written. Otherwise it is made, and each scene gets a folder in it; throws InputError
    /// where that cannot be.
    ComparisonReport(std::filesystem::path folder, const std::vector<std::string>& scenes);

    /// Where the files of a scene belong, by its place among all; empty where nothing is written.
    std::filesystem::path folder_of(std::size_t scene) const;

    /// Writes the scene's own folder and the report so far. Pictures are not kept in memory.
    void add(std::size_t scene, Comparison comparison);
    void add_failure(std::size_t scene, const std::string& error);

    const std::vector<Comparison>& comparisons() const { return comparisons_; }
    const std::vector<FailedScene>& failed() const { return failed_; }
    /// All rows, what is known of each scene, and how gains are distributed. The settings and the reference of a lone
    /// scene are there as results_json() has them.
    nlohmann::json json() const;

private:
    void write() const;

    std::filesystem::path folder_;
    std::vector<std::string> scenes_, names_;             ///< files, and their folders' names
    std::vector<Comparison> comparisons_;                 ///< without pictures
    nlohmann::json described_ = nlohmann::json::array();  ///< what is known of each comparison but its rows
    std::vector<std::size_t> places_;                     ///< of the comparisons, among all scenes
    std::vector<std::string> thumbnails_;                 ///< PNG files, one for each comparison
    std::vector<FailedScene> failed_;
};

}  // namespace wend
