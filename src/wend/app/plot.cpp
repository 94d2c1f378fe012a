#include <wend/app/plot.h>

#include <wend/app/markup.h>
#include <wend/app/plot_scale.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace wend {
namespace {

// Around the axes of a panel, in pixels; the legend follows below.
constexpr double left_margin = 62, right_margin = 14, top_margin = 14, title_height = 22, bottom_margin = 62;
constexpr double legend_row = 22, legend_column = 242;

/// Colours with a contrast of 3 and more on white and on near black, told apart by dashes and markers too.
struct Pen {
    const char* colour;
    const char* dashes;
};
constexpr std::array<Pen, 6> pens = {{
    {"#0077bb", ""},
    {"#d65f10", "7 3"},
    {"#009480", "2 3"},
    {"#cc3377", "9 3 2 3"},
    {"#8060cc", "5 5"},
    {"#8a7d00", "12 4"},
}};

// Colour as an attribute: a page's own rules come before it, and a file that is looked at alone still has one.
constexpr const char* opening =
    R"(<svg class="plot" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" color="#767676" role="img" aria-label="{2}">
<style>.plot text{{font:13px system-ui,sans-serif;fill:currentColor;text-anchor:middle}}.plot .end{{text-anchor:end}}.plot .start{{text-anchor:start}}.plot .grid{{stroke:currentColor;stroke-opacity:.13}}.plot .axis{{stroke:currentColor;stroke-opacity:.6;fill:none}}.plot .line{{fill:none;stroke-linejoin:round}}</style>
)";

/// A marker that differs from pen to pen.
std::string marker(std::size_t pen, double x, double y) {
    switch (pen % 3) {
        case 0:
            return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.4\"/>", x, y);
        case 1:
            return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"6.4\" height=\"6.4\"/>", x - 3.2, y - 3.2);
        default:
            return fmt::format("<path d=\"M{:.1f} {:.1f}l4.2 7.2h-8.4z\"/>", x, y - 4.6);
    }
}

/// What a series draws through points that follow each other without a gap, in pixels.
std::string stroke(const PlotSeries& series, const std::vector<PlotPoint>& pixels) {
    const Pen& pen = pens[series.pen % pens.size()];
    if (series.style == PlotSeries::Style::levels) {
        std::string bars;
        for (const PlotPoint& p : pixels) {
            bars += fmt::format("M{:.1f} {:.1f}h24", p.x - 12, p.y);
        }
        return fmt::format("<path class=\"line\" stroke=\"{}\" stroke-width=\"{:g}\" d=\"{}\"/>\n", pen.colour,
                           series.width, bars);
    }
    std::string points, markers;
    for (const PlotPoint& p : pixels) {
        points += fmt::format("{:.1f},{:.1f} ", p.x, p.y);
        markers += series.style == PlotSeries::Style::markers ? marker(series.pen, p.x, p.y) : "";
    }
    return fmt::format(
        "<polyline class=\"line\" stroke=\"{0}\" stroke-width=\"{1:g}\" stroke-opacity=\"{2:g}\" "
        "stroke-dasharray=\"{3}\" points=\"{4}\"/><g fill=\"{0}\">{5}</g>\n",
        pen.colour, series.width, series.opacity, series.dashed ? pen.dashes : "", points, markers);
}

/// The points in pixels, in pieces between those that cannot be shown.
std::vector<std::vector<PlotPoint>> pieces(const PlotSeries& series, const PlotScale& x, const PlotScale& y) {
    std::vector<std::vector<PlotPoint>> result(1);
    for (const PlotPoint& p : series.points) {
        if (x.can_show(p.x) && y.can_show(p.y)) {
            result.back().push_back({x.pixel(p.x), y.pixel(p.y)});
        } else if (!result.back().empty()) {
            result.emplace_back();
        }
    }
    if (result.back().empty()) {
        result.pop_back();
    }
    return result;
}

/// The rectangle between the axes.
struct PlotFrame {
    double left, right, top, bottom;
};

std::string axes(const PlotPanel& panel, const PlotFrame& f, const PlotScale& x, const PlotScale& y) {
    std::string svg;
    auto out = std::back_inserter(svg);
    for (const auto& [at, label] : x.ticks()) {
        fmt::format_to(out, "<path class=\"grid\" d=\"M{0:.1f} {1}V{2}\"/><text x=\"{0:.1f}\" y=\"{3}\">{4}</text>\n",
                       at, f.top, f.bottom, f.bottom + 18, label);
    }
    for (const auto& [at, label] : y.ticks()) {
        fmt::format_to(
            out,
            "<path class=\"grid\" d=\"M{1} {0:.1f}H{2}\"/><text class=\"end\" x=\"{3}\" y=\"{4:.1f}\">{5}</text>\n", at,
            f.left, f.right, f.left - 8, at + 4, label);
    }
    const double middle = (f.left + f.right) / 2;
    fmt::format_to(out, "<path class=\"axis\" d=\"M{} {}V{}H{}\"/>\n", f.left, f.top, f.bottom, f.right);
    fmt::format_to(out, "<text x=\"{}\" y=\"{}\">{}</text>\n", middle, f.bottom + 38, escape_markup(panel.x.label));
    fmt::format_to(out, "<text transform=\"translate({} {}) rotate(-90)\">{}</text>\n", f.left - 48,
                   (f.top + f.bottom) / 2, escape_markup(panel.y.label));
    return svg;
}

std::string panel_svg(const PlotPanel& panel, const PlotFrame& f, const std::string& nothing) {
    const double middle = (f.left + f.right) / 2;
    std::string svg;
    if (!panel.title.empty()) {
        svg = fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", middle, f.top - 10, escape_markup(panel.title));
    }
    PlotScale x(panel.x, f.left, f.right);
    PlotScale y(panel.y, panel.y.downward ? f.top : f.bottom, panel.y.downward ? f.bottom : f.top);
    for (const PlotSeries& series : panel.series) {
        for (const PlotPoint& p : series.points) {
            if (x.can_show(p.x) && y.can_show(p.y)) {
                x.include(p.x);
                y.include(p.y);
            }
        }
    }
    if (x.empty()) {
        return svg + fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", middle, (f.top + f.bottom) / 2,
                                 escape_markup(nothing));
    }
    x.finish();
    y.finish();
    svg += axes(panel, f, x, y);
    for (const PlotSeries& series : panel.series) {
        for (const std::vector<PlotPoint>& piece : pieces(series, x, y)) {
            svg += stroke(series, piece);
        }
    }
    return svg;
}

/// Every name once, with the first series that has it.
std::vector<const PlotSeries*> legend(const Plot& plot) {
    std::vector<const PlotSeries*> entries;
    for (const PlotPanel& panel : plot.panels) {
        for (const PlotSeries& series : panel.series) {
            const auto same = [&](const PlotSeries* entry) { return entry->name == series.name; };
            if (!series.name.empty() && std::none_of(entries.begin(), entries.end(), same)) {
                entries.push_back(&series);
            }
        }
    }
    return entries;
}

}  // namespace

std::string plot_svg(const Plot& plot) {
    double width = 0, height = 0;
    bool titled = false;
    for (const PlotPanel& panel : plot.panels) {
        width += left_margin + panel.width + right_margin;
        height = std::max(height, panel.height);
        titled |= !panel.title.empty();
    }
    const double top = top_margin + (titled ? title_height : 0);
    const double legend_top = top + height + bottom_margin;
    const std::vector<const PlotSeries*> entries = legend(plot);
    const auto columns = std::max<std::size_t>(1, static_cast<std::size_t>((width - left_margin) / legend_column));
    const auto rows = static_cast<double>((entries.size() + columns - 1) / columns);

    std::string svg = fmt::format(opening, width, legend_top + legend_row * rows, escape_markup(plot.description));
    double left = left_margin;
    for (const PlotPanel& panel : plot.panels) {
        svg += panel_svg(panel, {left, left + panel.width, top, top + panel.height}, plot.nothing);
        left += panel.width + right_margin + left_margin;
    }
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const double x = left_margin + legend_column * static_cast<double>(i % columns);
        const double y = legend_top + legend_row * static_cast<double>(i / columns);
        const bool level = entries[i]->style == PlotSeries::Style::levels;
        svg += stroke(*entries[i],
                      level ? std::vector<PlotPoint>{{x + 14, y}} : std::vector<PlotPoint>{{x, y}, {x + 28, y}}) +
               fmt::format("<text class=\"start\" x=\"{}\" y=\"{}\">{}</text>\n", x + 38, y + 4,
                           escape_markup(entries[i]->name));
    }
    return svg + "</svg>\n";
}

std::vector<PlotPoint> histogram_outline(const std::vector<double>& edges, const std::vector<double>& heights) {
    std::vector<PlotPoint> corners;
    for (std::size_t i = 0; i < heights.size() && i + 1 < edges.size(); ++i) {
        corners.push_back({edges[i], heights[i]});
        corners.push_back({edges[i + 1], heights[i]});
    }
    return corners;
}

}  // namespace wend
