#include <wend/app/planar_report.h>

#include <wend/app/planar_options.h>
#include <wend/app/text_table.h>
#include <wend/stats/figure_of_merit.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace wend {
namespace {

/// One number, or an array for several channels.
nlohmann::json per_channel(const std::vector<double>& values) {
    if (values.size() == 1) {
        return json_number(values.front());
    }
    nlohmann::json list = nlohmann::json::array();
    for (const double value : values) {
        list.push_back(json_number(value));
    }
    return list;
}

template <class F>
std::vector<double> of_channels(const PlanarResult& result, const F& quantity) {
    std::vector<double> values;
    for (const Moments& channel : result.channels) {
        values.push_back(quantity(channel));
    }
    return values;
}

std::string title(const PlanarExperiment& e) {
    std::string text = std::isfinite(e.thickness)
                           ? fmt::format("slab of {:g} mean free paths, {}", e.thickness,
                                         e.tally == Tally::reflectance ? "reflectance" : "transmittance")
                           : "half-space, reflectance";
    text += fmt::format(": albedo {:g}, g {:g}", fmt::join(e.albedo, ", "), e.g);
    if (e.ior > 1) {
        text += fmt::format(", refractive index {:g}", e.ior);
        text += e.roughness > 0 ? fmt::format(", roughness {:g}", e.roughness) : "";
    }
    return text + (e.mu0 ? fmt::format(", entry at cosine {:g}", *e.mu0) : ", diffuse entry");
}

}  // namespace

std::string mean_text(const Moments& moments) {
    const double error = moments.relative_error();
    const double digits = error > 0 && std::isfinite(error) ? std::ceil(-std::log10(error)) + 2 : 10;
    return fmt::format("{:.{}g}", moments.mean(), static_cast<int>(std::clamp(digits, 3.0, 12.0)));
}

std::string exact_text(double exact) {
    return std::isfinite(exact) ? fmt::format("{:.10g}", exact) : "–";
}

std::string deviation_text(const Moments& moments, double exact) {
    const double deviations = (moments.mean() - exact) / moments.standard_error();
    return std::isfinite(deviations) ? fmt::format("{:+.2f}", deviations) : "–";
}

std::string merit_text(const std::optional<double>& merit) {
    return merit ? fmt::format("{:.3g}", *merit) : "–";
}

nlohmann::json planar_json(const PlanarExperiment& experiment, const PlanarRun& run, const PlanarResult& result) {
    const auto merit = [&](const Moments& m) { return figure_of_merit(m, result.seconds).value_or(std::nan("")); };
    return {{"sampler", experiment.sampler},
            {"mean", per_channel(of_channels(result, [](const Moments& m) { return m.mean(); }))},
            {"std_error", per_channel(of_channels(result, [](const Moments& m) { return m.standard_error(); }))},
            {"variance", per_channel(of_channels(result, [](const Moments& m) { return m.variance(); }))},
            {"collisions_per_walk", json_number(result.collisions_per_walk)},
            {"seconds", json_number(result.seconds)},
            {"fom", per_channel(of_channels(result, merit))},
            {"exact", per_channel(result.exact)},
            {"setup_seconds", json_number(result.setup_seconds)},
            {"rejected_samples", result.rejected},
            {"walks", run.walks},
            {"settings", planar_settings(experiment, run)}};
}

std::string planar_text(const PlanarExperiment& experiment, const PlanarRun& run, const PlanarResult& result) {
    std::vector<std::vector<std::string>> rows = {{"mean, of a sky of radiance 1"},
                                                  {"± standard error"},
                                                  {"exact"},
                                                  {"deviation, standard errors"},
                                                  {"variance of one walk"},
                                                  {"figure of merit, 1/s"},
                                                  {"collisions a walk"},
                                                  {"seconds, of all threads"},
                                                  {"seconds of set-up, apart"}};
    for (std::size_t i = 0; i < result.channels.size(); ++i) {
        const Moments& m = result.channels[i];
        const double exact = result.exact[i];
        const std::string column[] = {mean_text(m),
                                      fmt::format("{:.2g}", m.standard_error()),
                                      exact_text(exact),
                                      deviation_text(m, exact),
                                      fmt::format("{:.4g}", m.variance()),
                                      merit_text(figure_of_merit(m, result.seconds))};
        for (std::size_t row = 0; row < std::size(column); ++row) {
            rows[row].push_back(column[row]);
        }
    }
    rows[6].push_back(fmt::format("{:.3f}", result.collisions_per_walk));
    rows[7].push_back(fmt::format("{:.3g}", result.seconds));
    rows[8].push_back(fmt::format("{:.3g}", result.setup_seconds));
    return fmt::format("{}\n{}, {} walks\n\n{}", title(experiment), sampler_text(experiment), run.walks,
                       text_table(rows));
}

void report_planar(const PlanarExperiment& experiment, const PlanarRun& run, const CommonOptions& common,
                   const Streams& streams) {
    const PlanarResult result = run_planar(experiment, run);
    warn_of_rejected(result.rejected, streams);
    if (common.json != "-") {
        streams.out << planar_text(experiment, run, result) << std::flush;
    }
    common.write_json(streams, planar_json(experiment, run, result));
}

void warn_of_rejected(std::uint64_t rejected, const Streams& streams) {
    if (rejected > 0) {
        streams.err << "warning: " << rejected << " walks did not end in a finite number and count as 0\n";
    }
}

}  // namespace wend
