#include <wend/app/comparison_page.h>
#include <wend/app/report_page.h>
#include <wend/film/false_colour.h>
#include <wend/io/atomic_file.h>
#include <wend/io/image_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace wend {
namespace {

constexpr ColourScale error_scale{ColourScale::Kind::logarithmic, 1e-3f, 10.0f};

std::string file_name(const WayOfSampling& way) {
    std::string name = to_string(way);
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '+' || c == '/'; }, '-');
    return name;
}

const std::vector<float>& values_of(const ComparisonRow& row, const std::string& layer) {
    return std::find_if(row.walks.begin(), row.walks.end(), [&](const Layer& l) { return l.name == layer; })->values;
}

/// From `low` to the largest value of a layer, the same for all rows; never empty.
ColourScale common_scale(const std::vector<ComparisonRow>& rows, const std::string& layer, ColourScale::Kind kind,
                         float low) {
    float high = 2 * low;
    for (const ComparisonRow& row : rows) {
        const std::vector<float>& values = values_of(row, layer);
        high = std::max(high, *std::max_element(values.begin(), values.end()));
    }
    return {kind, low, high};
}

/// A layer of what walks did, and how it is shown.
struct WalkMap {
    std::string layer;
    ReportMap shown;
};

std::vector<WalkMap> walk_maps(const std::vector<ComparisonRow>& rows) {
    using Kind = ColourScale::Kind;
    return {{"scatter",
             {"Scattering", "what media before the first surface take of its light", {Kind::linear, 0.0f, 1.0f}}},
            {"segments",
             {"Walk length", "segments a sample, of all branches",
              common_scale(rows, "segments", Kind::logarithmic, 1.0f)}},
            {"guided", {"Guiding", "share of walks that were guided", {Kind::linear, 0.0f, 1.0f}}},
            {"branches", {"Splitting", "branches a sample", common_scale(rows, "branches", Kind::logarithmic, 1.0f)}}};
}

Image error_map(const ComparisonRow& row, const Reference& reference) {
    return false_colour(relative_squared_errors(row.image, reference), row.image.width, row.image.height, error_scale);
}

ReportRow report_row(const ComparisonRow& r) {
    return {to_string(r.way),         ablation_role(r.way.preset), r.samples,     r.seconds, r.metrics.relmse,
            r.metrics.relmse_trimmed, r.metrics.error_p9999,       r.metrics.mse, r.flip,    r.ratio};
}

}  // namespace

std::string comparison_page(const Session& session, const std::vector<ComparisonRow>& rows, const Reference& reference,
                            double seconds, int seeds) {
    const std::vector<WalkMap> walks = walk_maps(rows);
    Report report;
    report.scene = std::filesystem::path(session.scene_file()).filename().string();
    report.title = fmt::format("{}: {:g} seconds each", report.scene, seconds);
    report.settings = {
        {"resolution", fmt::format("{} x {}", reference.a.width, reference.a.height)},
        {"seeds", fmt::format("{}, the median shown", seeds)},
        {"threads", session.settings().threads == 0 ? "all" : std::to_string(session.settings().threads)},
        {"maximum depth", std::to_string(session.settings().max_depth)}};
    report.maps = {{"Error", "relative squared error", error_scale}};
    for (const WalkMap& map : walks) {
        report.maps.push_back(map.shown);
    }
    report.pictures.push_back({"reference", "", png_bytes(reference.average()), {}});
    for (const ComparisonRow& r : rows) {
        const int width = r.image.width, height = r.image.height;
        std::vector<std::string> maps = {png_bytes(error_map(r, reference))};
        for (const WalkMap& map : walks) {
            maps.push_back(png_bytes(false_colour(values_of(r, map.layer), width, height, map.shown.scale)));
        }
        report.pictures.push_back({to_string(r.way),
                                   fmt::format("{:.0f} spp, relMSE {:.3g}", r.samples, r.metrics.relmse),
                                   png_bytes(r.image), std::move(maps)});
        report.rows.push_back(report_row(r));
        report.convergence.push_back(r.convergence);
    }
    // The first way of sampling against the last; a lone one against the reference.
    report.left = rows.size() > 1 ? 1 : 0;
    report.right = rows.size();
    return report_page(report);
}

void write_comparison(const std::filesystem::path& folder, const Session& session,
                      const std::vector<ComparisonRow>& rows, const Reference& reference, double seconds, int seeds) {
    for (const ComparisonRow& r : rows) {
        const std::string name = file_name(r.way);
        const int width = r.image.width, height = r.image.height;
        const Image errors = error_map(r, reference);
        for (const auto& [file, image] : {std::pair{name, &r.image}, {name + "-error", &errors}}) {
            write_picture(folder / (file + ".png"), {*image, {}, {}, {0, 0}, {width, height}});
        }
        write_picture(folder / (name + ".exr"), {r.image, r.walks, {}, {0, 0}, {width, height}});
    }
    write_atomically(folder / "index.html", comparison_page(session, rows, reference, seconds, seeds));
}

}  // namespace wend
