#include <wend/app/gains_plot.h>

#include <wend/app/markup.h>
#include <wend/app/plot_scale.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace wend {
namespace {

constexpr double plot_width = 560, plot_left = 12, plot_right = 548, strip_height = 74, plot_top = 8, axis_height = 48;

constexpr const char* opening_of_gains =
    R"(<svg class="plot" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" color="#767676" role="group" aria-label="Gains over classical sampling, a dot for each scene">
<style>.plot text{{font:13px system-ui,sans-serif;fill:currentColor;text-anchor:middle}}.plot .start{{text-anchor:start}}.plot .grid{{stroke:currentColor;stroke-opacity:.13}}.plot .one{{stroke:currentColor;stroke-opacity:.7;stroke-dasharray:4 3}}.plot .half{{fill:#0077bb;fill-opacity:.16;stroke:#0077bb;stroke-opacity:.6}}.plot .runs{{stroke:#0077bb;stroke-opacity:.35;stroke-width:2}}.plot .dot{{fill:#0077bb}}.plot .loss{{fill:#d65f10}}.plot .mean{{fill:none;stroke:currentColor;stroke-width:2}}.plot a:focus-visible circle{{stroke:currentColor;stroke-width:3}}</style>
)";

/// Dots on three levels, so that neighbours do not cover each other.
double level_of(std::size_t place) {
    return static_cast<double>(place % 3) * 9 - 9;
}

std::string dot(const SceneGain& one, const std::string& name, const PlotScale& x, double y) {
    std::string text = fmt::format("{}: {:.3g}×", name, one.gain);
    std::string runs;
    if (one.runs.count > 1 && x.can_show(one.runs.min) && x.can_show(one.runs.max)) {
        runs = fmt::format("<path class=\"runs\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>", x.pixel(one.runs.min), y,
                           x.pixel(one.runs.max));
        text += fmt::format(", {:.3g} to {:.3g} by seed", one.runs.min, one.runs.max);
    }
    return fmt::format(
        "{}<a href=\"#scene-{}\" aria-label=\"{}\"><circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" "
        "r=\"4.5\"/><title>{}</title></a>\n",
        runs, one.scene, escape_markup(text), one.gain < 1 ? "loss" : "dot", x.pixel(one.gain), y, escape_markup(text));
}

std::string strip(const GainDistribution& d, std::span<const Comparison> comparisons, const PlotScale& x, double y) {
    std::string svg = fmt::format("<text class=\"start\" x=\"{}\" y=\"{:.1f}\">{}</text>\n", plot_left, y + 14,
                                  escape_markup(d.sampling));
    if (d.scenes.empty()) {
        return svg;
    }
    const double middle = y + 44, low = x.pixel(d.p25), high = x.pixel(d.p75), mean = x.pixel(d.geometric_mean);
    svg +=
        fmt::format("<path class=\"half\" d=\"M{0:.1f} {2:.1f}H{1:.1f}V{3:.1f}H{0:.1f}ZM{4:.1f} {2:.1f}V{3:.1f}\"/>\n",
                    low, high, middle - 18, middle + 18, x.pixel(d.median));
    std::size_t place = 0;
    for (const SceneGain& one : d.scenes) {
        svg += dot(one, comparisons[one.scene].scene, x, middle + level_of(place++));
    }
    return svg + fmt::format(
                     "<path class=\"mean\" d=\"M{:.1f} {:.1f}l7 11l-7 11l-7 -11z\"><title>geometric mean "
                     "{:.3g}×</title></path>\n",
                     mean, middle - 11, d.geometric_mean);
}

/// All that the axis must show: gains, the ranges of their runs, and classical sampling.
std::vector<double> values_of(const std::vector<GainDistribution>& gains) {
    std::vector<double> values = {1};
    for (const GainDistribution& d : gains) {
        for (const SceneGain& one : d.scenes) {
            for (const double value : {one.gain, one.runs.min, one.runs.max}) {
                if (value > 0 && std::isfinite(value)) {
                    values.push_back(value);
                }
            }
        }
    }
    return values;
}

/// With ones, twos and fives over up to four decades; beyond, the scale's own ticks.
PlotAxis axis_of(const std::vector<GainDistribution>& gains) {
    PlotAxis axis;
    axis.scale = PlotAxis::Scale::logarithmic;
    const std::vector<double> values = values_of(gains);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    if (*high / *low < 1e4) {
        for (double decade = std::pow(10.0, std::floor(std::log10(*low))); decade <= *high; decade *= 10) {
            for (const double value : {decade, 2 * decade, 5 * decade}) {
                if (value >= *low && value <= *high) {
                    axis.ticks.push_back({value, fmt::format("{:.3g}", value)});
                }
            }
        }
    }
    return axis;
}

}  // namespace

std::string gains_svg(const std::vector<GainDistribution>& gains, std::span<const Comparison> comparisons) {
    const double bottom = plot_top + strip_height * static_cast<double>(gains.size());
    const PlotAxis axis = axis_of(gains);
    PlotScale x(axis, plot_left + 8, plot_right - 8);
    for (const double value : values_of(gains)) {
        x.include(value);
    }
    x.finish();
    std::string svg = fmt::format(opening_of_gains, plot_width, bottom + axis_height);
    auto out = std::back_inserter(svg);
    for (const auto& [at, label] : x.ticks()) {
        fmt::format_to(out, "<path class=\"grid\" d=\"M{0:.1f} {1}V{2}\"/><text x=\"{0:.1f}\" y=\"{3}\">{4}</text>\n",
                       at, plot_top, bottom, bottom + 18, label);
    }
    fmt::format_to(out, "<path class=\"one\" d=\"M{:.1f} {}V{}\"/>\n", x.pixel(1), plot_top, bottom);
    fmt::format_to(out, "<text x=\"{}\" y=\"{}\">gain over classical sampling, in error times time</text>\n",
                   (plot_left + plot_right) / 2, bottom + 38);
    double y = plot_top;
    for (const GainDistribution& d : gains) {
        svg += strip(d, comparisons, x, y);
        y += strip_height;
    }
    return svg + "</svg>\n";
}

}  // namespace wend
