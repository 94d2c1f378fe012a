#include <wend/core/error.h>
#include <wend/film/comparable.h>
#include <wend/film/metrics.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace wend {
namespace {

void require_valid(const Image& image, const Reference& reference) {
    require_finite(image, "the image");
    require_finite(reference.a, "the reference (half a)");
    require_finite(reference.b, "the reference (half b)");
    require_same_size(image, reference.a, "the reference (half a)");
    require_same_size(image, reference.b, "the reference (half b)");
}

double mean_value(const Image& image) {
    double sum = 0;
    for (const Rgb& pixel : image.pixels) {
        sum += static_cast<double>(pixel.r) + pixel.g + pixel.b;
    }
    return sum / (3.0 * static_cast<double>(image.pixels.size()));
}

/// The mean of R, which the relative measures scale their regularizers with.
double required_level(const Image& average) {
    const double level = std::abs(mean_value(average));
    if (level == 0) {
        throw InputError("the reference is black on average: relative errors are undefined");
    }
    return level;
}

double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double std_error_of_mean(const std::vector<double>& values, double mean) {
    if (values.size() < 2) {
        return 0;
    }
    double sum = 0;
    for (const double value : values) {
        sum += (value - mean) * (value - mean);
    }
    const auto n = static_cast<double>(values.size());
    return std::sqrt(sum / (n * (n - 1)));
}

/// The mean without the largest 0.1 % of the values.
double trimmed_mean(std::vector<double> values) {
    const std::size_t dropped = values.size() / 1000;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(dropped), values.end(),
                     std::greater<>());
    values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(dropped));
    return mean_of(values);
}

/// Per pixel, the mean over channels of term(image, a, b, average).
template <class Term>
std::vector<double> per_pixel(const Image& image, const Reference& reference, const Image& average, Term&& term) {
    std::vector<double> values(image.pixels.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            values[i] += term(double{image.pixels[i][c]}, double{reference.a.pixels[i][c]},
                              double{reference.b.pixels[i][c]}, double{average.pixels[i][c]});
        }
        values[i] /= 3;
    }
    return values;
}

std::vector<double> relative_squared(const Image& image, const Reference& reference, const Image& average,
                                     double level) {
    const double regularizer = 0.01 * level * level;
    return per_pixel(image, reference, average,
                     [=](double i, double a, double b, double r) { return (i - a) * (i - b) / (r * r + regularizer); });
}

std::vector<float> to_floats(const std::vector<double>& values) {
    constexpr double largest = std::numeric_limits<float>::max();
    std::vector<float> floats(values.size());
    std::transform(values.begin(), values.end(), floats.begin(),
                   [=](double value) { return static_cast<float>(std::clamp(value, -largest, largest)); });
    return floats;
}

}  // namespace

Image Reference::average() const {
    Image result = a;
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        // Halved first: the sum of two large finite values may not be finite.
        result.pixels[i] = 0.5f * a.pixels[i] + 0.5f * b.pixels[i];
    }
    return result;
}

Metrics measure(const Image& image, const Reference& reference) {
    require_valid(image, reference);
    const Image average = reference.average();
    const double level = required_level(average);

    const std::vector<double> relative = relative_squared(image, reference, average, level);
    const auto squared = [](double i, double a, double b, double) { return (i - a) * (i - b); };
    const auto absolute = [=](double i, double, double, double r) {
        return std::abs(i - r) / (std::abs(r) + 0.01 * level);
    };

    Metrics metrics;
    metrics.relmse = mean_of(relative);
    metrics.relmse_std_error = std_error_of_mean(relative, metrics.relmse);
    metrics.relmse_trimmed = trimmed_mean(relative);
    metrics.error_p9999 = firefly_error(to_floats(relative));
    metrics.mse = mean_of(per_pixel(image, reference, average, squared));
    metrics.mape = mean_of(per_pixel(image, reference, average, absolute));
    return metrics;
}

std::vector<float> relative_squared_errors(const Image& image, const Reference& reference) {
    require_valid(image, reference);
    const Image average = reference.average();
    return to_floats(relative_squared(image, reference, average, required_level(average)));
}

double firefly_error(std::vector<float> errors) {
    if (errors.empty()) {
        return 0;
    }
    const auto exceeding = static_cast<std::ptrdiff_t>(errors.size() / 10000);
    std::nth_element(errors.begin(), errors.begin() + exceeding, errors.end(), std::greater<>());
    return errors[static_cast<std::size_t>(exceeding)];
}

}  // namespace wend
