#include <wend/film/flip.h>

#include <wend/core/error.h>
#include <wend/core/parallel.h>
#include <wend/core/vector.h>
#include <wend/film/comparable.h>
#include <wend/film/perceptual_filters.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace wend {
namespace {

/// Tristimulus values relative to the white of linear Rec. 709: white is (1, 1, 1).
constexpr Vec3 white_xyz{0.950428545f, 1.0f, 1.088900371f};

Vec3 to_relative_xyz(const Vec3& c) {
    return Vec3(0.412386564f * c.x + 0.357591491f * c.y + 0.180450490f * c.z,
                0.212636821f * c.x + 0.715182982f * c.y + 0.072180197f * c.z,
                0.019330620f * c.x + 0.119197164f * c.y + 0.950372587f * c.z) /
           white_xyz;
}

Vec3 to_linear_rgb(const Vec3& relative) {
    const Vec3 c = relative * white_xyz;
    return {3.241003233f * c.x - 1.537398969f * c.y - 0.498615882f * c.z,
            -0.969224252f * c.x + 1.875929984f * c.y + 0.041554226f * c.z,
            0.055639420f * c.x - 0.204011206f * c.y + 1.057148977f * c.z};
}

float cielab_curve(float t) {
    constexpr float delta = 6.0f / 29.0f;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0f / 29.0f;
}

/// CIELAB with the Hunt effect: chroma counts in proportion to lightness.
Vec3 to_hunt_adjusted_lab(const Vec3& relative) {
    const float x = cielab_curve(relative.x), y = cielab_curve(relative.y), z = cielab_curve(relative.z);
    const float lightness = 116 * y - 16;
    return {lightness, 0.01f * lightness * 500 * (x - y), 0.01f * lightness * 200 * (y - z)};
}

float hyab_distance(const Vec3& a, const Vec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

/// The ACES film curve of andersson2021 (a rational fit), as coefficients of (k0 x² + k1 x) / (k2 x² + k3 x + k4).
constexpr std::array<double, 5> aces = {0.9036, 0.018, 0.8748, 0.354, 0.14};

float aces_curve(float x) {
    // Beyond this the curve is flat at more than 1, while x² would leave the range of float.
    const double v = std::clamp(x, 0.0f, 1e6f);
    return static_cast<float>(std::min(1.0, (aces[0] * v + aces[1]) * v / ((aces[2] * v + aces[3]) * v + aces[4])));
}

/// The positive x that the film curve maps to `value`.
double inverse_aces_curve(double value) {
    const double a = aces[0] - value * aces[2], b = aces[1] - value * aces[3], c = -value * aces[4];
    return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

/// Runs body(y) for every row on all threads.
template <class Body>
void for_rows(int height, Body&& body) {
    parallel_for(static_cast<std::size_t>(height), 0, [&](std::size_t row) { body(static_cast<int>(row)); });
}

/// A displayed picture as opponent colours relative to white: luminance y, red-green x − y, blue-yellow y − z. The
/// YCxCz of andersson2020 but for scale and offset, which filters of unit sum leave alone.
struct Opponent {
    Plane luminance, red_green, blue_yellow;

    Opponent(const Image& linear, float exposure_factor)
        : luminance(linear.width, linear.height), red_green(luminance), blue_yellow(luminance) {
        for_rows(linear.height, [&](int y) {
            for (int x = 0; x < linear.width; ++x) {
                const Rgb c = linear.at(x, y) * exposure_factor;
                const Vec3 xyz = to_relative_xyz({aces_curve(c.r), aces_curve(c.g), aces_curve(c.b)});
                luminance.row(y)[x] = xyz.y;
                red_green.row(y)[x] = xyz.x - xyz.y;
                blue_yellow.row(y)[x] = xyz.y - xyz.z;
            }
        });
    }
};

/// What of a displayed picture FLIP compares: colours as perceived, edges and points.
struct Percept {
    std::vector<Vec3> lab;
    Plane edges, points;
};

Percept perceive(const Opponent& picture, const ContrastSensitivity& sensitivity, const FeatureDetector& features) {
    const Plane luminance = sensitivity.luminance(picture.luminance);
    const Plane red_green = sensitivity.red_green(picture.red_green);
    const Plane blue_yellow = sensitivity.blue_yellow(picture.blue_yellow);
    std::vector<Vec3> lab(luminance.values.size());
    for_rows(luminance.height, [&](int row) {
        const std::size_t first = static_cast<std::size_t>(row) * luminance.width;
        for (std::size_t i = first; i < first + luminance.width; ++i) {
            const float y = luminance.values[i];
            const Vec3 rgb = to_linear_rgb({red_green.values[i] + y, y, y - blue_yellow.values[i]});
            const auto displayable = [](float v) { return std::clamp(v, 0.0f, 1.0f); };
            lab[i] =
                to_hunt_adjusted_lab(to_relative_xyz({displayable(rgb.x), displayable(rgb.y), displayable(rgb.z)}));
        }
    });
    return {std::move(lab), features.edges(picture.luminance), features.points(picture.luminance)};
}

/// Compresses a colour distance so that small ones fill [0, 0.95] and the largest displayable one is 1.
float colour_error(float distance) {
    constexpr float compression = 0.7f, knee = 0.4f, knee_value = 0.95f;
    static const float largest = std::pow(hyab_distance(to_hunt_adjusted_lab(to_relative_xyz({0, 1, 0})),
                                                        to_hunt_adjusted_lab(to_relative_xyz({0, 0, 1}))),
                                          compression);
    const float error = std::pow(distance, compression) / largest;
    return error < knee ? knee_value * error / knee : knee_value + (error - knee) / (1 - knee) * (1 - knee_value);
}

/// Raises `map` to the LDR-FLIP error between two percepts where that is larger.
void take_larger_error(std::vector<float>& map, const Percept& a, const Percept& b) {
    const auto width = static_cast<std::size_t>(a.edges.width);
    for_rows(a.edges.height, [&](int row) {
        const std::size_t first = static_cast<std::size_t>(row) * width;
        for (std::size_t i = first; i < first + width; ++i) {
            const float edge = std::abs(a.edges.values[i] - b.edges.values[i]);
            const float point = std::abs(a.points.values[i] - b.points.values[i]);
            const float feature_error = std::sqrt(std::min(1.0f, std::max(edge, point) / std::sqrt(2.0f)));
            const float colour = std::min(1.0f, colour_error(hyab_distance(a.lab[i], b.lab[i])));
            map[i] = std::max(map[i], std::pow(colour, 1 - feature_error));
        }
    });
}

/// The exposures to look at, as factors: from the reference's brightest pixel just below white to its median there, a
/// stop or less apart (andersson2021).
std::vector<float> exposure_factors(const Image& reference) {
    constexpr double nearly_white = 0.85;
    // Below this a luminance counts as black, which bounds the number of exposures.
    constexpr float darkest = std::numeric_limits<float>::epsilon();

    std::vector<float> luminances(reference.pixels.size());
    std::transform(reference.pixels.begin(), reference.pixels.end(), luminances.begin(),
                   [=](const Rgb& c) { return std::max(darkest, luminance(c)); });
    const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
    std::nth_element(luminances.begin(), middle, luminances.end());
    const double white_input = inverse_aces_curve(nearly_white);
    const double start = std::log2(white_input / *std::max_element(luminances.begin(), luminances.end()));
    const double stop = std::log2(white_input / *middle);

    const int count = std::max(2, static_cast<int>(std::ceil(stop - start)));
    std::vector<float> factors;
    for (int i = 0; i < count; ++i) {
        factors.push_back(static_cast<float>(std::exp2(start + (stop - start) * i / (count - 1))));
    }
    return factors;
}

}  // namespace

FlipResult flip(const Image& image, const Image& reference, float pixels_per_degree) {
    require_finite(image, "the image");
    require_finite(reference, "the reference");
    require_same_size(image, reference, "the reference");
    if (!(pixels_per_degree >= 1 && pixels_per_degree <= 1000)) {
        throw InputError("FLIP needs 1 to 1000 pixels per degree, not " + std::to_string(pixels_per_degree));
    }

    const ContrastSensitivity sensitivity(pixels_per_degree);
    const FeatureDetector features(pixels_per_degree);
    FlipResult result;
    result.map.resize(image.pixels.size());
    for (const float factor : exposure_factors(reference)) {
        take_larger_error(result.map, perceive(Opponent(image, factor), sensitivity, features),
                          perceive(Opponent(reference, factor), sensitivity, features));
    }
    result.mean = std::accumulate(result.map.begin(), result.map.end(), 0.0) / static_cast<double>(result.map.size());
    return result;
}

}  // namespace wend
