#include <wend/app/plot_scale.h>

#include <wend/app/markup.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

// Beyond this the span between two values might not be a finite number.
constexpr double largest = 1e300;

/// A mantissa times a power of ten, as SVG text.
std::string power_label(int mantissa, int exponent) {
    if (exponent >= -3 && exponent <= 4) {
        return fmt::format("{:g}", mantissa * std::pow(10.0, exponent));
    }
    return fmt::format("{}10<tspan dy=\"-5\" font-size=\"9\">{}</tspan>",
                       mantissa == 1 ? "" : fmt::format("{}·", mantissa), exponent);
}

}  // namespace

PlotScale::PlotScale(const PlotAxis& axis, double first, double last) : axis_(&axis), first_(first), last_(last) {
}

bool PlotScale::can_show(double value) const {
    return axis_->scale == PlotAxis::Scale::logarithmic ? value > 0 && std::isfinite(value)
                                                        : std::abs(value) <= largest;
}

double PlotScale::position(double value) const {
    return axis_->scale == PlotAxis::Scale::logarithmic ? std::log10(value) : value;
}

void PlotScale::include(double value) {
    low_ = std::min(low_, position(value));
    high_ = std::max(high_, position(value));
}

void PlotScale::finish() {
    for (const std::optional<double>& end : {axis_->low, axis_->high}) {
        if (end) {
            include(*end);
        }
    }
    for (const PlotTick& tick : axis_->ticks) {
        include(tick.value);
    }
    // The least span: a decade, so that there are ticks; or what tells two numbers apart.
    const bool logarithmic = axis_->scale == PlotAxis::Scale::logarithmic;
    const double least = logarithmic ? 1 : std::max(1e-6 * std::abs(low_), 1e-300);
    const double margin = std::max(0.05 * (high_ - low_), 0.5 * (least - (high_ - low_)));
    const auto given = [&](const std::optional<double>& end, double at) { return end && position(*end) == at; };
    const bool low_given = given(axis_->low, low_), high_given = given(axis_->high, high_);
    low_ -= low_given ? 0 : margin;
    high_ += high_given ? 0 : margin;
}

double PlotScale::pixel(double value) const {
    return at(position(value));
}

std::vector<PlotScale::Tick> PlotScale::ticks() const {
    if (axis_->ticks.empty()) {
        return axis_->scale == PlotAxis::Scale::logarithmic ? logarithmic_ticks() : linear_ticks();
    }
    std::vector<Tick> result;
    for (const PlotTick& tick : axis_->ticks) {
        result.push_back({pixel(tick.value), escape_markup(tick.label)});
    }
    return result;
}

std::vector<PlotScale::Tick> PlotScale::linear_ticks() const {
    // One, two or five times a power of ten, for about one tick in 55 pixels.
    const double wanted = std::clamp(std::abs(last_ - first_) / 55, 2.0, 10.0);
    const double rough = (high_ - low_) / wanted;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double ratio = rough / power;
    const double step = power * (ratio <= 1 ? 1 : ratio <= 2 ? 2 : ratio <= 5 ? 5 : 10);
    std::vector<Tick> result;
    for (double i = std::ceil(low_ / step); i * step <= high_ && result.size() < 20; ++i) {
        result.push_back({at(i * step), fmt::format("{:g}", i == 0 ? 0 : i * step)});
    }
    return result;
}

std::vector<PlotScale::Tick> PlotScale::logarithmic_ticks() const {
    // Powers of ten, about eight at most; over a short span also their doubles and fives.
    const bool short_span = high_ - low_ < 2;
    const int stride = std::max(1, static_cast<int>(std::ceil((high_ - low_) / 8)));
    std::vector<Tick> result;
    for (int exponent = static_cast<int>(std::floor(low_)); exponent <= high_; ++exponent) {
        for (const int mantissa : {1, 2, 5}) {
            const double position = std::log10(mantissa) + exponent;
            const bool wanted = mantissa == 1 ? exponent % stride == 0 : short_span;
            if (wanted && position >= low_ && position <= high_) {
                result.push_back({at(position), power_label(mantissa, exponent)});
            }
        }
    }
    return result;
}

}  // namespace wend
