// Where values of an axis lie on the paper, and which of them are named there.
#pragma once

#include <wend/app/plot.h>

#include <limits>
#include <string>
#include <vector>

namespace wend {

/// An axis laid out from pixel `first` (its low end) to pixel `last`.
class PlotScale {
public:
    struct Tick {
        double pixel;
        std::string label;  ///< as SVG
    };

    PlotScale(const PlotAxis& axis, double first, double last);

    bool can_show(double value) const;
    /// Makes room for a value that can be shown.
    void include(double value);
    /// True until something was included.
    bool empty() const { return low_ > high_; }
    /// Call once all is included: leaves room around the data.
    void finish();

    double pixel(double value) const;
    std::vector<Tick> ticks() const;

private:
    double position(double value) const;
    double at(double position) const { return first_ + (last_ - first_) * (position - low_) / (high_ - low_); }
    std::vector<Tick> linear_ticks() const;
    std::vector<Tick> logarithmic_ticks() const;

    const PlotAxis* axis_;
    double first_, last_;
    double low_ = std::numeric_limits<double>::infinity();
    double high_ = -std::numeric_limits<double>::infinity();
};

}  // namespace wend
