#pragma once

#include <string>
#include <vector>

namespace wend {

/// How the error of one way of sampling fell.
struct ConvergenceSeries {
    /// A picture on the way.
    struct Point {
        double seconds = 0;
        double relmse = 0;
        double samples = 0;  ///< per pixel
        double work = 0;     ///< segments of all walks so far
        double relmse_trimmed = 0;
    };

    std::string name;
    std::vector<Point> points;
    /// Of other renders in the same way, which are drawn thinner and not named.
    std::vector<std::vector<Point>> others = {};
};

/// What the error is plotted over.
enum class ConvergenceOver { seconds, samples, work };

/// A plot of relMSE over seconds, samples or work, both axes logarithmic, as one <svg> element with labelled axes and a
/// legend; it takes text colour from its surroundings and is legible on light and dark ground. Points that a
/// logarithmic axis cannot show (not positive, not finite) are left out; with none left the plot says so.
std::string convergence_svg(const std::vector<ConvergenceSeries>& series,
                            ConvergenceOver over = ConvergenceOver::seconds);

}  // namespace wend
