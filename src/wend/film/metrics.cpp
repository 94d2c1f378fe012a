#include <wend/film/metrics.h>

#include <wend/film/error_terms.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace wend {
namespace {

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
    return measure(error_terms(image, reference));
}

Metrics measure(const ErrorTerms& terms) {
    std::vector<double> squared(terms.relative_squared.size());
    for (std::size_t i = 0; i < squared.size(); ++i) {
        squared[i] = (terms.squared[3 * i] + terms.squared[3 * i + 1] + terms.squared[3 * i + 2]) / 3;
    }
    Metrics metrics;
    metrics.relmse = mean_of(terms.relative_squared);
    metrics.relmse_std_error = std_error_of_mean(terms.relative_squared, metrics.relmse);
    metrics.relmse_trimmed = trimmed_mean(terms.relative_squared);
    metrics.error_p9999 = firefly_error(to_floats(terms.relative_squared));
    metrics.mse = mean_of(squared);
    metrics.mape = mean_of(terms.relative);
    return metrics;
}

std::optional<double> noise_of(const Reference& reference) {
    const Image average = reference.average();
    // The average against one half alone: a and b are its halves' noise away, in opposite directions.
    const ErrorTerms terms = error_terms(average, reference);
    if (reference.a.pixels == reference.b.pixels) {
        return std::nullopt;
    }
    return -mean_of(terms.relative_squared);
}

std::vector<float> relative_squared_errors(const Image& image, const Reference& reference) {
    return to_floats(error_terms(image, reference).relative_squared);
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
