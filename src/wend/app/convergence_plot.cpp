#include <wend/app/convergence_plot.h>

#include <wend/app/plot.h>

#include <utility>

namespace wend {
namespace {

using Points = std::vector<ConvergenceSeries::Point>;

const char* label_of(ConvergenceOver over) {
    switch (over) {
        case ConvergenceOver::samples:
            return "samples per pixel";
        case ConvergenceOver::work:
            return "segments of walks";
        default:
            return "seconds";
    }
}

std::vector<PlotPoint> plot_points(const Points& points, ConvergenceOver over) {
    std::vector<PlotPoint> result;
    for (const ConvergenceSeries::Point& p : points) {
        const double x = over == ConvergenceOver::samples ? p.samples
                         : over == ConvergenceOver::work  ? p.work
                                                          : p.seconds;
        result.push_back({x, p.relmse});
    }
    return result;
}

}  // namespace

std::string convergence_svg(const std::vector<ConvergenceSeries>& series, ConvergenceOver over) {
    PlotPanel panel;
    panel.x = {label_of(over), PlotAxis::Scale::logarithmic};
    panel.y = {"relMSE", PlotAxis::Scale::logarithmic};
    for (std::size_t pen = 0; pen < series.size(); ++pen) {
        for (const Points& other : series[pen].others) {
            PlotSeries line;
            line.points = plot_points(other, over);
            line.style = PlotSeries::Style::line;
            line.pen = pen;
            line.width = 1;
            line.opacity = 0.5;
            panel.series.push_back(std::move(line));
        }
    }
    for (std::size_t pen = 0; pen < series.size(); ++pen) {
        PlotSeries line;
        line.name = series[pen].name;
        line.pen = pen;
        line.points = plot_points(series[pen].points, over);
        panel.series.push_back(std::move(line));
    }
    return plot_svg({std::string("relMSE over ") + label_of(over) + ", logarithmic axes",
                     {std::move(panel)},
                     "no positive errors to plot"});
}

}  // namespace wend
