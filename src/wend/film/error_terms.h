// Errors pixel by pixel, and their means over several pictures.
#pragma once

#include <wend/film/metrics.h>

#include <cstddef>
#include <vector>

namespace wend {

/// What the measures are means of, row-major like the picture. With R the average of the reference's halves a and b,
/// and e = 0.01 · mean(R)²:
struct ErrorTerms {
    std::vector<double> squared;           ///< (I − a)(I − b), three channels a pixel
    std::vector<double> relative_squared;  ///< (I − a)(I − b) / (R² + e), averaged over channels
    std::vector<double> relative;          ///< |I − R| / (|R| + 0.01 · |mean(R)|), averaged over channels
    std::vector<double> difference;        ///< I − R, three channels a pixel
};

/// Throws as measure() does.
ErrorTerms error_terms(const Image& image, const Reference& reference);

/// In single precision; what is too large for it becomes the largest number.
std::vector<float> to_floats(const std::vector<double>& values);

/// Means of the terms over several pictures of one size.
class MeanErrors {
public:
    void add(const ErrorTerms& terms);

    /// Of no pictures: empty.
    ErrorTerms mean() const;
    std::size_t count() const { return count_; }

private:
    ErrorTerms sums_;
    std::size_t count_ = 0;
};

}  // namespace wend
