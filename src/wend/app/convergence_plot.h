#pragma once

#include <string>
#include <vector>

namespace wend {

/// How the error of one way of sampling fell with time.
struct ConvergenceSeries {
    struct Point {
        double seconds = 0;
        double relmse = 0;
    };

    std::string name;
    std::vector<Point> points;
};

/// A plot of relMSE over seconds, both axes logarithmic, as one <svg> element with labelled axes and a legend; it takes
/// text colour from its surroundings and is legible on light and dark ground. Points that a logarithmic axis cannot
/// show (not positive, not finite) are left out; with none left the plot says so.
std::string convergence_svg(const std::vector<ConvergenceSeries>& series);

}  // namespace wend
