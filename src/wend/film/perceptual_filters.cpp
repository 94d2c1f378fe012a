#include <wend/film/perceptual_filters.h>

#include <wend/core/parallel.h>
#include <wend/core/vector.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wend {
namespace {

/// The largest b of the Gaussians below: the widest of them sets the radius of all.
constexpr double widest_gaussian = 0.04;

Plane convolve_rows(const Plane& in, const Kernel& kernel) {
    const std::size_t radius = kernel.size() / 2;
    const auto width = static_cast<std::size_t>(in.width);
    Plane out(in.width, in.height);
    parallel_for(static_cast<std::size_t>(in.height), 0, [&](std::size_t row) {
        const float* source = in.row(static_cast<int>(row));
        float* target = out.row(static_cast<int>(row));
        std::vector<float> padded(width + 2 * radius, source[width - 1]);
        std::fill_n(padded.begin(), radius, source[0]);
        std::copy_n(source, width, padded.data() + radius);
        for (std::size_t i = 0; i < kernel.size(); ++i) {
            for (std::size_t x = 0; x < width; ++x) {
                target[x] += kernel[i] * padded[i + x];
            }
        }
    });
    return out;
}

Plane convolve_columns(const Plane& in, const Kernel& kernel) {
    const int radius = static_cast<int>(kernel.size() / 2);
    Plane out(in.width, in.height);
    parallel_for(static_cast<std::size_t>(in.height), 0, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        float* target = out.row(y);
        for (int offset = -radius; offset <= radius; ++offset) {
            const float weight = kernel[static_cast<std::size_t>(offset + radius)];
            const float* source = in.row(std::clamp(y + offset, 0, in.height - 1));
            for (int x = 0; x < in.width; ++x) {
                target[x] += weight * source[x];
            }
        }
    });
    return out;
}

/// The values f(−radius) … f(radius).
template <class F>
Kernel tabulate(int radius, F&& f) {
    Kernel kernel;
    for (int offset = -radius; offset <= radius; ++offset) {
        kernel.push_back(static_cast<float>(f(static_cast<double>(offset))));
    }
    return kernel;
}

/// Scales positive weights to sum to 1 and negative ones to −1.
Kernel normalized_by_sign(Kernel kernel) {
    float positive = 0, negative = 0;
    for (const float weight : kernel) {
        (weight > 0 ? positive : negative) += weight;
    }
    for (float& weight : kernel) {
        if (weight != 0) {
            weight /= weight > 0 ? positive : -negative;
        }
    }
    return kernel;
}

}  // namespace

ContrastSensitivity::Gaussian::Gaussian(double a, double b, double pixels_per_degree) {
    const double square_pi = static_cast<double>(pi) * pi;
    const double deviations = 3;
    const auto radius =
        static_cast<int>(std::ceil(deviations * std::sqrt(widest_gaussian / (2 * square_pi)) * pixels_per_degree));
    const double rate = square_pi / (b * pixels_per_degree * pixels_per_degree);
    const Kernel unscaled = tabulate(radius, [=](double x) { return std::exp(-rate * x * x); });
    const float sum = std::accumulate(unscaled.begin(), unscaled.end(), 0.0f);
    mass = static_cast<float>(a * std::sqrt(static_cast<double>(pi) / b)) * sum * sum;
    kernel = normalized_by_sign(unscaled);
}

Plane ContrastSensitivity::Gaussian::apply(const Plane& in) const {
    return convolve_columns(convolve_rows(in, kernel), kernel);
}

ContrastSensitivity::ContrastSensitivity(double pixels_per_degree)
    : luminance_(1, 0.0047, pixels_per_degree),
      red_green_(1, 0.0053, pixels_per_degree),
      blue_yellow_narrow_(34.1, widest_gaussian, pixels_per_degree),
      blue_yellow_wide_(13.5, 0.025, pixels_per_degree) {
}

Plane ContrastSensitivity::luminance(const Plane& in) const {
    return luminance_.apply(in);
}

Plane ContrastSensitivity::red_green(const Plane& in) const {
    return red_green_.apply(in);
}

Plane ContrastSensitivity::blue_yellow(const Plane& in) const {
    Plane out = blue_yellow_narrow_.apply(in);
    const Plane wide = blue_yellow_wide_.apply(in);
    const float share = blue_yellow_wide_.mass / (blue_yellow_narrow_.mass + blue_yellow_wide_.mass);
    for (std::size_t i = 0; i < out.values.size(); ++i) {
        out.values[i] += share * (wide.values[i] - out.values[i]);
    }
    return out;
}

FeatureDetector::FeatureDetector(double pixels_per_degree) {
    constexpr double peak_to_trough_degrees = 0.082;
    const double deviation = 0.5 * peak_to_trough_degrees * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    const auto gaussian = [=](double x) { return std::exp(-x * x / (2 * deviation * deviation)); };
    const auto first = [=](double x) { return -x * gaussian(x); };
    const auto second = [=](double x) { return (x * x / (deviation * deviation) - 1) * gaussian(x); };
    smooth_ = normalized_by_sign(tabulate(radius, gaussian));
    edge_ = normalized_by_sign(tabulate(radius, first));
    point_ = normalized_by_sign(tabulate(radius, second));
}

Plane FeatureDetector::strength(const Plane& luminance, const Kernel& derivative) const {
    Plane length = convolve_columns(convolve_rows(luminance, derivative), smooth_);
    const Plane along_y = convolve_columns(convolve_rows(luminance, smooth_), derivative);
    for (std::size_t i = 0; i < length.values.size(); ++i) {
        length.values[i] = std::hypot(length.values[i], along_y.values[i]);
    }
    return length;
}

}  // namespace wend
