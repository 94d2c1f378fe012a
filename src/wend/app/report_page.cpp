#include <wend/app/report_page.h>

#include <wend/app/markup.h>
#include <wend/app/number_text.h>
#include <wend/app/page_frame.h>
#include <wend/app/report_template.h>
#include <wend/film/tone.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace wend {
namespace {

std::string settings_list(const Report& report) {
    std::string html;
    for (const auto& [name, value] : report.settings) {
        html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escape_markup(name), escape_markup(value));
    }
    return html;
}

std::string table_rows(const Report& report) {
    double best = -std::numeric_limits<double>::infinity();
    for (const ReportRow& row : report.rows) {
        best = std::max(best, row.ratio.value_or(best));
    }
    std::string html;
    for (const ReportRow& row : report.rows) {
        const std::string ratio = row.ratio ? number_text(*row.ratio) + "×" : "–";
        const std::string role =
            row.role.empty() ? "" : fmt::format(" <span class=\"role\">{}</span>", escape_markup(row.role));
        html += fmt::format("<tr{}><th scope=\"row\">{}{}</th><td>{}</td><td class=\"ratio\">{}</td>",
                            row.ratio == best ? " class=\"best\"" : "", escape_markup(row.sampling), role,
                            number_text(row.relmse), ratio);
        for (const double value : {row.seconds, row.spp, row.relmse_trimmed, row.error_p9999, row.mse, row.flip}) {
            html += fmt::format("<td>{}</td>", number_text(value));
        }
        html += "</tr>\n";
    }
    return html;
}

/// How the renders of each way differ; nothing where each has but one.
std::string spread_section(const Report& report) {
    std::string rows;
    bool differ = false;
    for (const ReportRow& row : report.rows) {
        const Spread& error = row.relmse_spread;
        differ |= error.count > 1;
        rows += fmt::format("<tr><th scope=\"row\">{}</th>", escape_markup(row.sampling));
        for (const double value : {error.median, error.min, error.max, error.mean, error.std_error,
                                   row.ratio_spread.min, row.ratio_spread.max}) {
            rows += fmt::format("<td>{}</td>", number_text(value));
        }
        rows += "</tr>\n";
    }
    return differ ? fill_template(report_spread, {{"rows", rows}}) : "";
}

std::string convergence(const Report& report) {
    return fmt::format(
        "{}<details><summary>Over samples</summary>\n{}</details>\n<details><summary>Over work: segments of all "
        "walks</summary>\n{}</details>\n",
        convergence_svg(report.convergence), convergence_svg(report.convergence, ConvergenceOver::samples),
        convergence_svg(report.convergence, ConvergenceOver::work));
}

std::string options(const Report& report, std::size_t selected) {
    std::string html;
    for (std::size_t i = 0; i < report.pictures.size(); ++i) {
        html += fmt::format("<option value=\"{}\"{}>{}</option>\n", i, i == selected ? " selected" : "",
                            escape_markup(report.pictures[i].name));
    }
    return html;
}

std::string colour_bar(const ReportMap& map) {
    const bool logarithmic = map.scale.kind == ColourScale::Kind::logarithmic;
    return fmt::format(
        "<div class=\"scale\"><span>{}, {} scale</span><span class=\"bar\"><span>{}</span><i></i>"
        "<span>{}</span></span></div>\n",
        escape_markup(map.quantity), logarithmic ? "logarithmic" : "linear", number_text(map.scale.low),
        number_text(map.scale.high));
}

/// A picture or map, with the number of its picture for the script.
std::string figure(std::size_t picture, const std::string& description, const std::string& png,
                   const std::string& caption) {
    return fmt::format(
        "<figure data-picture=\"{}\"><img alt=\"{}\" src=\"data:image/png;base64,{}\">"
        "<figcaption>{}</figcaption></figure>\n",
        picture, escape_markup(description), encode_base64(png), caption);
}

std::string picture_strip(const Report& report) {
    std::string html;
    for (std::size_t i = 0; i < report.pictures.size(); ++i) {
        const ReportPicture& picture = report.pictures[i];
        html += figure(i, picture.name, picture.png,
                       fmt::format("<b>{}</b> {}", escape_markup(picture.name), escape_markup(picture.detail)));
    }
    return html;
}

std::string map_strip(const Report& report, std::size_t map) {
    std::string html;
    for (std::size_t i = 0; i < report.pictures.size(); ++i) {
        const ReportPicture& picture = report.pictures[i];
        if (!picture.maps.empty()) {
            html += figure(i, fmt::format("{}: {}", report.maps[map].name, picture.name), picture.maps[map],
                           escape_markup(picture.name));
        }
    }
    return html;
}

/// A section for each map. View 0 is the pictures.
std::string map_sections(const Report& report) {
    std::string html;
    for (std::size_t i = 0; i < report.maps.size(); ++i) {
        html +=
            fmt::format("<section id=\"view-{}\">\n<h2>{}</h2>\n{}<div class=\"strip\">\n{}</div>\n</section>\n\n",
                        i + 1, escape_markup(report.maps[i].name), colour_bar(report.maps[i]), map_strip(report, i));
    }
    return html;
}

std::string view_choices(const Report& report) {
    std::string html;
    for (std::size_t i = 0; i < report.maps.size(); ++i) {
        html += fmt::format("<label><input type=\"radio\" name=\"view\" value=\"{}\"><span>{}</span></label>\n", i + 1,
                            escape_markup(report.maps[i].name));
    }
    return html;
}

}  // namespace

std::string report_page(const Report& report) {
    const std::string body = fill_template(report_template, {{"script", std::string(report_script)},
                                                             {"title", escape_markup(report.title)},
                                                             {"scene", escape_markup(report.scene)},
                                                             {"settings", settings_list(report)},
                                                             {"rows", table_rows(report)},
                                                             {"left_options", options(report, report.left)},
                                                             {"right_options", options(report, report.right)},
                                                             {"views", view_choices(report)},
                                                             {"pictures", picture_strip(report)},
                                                             {"maps", map_sections(report)},
                                                             {"spread", spread_section(report)},
                                                             {"convergence", convergence(report)}});
    return framed_page(report.title, bar_style(), body);
}

}  // namespace wend
