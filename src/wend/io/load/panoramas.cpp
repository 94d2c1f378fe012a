#include <wend/io/load/panoramas.h>

#include <wend/core/error.h>
#include <wend/core/vector.h>
#include <wend/io/load/context.h>
#include <wend/io/load/named_value.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

using Mapping = Panorama::Mapping;

constexpr std::array<Named<Mapping>, 7> mappings = {{{"cubeface", Mapping::cube_face},
                                                     {"cylindrical", Mapping::cylindrical},
                                                     {"equidistant", Mapping::equidistant},
                                                     {"equirectangular", Mapping::equirectangular},
                                                     {"equisolid", Mapping::equisolid},
                                                     {"mirrorball", Mapping::mirror_ball},
                                                     {"polynomial", Mapping::polynomial}}};

bool is_fisheye(Mapping mapping) {
    return mapping == Mapping::equidistant || mapping == Mapping::equisolid || mapping == Mapping::polynomial;
}

/// Half the field of view, in radians.
float half_view(const pbrt::ParameterSet& parameters) {
    constexpr float most = 720;
    const float fov = parameters.get_float("fov", 180);
    if (!(fov > 0 && fov <= most)) {
        throw InputError(parameters.place_of("fov"),
                         fmt::format("\"fov\" must lie above 0 and be at most {} degrees, not {}", most, fov));
    }
    return 0.5f * fov * pi / 180;
}

std::array<float, 5> coefficients_of(const pbrt::ParameterSet& parameters) {
    const std::vector<float> values = parameters.get_floats("coefficients");
    std::array<float, 5> result{};
    if (values.empty() || values.size() > result.size() ||
        !std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); })) {
        throw InputError(parameters.place_of("coefficients"),
                         "the mapping \"polynomial\" needs one to five finite \"coefficients\"");
    }
    std::copy(values.begin(), values.end(), result.begin());
    return result;
}

/// What the whole picture shows where the file does not say: fisheyes have their field of view in the shorter side.
ScreenWindow window_of(const Panorama& camera, float aspect) {
    switch (camera.mapping) {
        case Mapping::equirectangular:
            return {-pi, pi, -pi / 2, pi / 2};
        case Mapping::cylindrical:
            return {-pi, pi, -1, 1};
        case Mapping::cube_face:
            return {-pi / 4, pi / 4, -pi / 4, pi / 4};
        case Mapping::equidistant:
        case Mapping::equisolid: {
            const float reach =
                camera.mapping == Mapping::equidistant ? camera.largest_angle : 2 * std::sin(camera.largest_angle / 2);
            const float x = reach * std::max(aspect, 1.0f), y = reach * std::max(1 / aspect, 1.0f);
            return {-x, x, -y, y};
        }
        default:
            return {};
    }
}

}  // namespace

Panorama load_panorama(const pbrt::ParameterSet& parameters, const std::optional<ScreenWindow>& window, float aspect) {
    Panorama camera;
    camera.mapping = named_value(parameters, "mapping", mappings, Mapping::equirectangular);
    if (is_fisheye(camera.mapping)) {
        camera.largest_angle = half_view(parameters);
    }
    if (camera.mapping == Mapping::equisolid && camera.largest_angle > pi) {
        throw InputError(parameters.place_of("fov"), "an equisolid fisheye sees at most 360 degrees");
    }
    if (camera.mapping == Mapping::polynomial) {
        camera.coefficients = coefficients_of(parameters);
        if (!window) {
            throw InputError(parameters.place_of("mapping"), "the mapping \"polynomial\" needs a \"screenwindow\"");
        }
    }
    camera.screen = window.value_or(window_of(camera, aspect));
    if (camera.mapping == Mapping::cube_face) {
        const ScreenWindow& s = camera.screen;
        if (std::max({std::abs(s.x_min), std::abs(s.x_max), std::abs(s.y_min), std::abs(s.y_max)}) >= pi / 2) {
            throw InputError(
                parameters.place_of("screenwindow"),
                "a face of a cube is less than half of all directions wide: the screen ends before pi / 2");
        }
    }
    camera.lens_radius = non_negative_float(parameters, "lensradius", 0);
    camera.focal_distance = positive_float(parameters, "focaldistance", 1e6f);
    return camera;
}

}  // namespace wend
