#include <wend/app/convergence_plot.h>
#include <wend/app/plot.h>

#include <utility>

namespace wend {

std::string convergence_svg(const std::vector<ConvergenceSeries>& series) {
    PlotPanel panel;
    panel.x = {"seconds", PlotAxis::Scale::logarithmic};
    panel.y = {"relMSE", PlotAxis::Scale::logarithmic};
    for (const ConvergenceSeries& one : series) {
        PlotSeries line;
        line.name = one.name;
        line.pen = panel.series.size();
        for (const ConvergenceSeries::Point& point : one.points) {
            line.points.push_back({point.seconds, point.relmse});
        }
        panel.series.push_back(std::move(line));
    }
    return plot_svg({"relMSE over seconds, logarithmic axes", {std::move(panel)}, "no positive errors to plot"});
}

}  // namespace wend
