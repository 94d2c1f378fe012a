#include <wend/app/scenes_page.h>

#include <wend/app/comparison_data.h>
#include <wend/app/gains.h>
#include <wend/app/gains_plot.h>
#include <wend/app/markup.h>
#include <wend/app/number_text.h>
#include <wend/app/page_frame.h>
#include <wend/app/scenes_template.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace wend {
namespace {

/// "2.1×", marked where it is a loss.
std::string gain_text(double gain) {
    if (!std::isfinite(gain)) {
        return "–";
    }
    return gain < 1 ? fmt::format("<span class=\"loss\">{}×</span>", number_text(gain)) : number_text(gain) + "×";
}

std::string gain_rows(const std::vector<GainDistribution>& gains) {
    std::string html;
    for (const GainDistribution& d : gains) {
        const std::string error =
            std::isfinite(d.error_factor) ? fmt::format(" <span class=\"role\">×/÷ {:.2f}</span>", d.error_factor) : "";
        html += fmt::format("<tr><th scope=\"row\">{}</th><td>{}{}</td>", escape_markup(d.sampling),
                            gain_text(d.geometric_mean), error);
        for (const double value : {d.min, d.p10, d.p25, d.median, d.p75, d.p90, d.max}) {
            html += fmt::format("<td>{}</td>", gain_text(value));
        }
        html += fmt::format("<td>{} of {}</td></tr>\n", d.losses, d.scenes.size());
    }
    return html.empty() ? "<tr><td colspan=\"10\">no way of sampling was compared with classical sampling</td></tr>\n"
                        : html;
}

/// A row of a comparison among all of them.
struct Case {
    std::size_t scene;
    const ComparisonRow* row;

    /// What is not known comes last.
    double order() const {
        const double gain = row->ratio.value_or(std::numeric_limits<double>::infinity());
        return gain > 0 ? gain : std::numeric_limits<double>::infinity();
    }
};

std::string case_rows(std::span<const Comparison> comparisons) {
    std::vector<Case> cases;
    for (std::size_t scene = 0; scene < comparisons.size(); ++scene) {
        for (const ComparisonRow& row : comparisons[scene].rows) {
            if (!row.way.is_classical()) {
                cases.push_back({scene, &row});
            }
        }
    }
    std::stable_sort(cases.begin(), cases.end(), [](const Case& a, const Case& b) { return a.order() < b.order(); });
    std::string html;
    for (const Case& one : cases) {
        const ComparisonRow& row = *one.row;
        const Spread runs = ratio_spread(row);
        html += fmt::format(
            "<tr><th scope=\"row\"><a href=\"#scene-{}\">{}</a></th><td class=\"left\">{}</td><td>{}</td><td>{}</td>"
            "<td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
            one.scene, escape_markup(std::filesystem::path(comparisons[one.scene].scene).filename().string()),
            escape_markup(to_string(row.way)), gain_text(row.ratio.value_or(std::numeric_limits<double>::quiet_NaN())),
            runs.count > 1 ? fmt::format("{} – {}", number_text(runs.min), number_text(runs.max)) : "–",
            number_text(row.metrics.relmse), number_text(row.metrics.relmse_trimmed), number_text(row.samples),
            number_text(row.seconds));
    }
    return html;
}

std::string scene_table(const Comparison& comparison) {
    std::string html =
        "<table>\n<thead><tr><th scope=\"col\">sampling</th><th scope=\"col\">relMSE</th><th scope=\"col\">gain</th>"
        "<th scope=\"col\">spp</th></tr></thead>\n<tbody>\n";
    for (const ComparisonRow& row : comparison.rows) {
        html += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                            escape_markup(to_string(row.way)), number_text(row.metrics.relmse),
                            gain_text(row.ratio.value_or(std::numeric_limits<double>::quiet_NaN())),
                            number_text(row.samples));
    }
    return html + "</tbody>\n</table>\n";
}

std::string scene_section(const ScenesPage& page, std::size_t scene) {
    const Comparison& comparison = page.comparisons[scene];
    const std::string name = escape_markup(std::filesystem::path(comparison.scene).filename().string());
    std::vector<ConvergenceSeries> convergence;
    for (const ComparisonRow& row : comparison.rows) {
        convergence.push_back(row.convergence);
    }
    return fmt::format(
        "<section class=\"case\" id=\"scene-{}\" tabindex=\"-1\">\n<h2>{}</h2>\n<figure><a href=\"{}\"><img "
        "alt=\"Reference of {}\" src=\"data:image/png;base64,{}\"></a><figcaption><a href=\"{}\">Pictures, error maps "
        "and more of {}</a></figcaption></figure>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" "
        "aria-label=\"Results of {}\">{}</div>\n<details><summary>Convergence</summary>\n{}</details>\n</section>\n\n",
        scene, name, escape_markup(page.links[scene]), name, encode_base64(page.thumbnails[scene]),
        escape_markup(page.links[scene]), name, name, scene_table(comparison), convergence_svg(convergence));
}

std::string failures(std::span<const FailedScene> failed) {
    if (failed.empty()) {
        return {};
    }
    std::string html = "<section class=\"failed\">\n<h2>Not compared</h2>\n<ul>\n";
    for (const FailedScene& one : failed) {
        html += fmt::format("<li><b>{}</b>: {}</li>\n", escape_markup(one.scene), escape_markup(one.error));
    }
    return html + "</ul>\n</section>\n\n";
}

/// What is still to come, of a report that is not at its end.
std::string note(const ScenesPage& page) {
    const std::size_t done = page.comparisons.size() + page.failed.size();
    return done < page.wanted ? fmt::format("<p class=\"scene\">{} of {} scenes so far</p>\n", done, page.wanted) : "";
}

std::string settings(const ScenesPage& page) {
    if (page.comparisons.empty()) {
        return {};
    }
    const Comparison& first = page.comparisons.front();
    const int threads = first.settings.at("threads");
    const std::string version = first.settings.at("version");
    std::string html;
    for (const auto& [name, value] : {std::pair<std::string, std::string>("scenes", std::to_string(page.wanted)),
                                      {"seconds each", number_text(first.plan.seconds)},
                                      {"seeds", fmt::format("{}, the median counts", first.plan.seeds)},
                                      {"threads", threads == 0 ? "all" : std::to_string(threads)},
                                      {"version", version}}) {
        html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, escape_markup(value));
    }
    return html;
}

}  // namespace

std::string scenes_page(const ScenesPage& page) {
    const std::vector<GainDistribution> gains = gain_distributions(page.comparisons);
    std::string sections;
    for (std::size_t scene = 0; scene < page.comparisons.size(); ++scene) {
        sections += scene_section(page, scene);
    }
    const std::string title = fmt::format("{} scenes compared", page.comparisons.size());
    const std::string body =
        fill_template(scenes_template, {{"title", title},
                                        {"note", note(page)},
                                        {"failed", failures(page.failed)},
                                        {"gains", gain_rows(gains)},
                                        {"plot", gains.empty() ? std::string() : gains_svg(gains, page.comparisons)},
                                        {"cases", case_rows(page.comparisons)},
                                        {"scenes", sections},
                                        {"settings", settings(page)}});
    return framed_page(title, scenes_style, body);
}

}  // namespace wend
