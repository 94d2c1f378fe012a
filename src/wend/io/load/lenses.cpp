#include <wend/io/load/lenses.h>

#include <wend/io/image_file.h>
#include <wend/io/pbrt/text_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace wend {
namespace {

constexpr double millimetre = 1e-3;

/// The four numbers of a line; none if it is empty.
std::optional<LensSurface> read_line(const std::string& line, const Place& place) {
    constexpr const char* expected =
        "expected four numbers: radius of curvature, thickness, index of refraction and diameter of the opening";
    std::istringstream words(line.substr(0, line.find('#')));
    std::vector<double> numbers;
    for (double number = 0; words >> number;) {
        numbers.push_back(number);
    }
    if (!words.eof() || (!numbers.empty() && numbers.size() != 4)) {
        throw InputError(place, expected);
    }
    if (numbers.empty()) {
        return std::nullopt;
    }
    const bool is_stop = numbers[0] == 0;
    // Of stops it is 0, and air may be as well.
    const double index = is_stop || numbers[2] == 0 ? 1.0 : numbers[2];
    if (!std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); }) || numbers[1] < 0 ||
        !(index >= 1) || !(numbers[3] > 0)) {
        throw InputError(place, "a lens needs a thickness that is not below 0, an index of at least 1, and an opening");
    }
    if (!is_stop && numbers[3] > 2 * std::abs(numbers[0])) {
        throw InputError(place, "the opening is wider than the ball that the lens is a part of");
    }
    return LensSurface{numbers[0] * millimetre, numbers[1] * millimetre, index, 0.5 * numbers[3] * millimetre};
}

std::vector<LensSurface> read_lenses(const std::filesystem::path& file, const pbrt::Location& place) {
    constexpr std::size_t most = 1000;
    std::istringstream lines(pbrt::read_text_file(file, place));
    std::vector<LensSurface> surfaces;
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        const Place here{file.string(), number, 1};
        if (const auto surface = read_line(line, here)) {
            if (surfaces.size() == most) {
                throw InputError(here, fmt::format("there are more than {} lenses", most));
            }
            surfaces.push_back(*surface);
        }
    }
    if (surfaces.empty()) {
        throw InputError(place, fmt::format("there are no lenses in \"{}\"", file.string()));
    }
    return surfaces;
}

/// Of pbrt's own stops.
constexpr int resolution = 256;

template <class Value>
Image drawn(const Value& value) {
    Image image(resolution, resolution);
    for (int y = 0; y < resolution; ++y) {
        for (int x = 0; x < resolution; ++x) {
            const Vec2 p(2 * (static_cast<float>(x) + 0.5f) / resolution - 1,
                         2 * (static_cast<float>(y) + 0.5f) / resolution - 1);
            image.at(x, y) = Rgb(value(p));
        }
    }
    return image;
}

/// Whether a point is within a polygon: whether a line from there crosses its edges an odd number of times.
bool is_within(std::span<const Vec2> corners, const Vec2& p) {
    bool inside = false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        if ((a.y <= p.y) != (b.y <= p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) {
            inside = !inside;
        }
    }
    return inside;
}

float gaussian_stop(const Vec2& p) {
    return std::max(0.0f, std::exp(-(p.x * p.x + p.y * p.y)) - std::exp(-1.0f));
}

float square_stop(const Vec2&) {
    return 1;
}

float pentagon_stop(const Vec2& p) {
    std::array<Vec2, 5> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const float angle = 2 * pi * static_cast<float>(i) / 5;
        corners[i] = Vec2(std::sin(angle), std::cos(angle)) * 0.8f;
    }
    return is_within(corners, p) ? 1.0f : 0.0f;
}

float star_stop(const Vec2& p) {
    const float inner = std::cos(2 * pi / 5) / std::cos(pi / 5);
    std::array<Vec2, 10> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const float angle = pi * static_cast<float>(i) / 5;
        corners[i] = Vec2(std::cos(angle), std::sin(angle)) * (i % 2 == 1 ? 1.0f : inner);
    }
    return is_within(corners, p) ? 1.0f : 0.0f;
}

/// As bright as a round one.
Image with_light_of_a_disk(Image image, const pbrt::Location& place) {
    double sum = 0;
    for (Rgb& pixel : image.pixels) {
        if (!is_finite(pixel) || pixel.r < 0 || pixel.g < 0 || pixel.b < 0) {
            throw InputError(place, "the picture of the aperture has a pixel that is not finite or below 0");
        }
        sum += static_cast<double>(mean(pixel));
    }
    if (!(sum > 0)) {
        throw InputError(place, "the picture of the aperture is black");
    }
    const auto scale = static_cast<float>(double{pi} / 4 * static_cast<double>(image.pixels.size()) / sum);
    for (Rgb& pixel : image.pixels) {
        pixel *= scale;
    }
    return image;
}

/// Empty for a disk.
Image load_stop(LoadContext& context, const pbrt::CameraEntity& camera) {
    const std::string name = camera.parameters.get_string("aperture", "");
    const pbrt::Location place = camera.parameters.place_of("aperture");
    if (name.empty()) {
        return {};
    }
    constexpr std::pair<std::string_view, float (*)(const Vec2&)> known[] = {
        {"gaussian", gaussian_stop}, {"square", square_stop}, {"pentagon", pentagon_stop}, {"star", star_stop}};
    for (const auto& [known_name, value] : known) {
        if (name == known_name) {
            return with_light_of_a_disk(drawn(value), place);
        }
    }
    return with_light_of_a_disk(read_image(required_file(context, camera, "aperture")), place);
}

}  // namespace

RealisticCamera load_realistic(LoadContext& context, const pbrt::CameraEntity& camera, const Vec2& film_size) {
    const pbrt::ParameterSet& p = camera.parameters;
    const pbrt::Location place = p.place_of("lensfile");
    std::vector<LensSurface> surfaces = read_lenses(required_file(context, camera, "lensfile"), place);
    const double stop = 0.5 * millimetre * double{positive_float(p, "aperturediameter", 1)};
    for (LensSurface& surface : surfaces) {
        if (surface.radius == 0 && stop > surface.aperture) {
            context.warnings.add(
                p.place_of("aperturediameter"),
                fmt::format("\"aperturediameter\" is larger than the aperture of the lens file, {:.4g}: "
                            "that is taken",
                            2 * surface.aperture / millimetre));
        } else if (surface.radius == 0) {
            surface.aperture = stop;
        }
    }
    const double distance = double{positive_float(p, "focusdistance", 10)};
    Image picture = load_stop(context, camera);
    const double film_radius = 0.5 * std::hypot(double{film_size.x}, double{film_size.y});
    try {
        return {std::make_shared<const LensSystem>(std::move(surfaces), distance, film_radius, std::move(picture)),
                film_size};
    } catch (const std::domain_error& error) {
        throw InputError(place, error.what());
    }
}

}  // namespace wend
