#include <wend/app/halfspace_figures.h>

#include <wend/app/planar_options.h>
#include <wend/app/plot.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace wend {
namespace {

/// Outlines of samplers over a broad band of the exact density.
std::string histograms_svg(std::string description, PlotPanel panel, const std::vector<NamedHistogram>& samplers,
                           std::vector<double> PlanarHistogram::*edges, std::vector<double> PlanarHistogram::*density,
                           std::vector<double> PlanarHistogram::*exact) {
    panel.y.low = 0;
    PlotSeries series;
    series.style = PlotSeries::Style::line;
    if (!samplers.empty()) {
        const PlanarHistogram& first = samplers.front().histogram;
        PlotSeries band = series;
        band.name = "exact";
        band.points = histogram_outline(first.*edges, first.*exact);
        band.pen = 5;
        band.dashed = false;
        band.width = 9;
        band.opacity = 0.4;
        panel.series.push_back(std::move(band));
    }
    for (const auto& [name, histogram] : samplers) {
        series.name = name;
        series.points = histogram_outline(histogram.*edges, histogram.*density);
        panel.series.push_back(series);
        ++series.pen;
    }
    return plot_svg({std::move(description), {std::move(panel)}});
}

/// The smallest decades that hold the variances.
void span_decades(PlotAxis& axis, const std::vector<HalfspaceRow>& rows) {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (const HalfspaceRow& row : rows) {
        const double variance = row.result.channels.front().variance();
        if (variance > 0) {
            low = std::min(low, variance);
            high = std::max(high, variance);
        }
    }
    if (high > 0) {
        axis.low = std::pow(10, std::floor(std::log10(low)));
        axis.high = std::pow(10, std::ceil(std::log10(high)));
    }
}

/// The distinct albedos in the order of the rows.
std::vector<double> albedos(const std::vector<HalfspaceRow>& rows) {
    std::vector<double> result;
    for (const HalfspaceRow& row : rows) {
        const double albedo = row.experiment.albedo.front();
        if (std::find(result.begin(), result.end(), albedo) == result.end()) {
            result.push_back(albedo);
        }
    }
    return result;
}

/// A series of the variances at one albedo. `place` says where on the horizontal axis a row goes, and NaN if nowhere.
template <class F>
PlotSeries variances(const std::vector<HalfspaceRow>& rows, double albedo, const F& place) {
    PlotSeries series;
    for (const HalfspaceRow& row : rows) {
        if (row.experiment.albedo.front() == albedo) {
            series.points.push_back({place(row.experiment), row.result.channels.front().variance()});
        }
    }
    return series;
}

}  // namespace

std::string depth_svg(const std::vector<NamedHistogram>& samplers) {
    PlotPanel panel;
    panel.x.label = "depth of the first collision, mean free paths";
    panel.x.low = 0;
    panel.y.label = "walks per mean free path";
    return histograms_svg("Depth of the first collision by sampler, over the exact density", std::move(panel), samplers,
                          &PlanarHistogram::depth_edges, &PlanarHistogram::depth_density,
                          &PlanarHistogram::depth_exact);
}

std::string direction_svg(const std::vector<NamedHistogram>& samplers) {
    PlotPanel panel;
    panel.x = {"cosine of the next direction: −1 to the surface, 1 away from it"};
    panel.x.low = -1;
    panel.x.high = 1;
    panel.y.label = "walks per unit of cosine";
    return histograms_svg("Direction after the first collision by sampler, over the exact density", std::move(panel),
                          samplers, &PlanarHistogram::cosine_edges, &PlanarHistogram::cosine_density,
                          &PlanarHistogram::cosine_exact);
}

std::string walks_svg(const std::vector<NamedWalks>& samplers) {
    constexpr double width = 420, height = 420;
    double reach = 1, depth = 1;
    for (const NamedWalks& sampler : samplers) {
        for (const PlanarTrace& walk : sampler.walks) {
            for (const PlanarTrace::Vertex& vertex : walk.vertices) {
                reach = std::max(reach, std::abs(vertex.lateral));
                depth = std::max(depth, vertex.depth);
            }
        }
    }
    // One scale along and across: a circle in the medium is a circle in the picture.
    const double span = 1.04 * std::max(2 * reach, depth * width / height);
    Plot plot;
    plot.description = "Walks below the surface of a half-space, by sampler, to one scale";
    plot.nothing = "no walks to draw";
    for (const NamedWalks& sampler : samplers) {
        PlotPanel panel;
        panel.title = sampler.name;
        panel.width = width;
        panel.height = height;
        panel.x = {"along the surface, mean free paths"};
        panel.x.low = -span / 2;
        panel.x.high = span / 2;
        panel.y = {"depth, mean free paths"};
        panel.y.low = -0.04 * span;
        panel.y.high = 0.96 * span * height / width;
        panel.y.downward = true;
        PlotSeries surface{"surface", {{-span / 2, 0}, {span / 2, 0}}, PlotSeries::Style::line, 5};
        surface.width = 3;
        surface.dashed = false;
        panel.series.push_back(std::move(surface));
        for (const PlanarTrace& walk : sampler.walks) {
            PlotSeries line{"", {}, PlotSeries::Style::line, panel.series.size() % 5};
            for (const PlanarTrace::Vertex& vertex : walk.vertices) {
                line.points.push_back({vertex.lateral, vertex.depth});
            }
            line.width = 1.2;
            line.opacity = 0.8;
            line.dashed = false;
            panel.series.push_back(std::move(line));
        }
        plot.panels.push_back(std::move(panel));
    }
    return plot_svg(plot);
}

std::string variance_svg(const std::vector<HalfspaceRow>& rows) {
    static const std::vector<std::pair<std::string, std::string>> others = {
        {"classical", "classical"}, {"dwivedi", "dwivedi"}, {"boundary, moments 0 and 1", "boundary"}};
    PlotPanel left, right;
    left.width = 260;
    left.title = "other samplers";
    left.x = {"sampler"};
    left.x.low = 0.5;
    left.x.high = 3.5;
    right.title = "modes, by their number";
    right.x = {"transients beside the discrete mode", PlotAxis::Scale::logarithmic};
    for (std::size_t i = 0; i < others.size(); ++i) {
        left.x.ticks.push_back({static_cast<double>(i + 1), others[i].second});
    }
    for (const int modes : {2, 4, 8, 16, 32}) {
        right.x.ticks.push_back({static_cast<double>(modes), std::to_string(modes)});
    }
    for (PlotPanel* panel : {&left, &right}) {
        panel->y = {"variance of one walk, sky radiance²", PlotAxis::Scale::logarithmic};
        span_decades(panel->y, rows);
    }
    const auto among_others = [](const PlanarExperiment& experiment) {
        const std::string name = sampler_text(experiment);
        const auto found = std::find_if(others.begin(), others.end(), [&](const auto& o) { return o.first == name; });
        return found == others.end() ? std::nan("") : static_cast<double>(found - others.begin() + 1);
    };
    const auto by_modes = [](const PlanarExperiment& e) { return e.sampler == "modes" ? e.modes : std::nan(""); };
    for (const double albedo : albedos(rows)) {
        const std::size_t pen = right.series.size();
        PlotSeries marks = variances(rows, albedo, among_others);
        marks.style = PlotSeries::Style::levels;
        marks.width = 3;
        marks.pen = pen;
        left.series.push_back(std::move(marks));
        PlotSeries line = variances(rows, albedo, by_modes);
        line.name = fmt::format("albedo {:g}", albedo);
        line.pen = pen;
        right.series.push_back(std::move(line));
    }
    return plot_svg(
        {"Variance of one walk over the number of modes, at each albedo", {std::move(left), std::move(right)}});
}

}  // namespace wend
