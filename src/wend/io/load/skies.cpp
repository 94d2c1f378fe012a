#include <wend/io/load/skies.h>

#include <wend/core/vector.h>
#include <wend/io/load/colours.h>
#include <wend/io/load/light_parameters.h>
#include <wend/io/load/sky_picture.h>
#include <wend/io/spectrum/blackbody.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace wend {
namespace {

/// What pbrt takes for the illuminance that a picture of the sky puts on a plane whose normal is the light's z: half of
/// it, because pbrt counts the pixels of the sphere as if they were those of the hemisphere.
float illuminance_of(const Image& sky) {
    double sum = 0;
    for (int y = 0; y < sky.height; ++y) {
        for (int x = 0; x < sky.width; ++x) {
            const Vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(sky.width),
                          (static_cast<float>(y) + 0.5f) / static_cast<float>(sky.height));
            sum += static_cast<double>(luminance(sky.at(x, y)) * std::max(0.0f, equal_area_square_to_sphere(uv).z));
        }
    }
    return static_cast<float>(sum * 2 * static_cast<double>(pi) / static_cast<double>(sky.pixels.size()));
}

/// The corners of "portal", which pbrt takes to be in the world, whatever the transform of the light.
std::array<Vec3, 4> load_portal(LoadContext& context, const pbrt::ParameterSet& p) {
    const std::vector<Vec3> given = p.get_point3s("portal");
    if (given.size() != 4) {
        throw InputError(p.place_of("portal"), fmt::format("a portal has 4 corners, not {}", given.size()));
    }
    const auto side = [&](std::size_t from, std::size_t to) { return given[to] - given[from]; };
    const Vec3 sides[] = {side(0, 1), side(1, 2), side(3, 2), side(0, 3)};
    constexpr float tolerance = 1e-3f;
    const auto cosine = [&](int a, int b) { return dot(normalize(sides[a]), normalize(sides[b])); };
    const bool is_rectangle = std::abs(cosine(0, 2) - 1) <= tolerance && std::abs(cosine(1, 3) - 1) <= tolerance &&
                              std::abs(cosine(0, 1)) <= tolerance && std::abs(cosine(0, 3)) <= tolerance;
    // Written so that sides without length are refused.
    if (!(length_squared(cross(normalize(sides[0]), normalize(sides[3]))) > tolerance)) {
        throw InputError(p.place_of("portal"), "the corners of the portal are not those of a rectangle");
    }
    if (!is_rectangle) {
        context.warnings.add(p.place_of("portal"),
                             "the corners of the portal are not those of a rectangle: it is the one along the first "
                             "and the last side from the first to the third, as in pbrt");
    }
    return {given[0], given[1], given[2], given[3]};
}

/// A picture at infinity, everywhere or through a portal.
Light make_sky(LoadContext& context, const pbrt::LightEntity& light, Image image) {
    const pbrt::ParameterSet& p = light.parameters;
    float scale = non_negative_float(p, "scale", 1);
    if (const float illuminance = load_target(p, "illuminance"); illuminance > 0) {
        const float unscaled = illuminance_of(image);
        scale *= unscaled > 0 ? illuminance / unscaled : 0.0f;
    }
    if (p.has("portal")) {
        return PortalInfiniteLight{
            std::make_shared<const PortalLight>(image, scale, light.world_from_light, load_portal(context, p))};
    }
    return ImageInfiniteLight(std::move(image), scale, light.world_from_light);
}

/// By "mapping", beyond pbrt: by longitude and latitude, or as pbrt has it.
Image load_sky(LoadContext& context, TextureLoader& textures, const pbrt::LightEntity& light) {
    const std::string mapping = light.parameters.get_string("mapping", "equalarea");
    Image image = load_picture(context, textures, light);
    if (mapping == "equirectangular") {
        const bool has_poles = light.parameters.get_bool("rowsatpoles", false);
        return equal_area_sky(image, has_poles ? SkyRows::on_nodes : SkyRows::in_strips);
    }
    if (mapping != "equalarea") {
        throw InputError(light.parameters.place_of("mapping"),
                         fmt::format("the mapping \"{}\" is unknown; known are equalarea, equirectangular", mapping));
    }
    require_square(image, light);
    return image;
}

/// What shines through a portal. pbrt keeps it as a picture, in which a spectrum has its own luminance, not 1 as in all
/// other lights; that of a black body is 1 at its peak.
Rgb load_light_of_portal(LoadContext& context, const pbrt::ParameterSet& p) {
    const Rgb radiance = get_colour(context, p, "L", SpectrumKind::illuminant).value_or(default_light(p));
    const double even = xyz_from_spectrum([](double) { return 1.0; }).y;
    double luminance_given = even;
    const auto value = p.get_colour("L");
    if (const auto* body = value ? std::get_if<pbrt::Blackbody>(&*value) : nullptr) {
        luminance_given = blackbody_xyz(double{body->temperature}).y;
    } else if (const auto spectrum = find_spectrum(context, p, "L")) {
        luminance_given = xyz_from_spectrum(spectrum).y;
    }
    return radiance * static_cast<float>(luminance_given / even);
}

}  // namespace

Light load_infinite(LoadContext& context, TextureLoader& textures, const pbrt::LightEntity& light) {
    const pbrt::ParameterSet& p = light.parameters;
    if (p.has("filename")) {
        if (p.has("L")) {
            throw InputError(p.place_of("L"), "an infinite light takes either \"L\" or \"filename\"");
        }
        return make_sky(context, light, load_sky(context, textures, light));
    }
    if (p.has("portal")) {
        return make_sky(context, light, Image(1, 1, load_light_of_portal(context, p)));
    }
    Rgb radiance = load_scaled(context, p, "L");
    if (const float illuminance = load_target(p, "illuminance"); illuminance > 0) {
        radiance *= illuminance * inv_pi;
    }
    return UniformInfiniteLight{radiance};
}

}  // namespace wend
