#include <wend/app/halfspace_table.h>

#include <wend/app/planar_options.h>
#include <wend/app/planar_report.h>
#include <wend/planar/half_space.h>
#include <wend/stats/figure_of_merit.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace wend {
namespace {

/// The samplers of the table with their options, all else as in `base`.
std::vector<PlanarExperiment> variants(const PlanarExperiment& base) {
    std::vector<PlanarExperiment> result;
    const auto add = [&](const char* sampler) -> PlanarExperiment& {
        result.push_back(base);
        result.back().sampler = sampler;
        return result.back();
    };
    add("analog");
    add("classical");
    add("dwivedi").first_flight = FirstFlight::classical;
    add("dwivedi").first_flight = FirstFlight::stretched;
    add("boundary").moments = MatchedMoments::zeroth_first;
    add("boundary").moments = MatchedMoments::first_second;
    add("boundary").exponentials = 2;
    for (const int modes : {2, 4, 8, 16, 32}) {
        add("modes").modes = modes;
    }
    return result;
}

/// The variance of one walk in closed form, where there is one.
std::optional<double> closed_form(const PlanarExperiment& e) {
    if (e.g != 0 || e.ior != 1 || !e.mu0 || e.window != PlanarWindow::none) {
        return std::nullopt;
    }
    const double albedo = e.albedo.front();
    if (e.sampler == "analog") {
        const double survival = reflectance(albedo, *e.mu0);
        return survival * (1 - survival);
    }
    if (e.sampler == "classical") {
        return classical_variance(albedo, *e.mu0);
    }
    return e.sampler == "dwivedi" ? std::optional(dwivedi_variance(albedo, *e.mu0, e.first_flight)) : std::nullopt;
}

std::optional<double> merit(const HalfspaceRow& row) {
    return figure_of_merit(row.result.channels.front(), row.result.seconds);
}

/// The row of classical sampling at the same albedo; null if there is none.
const HalfspaceRow* classical_beside(const HalfspaceRow& row, const std::vector<HalfspaceRow>& rows) {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const HalfspaceRow& other) {
        return other.experiment.sampler == "classical" && other.experiment.albedo == row.experiment.albedo;
    });
    return found == rows.end() ? nullptr : &*found;
}

}  // namespace

std::vector<PlanarExperiment> halfspace_experiments(const PlanarExperiment& base) {
    std::vector<PlanarExperiment> experiments;
    for (const double albedo : {0.2, 0.4, 0.8, 0.95, 0.99}) {
        for (PlanarExperiment& experiment : variants(base)) {
            experiment.albedo = {albedo};
            experiments.push_back(std::move(experiment));
        }
    }
    return experiments;
}

std::vector<HalfspaceRow> run_halfspace_table(const std::vector<PlanarExperiment>& experiments, const PlanarRun& run,
                                              const std::function<void(std::size_t index)>& progress) {
    std::vector<HalfspaceRow> rows;
    for (const PlanarExperiment& experiment : experiments) {
        progress(rows.size());
        rows.push_back({experiment, run_planar(experiment, run), closed_form(experiment), {}});
    }
    for (HalfspaceRow& row : rows) {
        const HalfspaceRow* classical = classical_beside(row, rows);
        const auto ours = merit(row), theirs = classical ? merit(*classical) : std::nullopt;
        if (ours && theirs) {
            row.gain = *ours / *theirs;
        }
    }
    return rows;
}

std::vector<std::vector<std::string>> halfspace_cells(const std::vector<HalfspaceRow>& rows) {
    std::vector<std::vector<std::string>> cells = {{"albedo", "sampler", "mean", "± error", "exact", "off by",
                                                    "variance", "closed form", "× classical", "FOM, 1/s", "collisions",
                                                    "seconds", "set-up"}};
    for (const HalfspaceRow& row : rows) {
        const Moments& m = row.result.channels.front();
        const double exact = row.result.exact.front();
        cells.push_back({fmt::format("{:g}", row.experiment.albedo.front()), sampler_text(row.experiment), mean_text(m),
                         fmt::format("{:.1e}", m.standard_error()), exact_text(exact), deviation_text(m, exact),
                         fmt::format("{:.3e}", m.variance()),
                         row.closed_form ? fmt::format("{:.3e}", *row.closed_form) : "–", merit_text(row.gain),
                         merit_text(merit(row)), fmt::format("{:.2f}", row.result.collisions_per_walk),
                         fmt::format("{:.3g}", row.result.seconds), fmt::format("{:.2g}", row.result.setup_seconds)});
    }
    return cells;
}

nlohmann::json halfspace_json(const std::vector<HalfspaceRow>& rows, const PlanarRun& run) {
    nlohmann::json list = nlohmann::json::array();
    for (const HalfspaceRow& row : rows) {
        nlohmann::json entry = planar_json(row.experiment, run, row.result);
        entry["albedo"] = row.experiment.albedo.front();
        entry["name"] = sampler_text(row.experiment);
        entry["closed_form_variance"] = row.closed_form ? json_number(*row.closed_form) : nlohmann::json(nullptr);
        entry["fom_ratio"] = row.gain ? json_number(*row.gain) : nlohmann::json(nullptr);
        list.push_back(std::move(entry));
    }
    return {{"rows", std::move(list)}};
}

}  // namespace wend
