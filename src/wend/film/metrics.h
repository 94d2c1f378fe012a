// How far a picture is from its reference, number by number; film/flip.h says how far for a viewer.
#pragma once

#include <wend/core/image.h>

#include <optional>
#include <vector>

namespace wend {

/// A reference as two independent halves of equal quality. (I − a)(I − b) estimates the squared error without the
/// reference's own noise. A single reference file stands for both halves; its noise then counts as error of the
/// picture.
struct Reference {
    Image a, b;

    /// (a + b) / 2, the best picture the reference holds.
    Image average() const;
};

/// The measures of one picture I against a reference with average R. Sums run over pixels and channels in linear
/// colour; the averages of two halves leave noise only in denominators, where it biases by a relative O(variance of R /
/// R²).
struct Metrics {
    /// Mean of (I − a)(I − b) / (R² + e), e = 0.01 · mean(R)². May be slightly negative for two halves.
    double relmse = 0;
    /// Standard error of `relmse` from the scatter over pixels, taken as independent.
    double relmse_std_error = 0;
    /// `relmse` without the worst 0.1 % of pixels (rounded down: none below 1000 pixels).
    double relmse_trimmed = 0;
    /// firefly_error() of this picture's errors.
    double error_p9999 = 0;
    /// Mean of (I − a)(I − b).
    double mse = 0;
    /// Mean of |I − R| / (|R| + 0.01 · |mean(R)|). Noise of R counts here, also with two halves.
    double mape = 0;
};

struct ErrorTerms;

/// All measures. Throws InputError where sizes differ, where a pixel is not finite, or where mean(R) is zero (relative
/// errors mean nothing against a black reference).
Metrics measure(const Image& image, const Reference& reference);
/// The same of terms that are at hand.
Metrics measure(const ErrorTerms& terms);

/// How noisy a reference is: the relMSE that its average has by its own noise, mean of ((a − b)/2)² / (R² + e), which
/// two halves keep out of the measures and one picture does not. None where both halves are one picture, which does not
/// know. Throws as `measure` does.
std::optional<double> noise_of(const Reference& reference);

/// The terms of relMSE pixel by pixel, averaged over channels: their mean is `Metrics::relmse`. Row-major like the
/// image. Throws as `measure` does.
std::vector<float> relative_squared_errors(const Image& image, const Reference& reference);

/// The 99.99th percentile of the errors of pixels (relative_squared_errors(), of one picture or of several of equal
/// sampling): the smallest of them that at most one in 10 000 exceeds. It tells how far fireflies are off. Below 10 000
/// errors it is the largest; without any, 0.
double firefly_error(std::vector<float> errors);

}  // namespace wend
