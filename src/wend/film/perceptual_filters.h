// The filters that FLIP models vision with. All are separable and repeat the border's pixels beyond the border.
#pragma once

#include <cstddef>
#include <vector>

namespace wend {

/// One value a pixel, row-major.
struct Plane {
    int width, height;
    std::vector<float> values;

    Plane(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    float* row(int y) { return values.data() + static_cast<std::size_t>(y) * width; }
    const float* row(int y) const { return values.data() + static_cast<std::size_t>(y) * width; }
};

/// Weights of a one-dimensional filter at offsets −radius … radius.
using Kernel = std::vector<float>;

/// What an observer at a distance resolves of luminance, red-green and blue-yellow contrast: low-pass filters of unit
/// sum (andersson2020). The distance is given as pixels per degree of visual angle.
class ContrastSensitivity {
public:
    explicit ContrastSensitivity(double pixels_per_degree);

    Plane luminance(const Plane& in) const;
    Plane red_green(const Plane& in) const;
    Plane blue_yellow(const Plane& in) const;

private:
    /// One Gaussian of a sensitivity function: weights of sum 1, and the sum of the 2-D filter before it is normalized.
    struct Gaussian {
        Kernel kernel;
        float mass;

        /// a · sqrt(π/b) · exp(−π² d²/b) at d degrees.
        Gaussian(double a, double b, double pixels_per_degree);
        Plane apply(const Plane& in) const;
    };

    Gaussian luminance_, red_green_, blue_yellow_narrow_, blue_yellow_wide_;
};

/// How strong edges and points are: lengths of first and second derivatives of a Gaussian applied to luminance in [0,1]
/// (andersson2020).
class FeatureDetector {
public:
    explicit FeatureDetector(double pixels_per_degree);

    Plane edges(const Plane& luminance) const { return strength(luminance, edge_); }
    Plane points(const Plane& luminance) const { return strength(luminance, point_); }

private:
    Plane strength(const Plane& luminance, const Kernel& derivative) const;

    Kernel smooth_, edge_, point_;
};

}  // namespace wend
