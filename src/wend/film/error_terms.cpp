#include <wend/film/error_terms.h>

#include <wend/core/contracts.h>
#include <wend/core/error.h>
#include <wend/film/comparable.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Every value of one times a factor, onto another.
void add_scaled(std::vector<double>& sum, const std::vector<double>& values, double factor) {
    sum.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        sum[i] += factor * values[i];
    }
}

void add_scaled(ErrorTerms& sum, const ErrorTerms& terms, double factor) {
    add_scaled(sum.squared, terms.squared, factor);
    add_scaled(sum.relative_squared, terms.relative_squared, factor);
    add_scaled(sum.relative, terms.relative, factor);
    add_scaled(sum.difference, terms.difference, factor);
}

}  // namespace

ErrorTerms error_terms(const Image& image, const Reference& reference) {
    require_valid(image, reference);
    const Image average = reference.average();
    const double level = required_level(average);
    const double regularizer = 0.01 * level * level;
    const std::size_t pixels = image.pixels.size();
    ErrorTerms terms{std::vector<double>(3 * pixels), std::vector<double>(pixels), std::vector<double>(pixels),
                     std::vector<double>(3 * pixels)};
    for (std::size_t p = 0; p < pixels; ++p) {
        for (int c = 0; c < 3; ++c) {
            const double i = image.pixels[p][c], r = average.pixels[p][c];
            const double squared = (i - reference.a.pixels[p][c]) * (i - reference.b.pixels[p][c]);
            const std::size_t channel = 3 * p + static_cast<std::size_t>(c);
            terms.squared[channel] = squared;
            terms.difference[channel] = i - r;
            terms.relative_squared[p] += squared / (r * r + regularizer);
            terms.relative[p] += std::abs(i - r) / (std::abs(r) + 0.01 * level);
        }
        terms.relative_squared[p] /= 3;
        terms.relative[p] /= 3;
    }
    return terms;
}

std::vector<float> to_floats(const std::vector<double>& values) {
    constexpr double largest = std::numeric_limits<float>::max();
    std::vector<float> floats(values.size());
    std::transform(values.begin(), values.end(), floats.begin(),
                   [=](double value) { return static_cast<float>(std::clamp(value, -largest, largest)); });
    return floats;
}

void MeanErrors::add(const ErrorTerms& terms) {
    WEND_EXPECT(count_ == 0 || terms.relative.size() == sums_.relative.size());
    add_scaled(sums_, terms, 1);
    ++count_;
}

ErrorTerms MeanErrors::mean() const {
    ErrorTerms mean;
    if (count_ > 0) {
        add_scaled(mean, sums_, 1 / static_cast<double>(count_));
    }
    return mean;
}

}  // namespace wend
