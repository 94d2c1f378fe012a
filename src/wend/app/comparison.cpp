#include <wend/app/comparison.h>
#include <wend/app/progress.h>
#include <wend/app/report_page.h>
#include <wend/core/error.h>
#include <wend/film/false_colour.h>
#include <wend/film/flip.h>
#include <wend/io/atomic_file.h>
#include <wend/io/image_file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace wend {
namespace {

constexpr ColourScale error_scale{ColourScale::Kind::logarithmic, 1e-3f, 10.0f};

/// One render of one preset with one seed.
struct Run {
    RenderStatistics statistics;
    Image image;
    Metrics metrics;
    ConvergenceSeries::Point at(double seconds) const { return {seconds, metrics.relmse}; }
};

Run run_once(const Session& session, const RenderSettings& settings, const Reference& reference, ProgressBar& bar,
             std::vector<ConvergenceSeries::Point>& points) {
    Film film = session.new_film();
    // Pictures on the way are kept at times that double, and measured when the clock has stopped.
    std::vector<std::pair<double, Image>> snapshots;
    double next_snapshot = 0;
    Run run;
    run.statistics = render(session.scene(), film, settings, [&](const RenderProgress& progress) {
        bar.update(progress);
        if (progress.seconds >= next_snapshot) {
            snapshots.emplace_back(progress.seconds, film.beauty());
            next_snapshot = progress.seconds * 2;
        }
        return true;
    });
    run.image = film.beauty();
    run.metrics = measure(run.image, reference);
    for (const auto& [seconds, image] : snapshots) {
        points.push_back({seconds, measure(image, reference).relmse});
    }
    points.push_back({run.statistics.seconds, run.metrics.relmse});
    return run;
}

std::string file_name(const std::string& preset) {
    std::string name = preset;
    std::replace(name.begin(), name.end(), '+', '-');
    return name;
}

}  // namespace

std::vector<ComparisonRow> compare_presets(const Session& session, const std::vector<Preset>& presets, double seconds,
                                           int seeds, const Reference& reference, const CommonOptions& common,
                                           const Streams& streams) {
    const Film film = session.new_film();
    if (reference.a.width != film.crop().width() || reference.a.height != film.crop().height()) {
        throw InputError(
            fmt::format("the reference has {} x {} pixels, the picture {} x {}: choose --resolution to match",
                        reference.a.width, reference.a.height, film.crop().width(), film.crop().height()));
    }
    std::vector<std::vector<Run>> runs(presets.size());
    std::vector<std::vector<std::vector<ConvergenceSeries::Point>>> points(presets.size());
    for (int seed = 0; seed < seeds; ++seed) {
        for (std::size_t p = 0; p < presets.size(); ++p) {
            RenderSettings settings = session.settings();
            settings.preset = presets[p];
            settings.seconds = seconds;
            settings.seed += static_cast<std::uint64_t>(seed) + 1;
            ProgressBar bar(streams.err, !common.quiet,
                            fmt::format("{} {}/{}", to_string(presets[p]), seed + 1, seeds));
            points[p].emplace_back();
            runs[p].push_back(run_once(session, settings, reference, bar, points[p].back()));
        }
    }
    std::vector<ComparisonRow> rows;
    for (std::size_t p = 0; p < presets.size(); ++p) {
        std::vector<std::size_t> order(runs[p].size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            order[i] = i;
        }
        std::sort(order.begin(), order.end(),
                  [&](std::size_t a, std::size_t b) { return runs[p][a].metrics.relmse < runs[p][b].metrics.relmse; });
        const std::size_t median = order[order.size() / 2];
        Run& run = runs[p][median];
        ComparisonRow row;
        row.preset = presets[p];
        row.samples = run.statistics.samples;
        row.seconds = run.statistics.seconds;
        row.metrics = run.metrics;
        row.flip = flip(run.image, reference.average()).mean;
        row.image = std::move(run.image);
        row.convergence = {to_string(presets[p]), points[p][median]};
        rows.push_back(std::move(row));
    }
    const auto classical =
        std::find_if(rows.begin(), rows.end(), [](const ComparisonRow& r) { return r.preset.is_classical(); });
    if (classical != rows.end()) {
        for (ComparisonRow& row : rows) {
            row.ratio = classical->metrics.relmse * classical->seconds / (row.metrics.relmse * row.seconds);
        }
    }
    return rows;
}

std::string comparison_table(const std::vector<ComparisonRow>& rows) {
    std::string table = fmt::format("{:<24}  {:>7}  {:>8}  {:>11}  {:>11}  {:>7}  {:>6}\n", "sampling", "spp",
                                    "seconds", "relMSE", "trimmed", "FLIP", "ratio");
    for (const ComparisonRow& r : rows) {
        table += fmt::format("{:<24}  {:>7.0f}  {:>8.2f}  {:>11.4g}  {:>11.4g}  {:>7.4f}  {:>6}\n", to_string(r.preset),
                             r.samples, r.seconds, r.metrics.relmse, r.metrics.relmse_trimmed, r.flip,
                             r.ratio ? fmt::format("{:.2f}", *r.ratio) : "-");
    }
    return table;
}

nlohmann::json comparison_json(const std::vector<ComparisonRow>& rows) {
    nlohmann::json list = nlohmann::json::array();
    for (const ComparisonRow& r : rows) {
        list.push_back({{"sampling", to_string(r.preset)},
                        {"spp", r.samples},
                        {"seconds", r.seconds},
                        {"relmse", json_number(r.metrics.relmse)},
                        {"relmse_trimmed", json_number(r.metrics.relmse_trimmed)},
                        {"mse", json_number(r.metrics.mse)},
                        {"mape", json_number(r.metrics.mape)},
                        {"flip", json_number(r.flip)},
                        {"ratio", r.ratio ? json_number(*r.ratio) : nlohmann::json(nullptr)}});
    }
    return list;
}

void make_report_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
        throw InputError(Place{folder.string()}, "the folder cannot be made: " + error.message());
    }
    require_writable(folder / "index.html");
}

void write_comparison(const std::filesystem::path& folder, const Session& session,
                      const std::vector<ComparisonRow>& rows, const Reference& reference, double seconds, int seeds) {
    Report report;
    report.scene = std::filesystem::path(session.scene_file()).filename().string();
    report.title = fmt::format("{}: {:g} seconds each", report.scene, seconds);
    report.settings = {
        {"resolution", fmt::format("{} x {}", reference.a.width, reference.a.height)},
        {"seeds", fmt::format("{}, the median shown", seeds)},
        {"threads", session.settings().threads == 0 ? "all" : std::to_string(session.settings().threads)},
        {"maximum depth", std::to_string(session.settings().max_depth)}};
    report.error_quantity = "relative squared error";
    report.error_scale = error_scale;
    for (const ComparisonRow& r : rows) {
        const std::string name = file_name(to_string(r.preset));
        const Image errors =
            false_colour(relative_squared_errors(r.image, reference), r.image.width, r.image.height, error_scale);
        for (const auto& [file, image] : {std::pair{name, &r.image}, {name + "-error", &errors}}) {
            write_picture(folder / (file + ".png"), {*image, {}, {}, {0, 0}, {image->width, image->height}});
        }
        write_picture(folder / (name + ".exr"), {r.image, {}, {}, {0, 0}, {r.image.width, r.image.height}});
        report.pictures.push_back({to_string(r.preset), png_bytes(r.image), png_bytes(errors)});
        report.rows.push_back({to_string(r.preset), r.samples, r.seconds, r.metrics.relmse, r.metrics.relmse_trimmed,
                               r.metrics.mse, r.flip, r.ratio});
        report.convergence.push_back(r.convergence);
    }
    report.pictures.push_back({"reference", png_bytes(reference.average()), ""});
    write_atomically(folder / "index.html", report_page(report));
}

}  // namespace wend
