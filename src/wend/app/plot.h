// Plots as SVG, in the look of the reports: lines, marks and histograms over linear or logarithmic axes.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace wend {

struct PlotPoint {
    double x = 0, y = 0;
};

struct PlotTick {
    double value = 0;
    std::string label;
};

/// An axis spans the data, the ends given and the ticks given, with a margin where the data decide.
struct PlotAxis {
    enum class Scale { linear, logarithmic };

    std::string label;  ///< what is shown, with its unit
    Scale scale = Scale::linear;
    std::optional<double> low = {}, high = {};
    std::vector<PlotTick> ticks = {};  ///< empty: round numbers
    bool downward = false;             ///< of a vertical axis: values grow from top to bottom
};

struct PlotSeries {
    enum class Style {
        markers,  ///< a line through all points, with a marker at each
        line,     ///< the line alone
        levels    ///< a short horizontal bar at each point
    };

    std::string name;  ///< in the legend; empty: not there
    std::vector<PlotPoint> points;
    Style style = Style::markers;
    std::size_t pen = 0;  ///< which colour, dashes and marker, repeating after six
    double width = 2;     ///< of the line, in pixels of 560 across a plot of one panel
    double opacity = 1;
    bool dashed = true;  ///< false: solid, whatever the pen
};

/// One pair of axes with what is drawn between them.
struct PlotPanel {
    std::string title = {};
    PlotAxis x, y;
    std::vector<PlotSeries> series = {};
    double width = 484, height = 286;  ///< between the axes, in pixels
};

/// Panels side by side over one legend, which has every name once.
struct Plot {
    std::string description;  ///< for those who cannot see it
    std::vector<PlotPanel> panels;
    std::string nothing = "nothing to plot";  ///< what a panel says that has no point to show
};

/// The plot as one <svg> element with labelled axes and a legend. Text takes the colour of its surroundings and is
/// legible on light and dark ground, in a page and as a file. Points that an axis cannot show (not finite; not positive
/// on a logarithmic one) are left out and lines are broken there.
std::string plot_svg(const Plot& plot);

/// The outline of a histogram: bin i of height heights[i] spans edges[i] to edges[i + 1].
std::vector<PlotPoint> histogram_outline(const std::vector<double>& edges, const std::vector<double>& heights);

}  // namespace wend
