#include <wend/app/convergence_plot.h>
#include <wend/app/markup.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace wend {
namespace {

// The frame of the plot in the units of the view box; the legend follows below.
constexpr double width = 560, left = 62, right = 546, top = 14, bottom = 300;
constexpr double legend_top = bottom + 62, legend_row = 22, legend_column = (right - left) / 2;

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

bool can_show(const ConvergenceSeries::Point& point) {
    return point.seconds > 0 && point.relmse > 0 && std::isfinite(point.seconds) && std::isfinite(point.relmse);
}

/// A logarithmic axis: decimal exponents `low` to `high` laid out from pixel `start` to `end`.
struct Axis {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    double start, end;

    Axis(double first_pixel, double last_pixel) : start(first_pixel), end(last_pixel) {}

    void include(double value) {
        low = std::min(low, std::log10(value));
        high = std::max(high, std::log10(value));
    }

    /// Leaves room around the data, and spans a decade at least so that there are ticks.
    void widen() {
        const double margin = std::max(0.05 * (high - low), 0.5 * (1.0 - (high - low)));
        low -= margin;
        high += margin;
    }

    double pixel(double exponent) const { return start + (end - start) * (exponent - low) / (high - low); }

    struct Tick {
        int mantissa;
        int exponent;
        double position() const { return std::log10(mantissa) + exponent; }
    };

    /// Powers of ten, about eight at most; over a short span also their doubles and fives.
    std::vector<Tick> ticks() const {
        const bool short_span = high - low < 2;
        const int stride = std::max(1, static_cast<int>(std::ceil((high - low) / 8)));
        std::vector<Tick> result;
        for (int exponent = static_cast<int>(std::floor(low)); exponent <= high; ++exponent) {
            for (const int mantissa : {1, 2, 5}) {
                const Tick tick{mantissa, exponent};
                const bool wanted = mantissa == 1 ? exponent % stride == 0 : short_span;
                if (wanted && tick.position() >= low && tick.position() <= high) {
                    result.push_back(tick);
                }
            }
        }
        return result;
    }
};

std::string label(const Axis::Tick& tick) {
    if (tick.exponent >= -3 && tick.exponent <= 4) {
        return fmt::format("{:g}", tick.mantissa * std::pow(10.0, tick.exponent));
    }
    return fmt::format("{}10<tspan dy=\"-5\" font-size=\"9\">{}</tspan>",
                       tick.mantissa == 1 ? "" : fmt::format("{}·", tick.mantissa), tick.exponent);
}

std::string frame(const Axis& x, const Axis& y) {
    std::string svg;
    auto out = std::back_inserter(svg);
    for (const Axis::Tick& tick : x.ticks()) {
        const double at = x.pixel(tick.position());
        fmt::format_to(out, "<path class=\"grid\" d=\"M{0:.1f} {1}V{2}\"/><text x=\"{0:.1f}\" y=\"{3}\">{4}</text>\n",
                       at, top, bottom, bottom + 18, label(tick));
    }
    for (const Axis::Tick& tick : y.ticks()) {
        const double at = y.pixel(tick.position());
        fmt::format_to(
            out,
            "<path class=\"grid\" d=\"M{1} {0:.1f}H{2}\"/><text class=\"end\" x=\"{3}\" y=\"{4:.1f}\">{5}</text>\n", at,
            left, right, left - 8, at + 4, label(tick));
    }
    fmt::format_to(out, "<path class=\"axis\" d=\"M{} {}V{}H{}\"/>\n", left, top, bottom, right);
    fmt::format_to(out, "<text x=\"{}\" y=\"{}\">seconds</text>\n", (left + right) / 2, bottom + 38);
    fmt::format_to(out, "<text transform=\"translate(14 {}) rotate(-90)\">relMSE</text>\n", (top + bottom) / 2);
    return svg;
}

/// A marker that differs from series to series.
std::string marker(std::size_t index, double x, double y) {
    switch (index % 3) {
        case 0:
            return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.4\"/>", x, y);
        case 1:
            return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"6.4\" height=\"6.4\"/>", x - 3.2, y - 3.2);
        default:
            return fmt::format("<path d=\"M{:.1f} {:.1f}l4.2 7.2h-8.4z\"/>", x, y - 4.6);
    }
}

std::string line(std::size_t index, const std::vector<std::array<double, 2>>& pixels) {
    const Pen& pen = pens[index % pens.size()];
    std::string points, markers;
    for (const auto& [x, y] : pixels) {
        points += fmt::format("{:.1f},{:.1f} ", x, y);
        markers += marker(index, x, y);
    }
    return fmt::format(
        "<polyline class=\"line\" stroke=\"{0}\" stroke-dasharray=\"{1}\" points=\"{2}\"/><g fill=\"{0}\">{3}</g>\n",
        pen.colour, pen.dashes, points, markers);
}

std::string curve(std::size_t index, const ConvergenceSeries& series, const Axis& x, const Axis& y) {
    std::vector<std::array<double, 2>> pixels;
    for (const ConvergenceSeries::Point& point : series.points) {
        if (can_show(point)) {
            pixels.push_back({x.pixel(std::log10(point.seconds)), y.pixel(std::log10(point.relmse))});
        }
    }
    return line(index, pixels);
}

std::string legend_entry(std::size_t index, const std::string& name) {
    const double x = left + legend_column * static_cast<double>(index % 2);
    const double y = legend_top + legend_row * static_cast<double>(index / 2);
    return line(index, {{x, y}, {x + 28, y}}) +
           fmt::format("<text class=\"start\" x=\"{}\" y=\"{}\">{}</text>\n", x + 38, y + 4, escape_markup(name));
}

}  // namespace

std::string convergence_svg(const std::vector<ConvergenceSeries>& series) {
    Axis x(left, right), y(bottom, top);
    for (const ConvergenceSeries& one : series) {
        for (const ConvergenceSeries::Point& point : one.points) {
            if (can_show(point)) {
                x.include(point.seconds);
                y.include(point.relmse);
            }
        }
    }
    const bool empty = x.low > x.high;
    const double height = legend_top + legend_row * static_cast<double>((series.size() + 1) / 2);

    std::string svg = fmt::format(
        R"(<svg class="convergence" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {} {}" role="img" aria-label="relMSE over seconds, logarithmic axes">
<style>.convergence text{{font:13px system-ui,sans-serif;fill:currentColor;text-anchor:middle}}.convergence .end{{text-anchor:end}}.convergence .start{{text-anchor:start}}.convergence .grid{{stroke:currentColor;stroke-opacity:.13}}.convergence .axis{{stroke:currentColor;stroke-opacity:.6;fill:none}}.convergence .line{{fill:none;stroke-width:2;stroke-linejoin:round}}</style>
)",
        width, empty ? bottom : height);
    if (empty) {
        svg += fmt::format("<text x=\"{}\" y=\"{}\">no positive errors to plot</text>\n", width / 2, bottom / 2);
    } else {
        x.widen();
        y.widen();
        svg += frame(x, y);
        for (std::size_t i = 0; i < series.size(); ++i) {
            svg += curve(i, series[i], x, y) + legend_entry(i, series[i].name);
        }
    }
    return svg + "</svg>\n";
}

}  // namespace wend
