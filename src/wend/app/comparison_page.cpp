#include <wend/app/comparison_page.h>

#include <wend/app/comparison_data.h>
#include <wend/app/report_page.h>
#include <wend/film/false_colour.h>
#include <wend/io/image_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace wend {
namespace {

constexpr ColourScale error_scale{ColourScale::Kind::logarithmic, 1e-3f, 10.0f};

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

ReportRow report_row(const ComparisonRow& r) {
    return {to_string(r.way),
            ablation_role(r.way.preset),
            r.samples,
            r.seconds,
            r.metrics.relmse,
            r.metrics.relmse_trimmed,
            r.metrics.error_p9999,
            r.metrics.mse,
            r.flip,
            r.ratio,
            relmse_spread(r),
            ratio_spread(r)};
}

/// How the reference came about, and how noisy it is.
std::string reference_text(const KnownReference& reference) {
    std::string text = reference.rendered.empty() ? "read from files" : "rendered";
    for (const RenderedHalf& half : reference.rendered) {
        text += fmt::format(", {} spp in {:.3g} s", half.samples, half.seconds);
    }
    const std::optional<double> noise = noise_of(reference.halves);
    return text + (noise ? fmt::format("; its own relMSE {:.2g}, left out of the errors", *noise)
                         : "; one picture, whose noise counts as error");
}

std::vector<std::pair<std::string, std::string>> settings_of(const Comparison& comparison) {
    const Vec2i size = comparison.reference.size();
    const int threads = comparison.settings.at("threads"), depth = comparison.settings.at("max_depth");
    return {{"resolution", fmt::format("{} x {}", size.x, size.y)},
            {"seeds", fmt::format("{}, the median shown", comparison.plan.seeds)},
            {"threads", threads == 0 ? "all" : std::to_string(threads)},
            {"maximum depth", depth == (1 << 30) ? "none" : std::to_string(depth)},
            {"version", comparison.settings.at("version")},
            {"reference", reference_text(comparison.reference)}};
}

}  // namespace

Image error_map(const ComparisonRow& row, const Reference& reference) {
    return false_colour(relative_squared_errors(row.image, reference), row.image.width, row.image.height, error_scale);
}

std::string comparison_page(const Comparison& comparison) {
    const std::vector<ComparisonRow>& rows = comparison.rows;
    const Reference& reference = comparison.reference.halves;
    const std::vector<WalkMap> walks = walk_maps(rows);
    Report report;
    report.scene = std::filesystem::path(comparison.scene).filename().string();
    report.title = fmt::format("{}: {:g} seconds each", report.scene, comparison.plan.seconds);
    report.settings = settings_of(comparison);
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

}  // namespace wend
