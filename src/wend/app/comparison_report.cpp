#include <wend/app/comparison_report.h>

#include <wend/app/comparison_data.h>
#include <wend/app/comparison_files.h>
#include <wend/app/gains.h>
#include <wend/app/report_folder.h>
#include <wend/app/scenes_page.h>
#include <wend/io/atomic_file.h>
#include <wend/io/image_file.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace wend {
namespace {

/// Of each scene the file's name without its extension; of several alike all but the first with a number.
std::vector<std::string> folder_names(const std::vector<std::string>& scenes) {
    std::vector<std::string> names;
    for (const std::string& scene : scenes) {
        const std::string stem = std::filesystem::path(scene).stem().string();
        std::string name = stem;
        for (int number = 2; std::find(names.begin(), names.end(), name) != names.end(); ++number) {
            name = stem + "-" + std::to_string(number);
        }
        names.push_back(name);
    }
    return names;
}

/// The picture by whole factors smaller, so that it is at most so wide.
Image thumbnail(const Image& image, int most_wide) {
    const int factor = (image.width + most_wide - 1) / most_wide;
    Image small(std::max(1, image.width / factor), std::max(1, image.height / factor));
    const int columns = std::min(factor, image.width), rows = std::min(factor, image.height);
    const float scale = 1 / static_cast<float>(columns * rows);
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
            Rgb sum;
            for (int i = 0; i < rows * columns; ++i) {
                sum += image.at(x * columns + i % columns, y * rows + i / columns);
            }
            small.at(x, y) = sum * scale;
        }
    }
    return small;
}

void drop_pictures(Comparison& comparison) {
    for (ComparisonRow& row : comparison.rows) {
        row.image = {};
        row.errors = {};
        row.walks = {};
    }
    comparison.reference.halves = {};
}

}  // namespace

ComparisonReport::ComparisonReport(std::filesystem::path folder, const std::vector<std::string>& scenes)
    : folder_(std::move(folder)), scenes_(scenes), names_(folder_names(scenes)) {
    if (!folder_.empty()) {
        make_report_folder(folder_);
    }
}

std::filesystem::path ComparisonReport::folder_of(std::size_t scene) const {
    return folder_.empty() ? folder_ : folder_ / names_[scene];
}

void ComparisonReport::add(std::size_t scene, Comparison comparison) {
    if (!folder_.empty()) {
        make_report_folder(folder_of(scene));
        write_comparison(folder_of(scene), comparison);
    }
    thumbnails_.push_back(png_bytes(thumbnail(comparison.reference.halves.average(), 480)));
    const std::string folder = folder_of(scene).string();
    described_.push_back({{"scene", comparison.scene},
                          {"settings", comparison.settings},
                          {"reference", reference_json(comparison.reference)},
                          {"folder", folder.empty() ? nlohmann::json(nullptr) : nlohmann::json(folder)}});
    drop_pictures(comparison);
    comparisons_.push_back(std::move(comparison));
    places_.push_back(scene);
    write();
}

void ComparisonReport::add_failure(std::size_t scene, const std::string& error) {
    failed_.push_back({scenes_[scene], error});
    write();
}

nlohmann::json ComparisonReport::json() const {
    nlohmann::json rows = nlohmann::json::array(), failed = nlohmann::json::array();
    for (const Comparison& comparison : comparisons_) {
        for (nlohmann::json& row : comparison_json(comparison)) {
            rows.push_back(std::move(row));
        }
    }
    for (const FailedScene& one : failed_) {
        failed.push_back({{"scene", one.scene}, {"error", one.error}});
    }
    nlohmann::json json = {{"rows", std::move(rows)},
                           {"scenes", described_},
                           {"gains", gains_json(gain_distributions(comparisons_), comparisons_)},
                           {"failed", std::move(failed)}};
    if (!comparisons_.empty()) {
        json["seeds"] = comparisons_.front().plan.seeds;
        json["time"] = comparisons_.front().plan.seconds;
    }
    if (scenes_.size() == 1 && comparisons_.size() == 1) {
        json["settings"] = described_[0]["settings"];
        json["reference"] = described_[0]["reference"];
    }
    return json;
}

void ComparisonReport::write() const {
    if (folder_.empty()) {
        return;
    }
    ScenesPage page{comparisons_, thumbnails_, {}, failed_, scenes_.size()};
    for (const std::size_t place : places_) {
        page.links.push_back(names_[place] + "/index.html");
    }
    write_tables(folder_, comparisons_);
    write_atomically(folder_ / "comparison.json", json_text(json(), 2) + "\n");
    write_atomically(folder_ / "index.html", scenes_page(page));
}

}  // namespace wend
