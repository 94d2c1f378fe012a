#include <wend/app/markup.h>
#include <wend/app/report_page.h>
#include <wend/app/report_template.h>
#include <wend/film/tone.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wend {
namespace {

/// Three significant digits, without an exponent where that is short.
std::string number(double value) {
    if (!std::isfinite(value)) {
        return "–";
    }
    const double size = std::abs(value);
    if (size >= 1000 && size < 1e7) {
        return fmt::format("{:.0f}", value);
    }
    return size == 0 || (size >= 1e-3 && size < 1000) ? fmt::format("{:.3g}", value) : fmt::format("{:.2e}", value);
}

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
        const std::string ratio = row.ratio ? number(*row.ratio) + "×" : "–";
        html += fmt::format("<tr{}><th scope=\"row\">{}</th><td>{}</td><td class=\"ratio\">{}</td>",
                            row.ratio == best ? " class=\"best\"" : "", escape_markup(row.sampling), number(row.relmse),
                            ratio);
        for (const double value : {row.seconds, row.spp, row.relmse_trimmed, row.mse, row.flip}) {
            html += fmt::format("<td>{}</td>", number(value));
        }
        html += "</tr>\n";
    }
    return html;
}

std::string options(const Report& report, std::size_t selected) {
    std::string html;
    for (std::size_t i = 0; i < report.pictures.size(); ++i) {
        html += fmt::format("<option value=\"{}\"{}>{}</option>\n", i, i == selected ? " selected" : "",
                            escape_markup(report.pictures[i].name));
    }
    return html;
}

std::string image_element(const char* kind, const std::string& description, const std::string& png) {
    return fmt::format("<img class=\"{}\" alt=\"{}\" src=\"data:image/png;base64,{}\">", kind,
                       escape_markup(description), encode_base64(png));
}

std::string gallery(const Report& report) {
    std::string html;
    for (const ReportPicture& picture : report.pictures) {
        html += "<figure>" + image_element("picture", picture.name, picture.png);
        if (!picture.error_png.empty()) {
            html += image_element("error", "error map of " + picture.name, picture.error_png);
        }
        html += fmt::format("<figcaption>{}</figcaption></figure>\n", escape_markup(picture.name));
    }
    return html;
}

/// The colours of the error maps as a CSS gradient.
std::string gradient() {
    constexpr int steps = 16;
    std::string css = "linear-gradient(to right";
    for (int i = 0; i <= steps; ++i) {
        const Rgb colour = false_colour(static_cast<float>(i) / steps);
        css += fmt::format(",#{:02x}{:02x}{:02x}", encode_srgb(colour.r), encode_srgb(colour.g), encode_srgb(colour.b));
    }
    return css + ")";
}

}  // namespace

std::string report_page(const Report& report) {
    const bool logarithmic = report.error_scale.kind == ColourScale::Kind::logarithmic;
    return fill_template(report_template, {{"style", std::string(report_style)},
                                           {"script", std::string(report_script)},
                                           {"title", escape_markup(report.title)},
                                           {"scene", escape_markup(report.scene)},
                                           {"settings", settings_list(report)},
                                           {"rows", table_rows(report)},
                                           {"left_options", options(report, 0)},
                                           {"right_options", options(report, 1)},
                                           {"error_quantity", escape_markup(report.error_quantity)},
                                           {"error_scale", logarithmic ? "logarithmic" : "linear"},
                                           {"error_low", number(report.error_scale.low)},
                                           {"error_high", number(report.error_scale.high)},
                                           {"gradient", gradient()},
                                           {"convergence", convergence_svg(report.convergence)},
                                           {"gallery", gallery(report)}});
}

}  // namespace wend
