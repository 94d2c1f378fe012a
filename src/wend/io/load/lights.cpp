#include <wend/io/load/lights.h>

#include <wend/core/vector.h>
#include <wend/io/load/light_parameters.h>
#include <wend/io/load/reach.h>
#include <wend/io/load/refined_picture.h>
#include <wend/io/load/skies.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

namespace wend {
namespace {

/// What "power" multiplies an intensity by that has the given power without it.
float power_factor(const pbrt::ParameterSet& p, float unscaled) {
    const float power = load_target(p, "power");
    return !(power > 0) ? 1.0f : unscaled > 0 ? power / unscaled : 0.0f;
}

/// Where a light at a point stands.
Vec3 load_position(const pbrt::LightEntity& light, const Vec3& from) {
    const Vec3 position = light.world_from_light.point(from);
    require_near(light.place, fmt::format("LightSource \"{}\" stands", light.type), position);
    return position;
}

PointLight load_point(LoadContext& context, const pbrt::LightEntity& light) {
    const pbrt::ParameterSet& p = light.parameters;
    const Rgb intensity = load_scaled(context, p, "I") * power_factor(p, 4 * pi);
    return {load_position(light, p.get_point3("from", {0, 0, 0})), intensity};
}

/// From a space whose z axis is `axis` to the space around.
Transform turned_to(const Vec3& axis) {
    const Frame frame = Frame::from_z(axis);
    const Transform::Matrix m = {{frame.s.x, frame.t.x, frame.n.x, 0},
                                 {frame.s.y, frame.t.y, frame.n.y, 0},
                                 {frame.s.z, frame.t.z, frame.n.z, 0},
                                 {0, 0, 0, 1}};
    return Transform(m);
}

/// "falloff", beyond pbrt: whether the light of a spot is less in proportion to the angle.
bool load_linear_falloff(const pbrt::ParameterSet& p) {
    const std::string falloff = p.get_string("falloff", "smooth");
    if (falloff != "smooth" && falloff != "linear") {
        throw InputError(p.place_of("falloff"),
                         fmt::format("the falloff \"{}\" is unknown; known are smooth, linear", falloff));
    }
    return falloff == "linear";
}

/// "coneangle", "conedeltaangle", "falloff".
EmissionProfile load_cone(const pbrt::ParameterSet& p) {
    const float outer = p.get_float("coneangle", 30), rim = p.get_float("conedeltaangle", 5);
    if (!(outer > 0 && outer <= 180)) {
        throw InputError(p.place_of("coneangle"),
                         fmt::format("\"coneangle\" must lie between 0 and 180 degrees, not {}", outer));
    }
    if (!(rim >= 0) || !std::isfinite(rim)) {
        throw InputError(p.place_of("conedeltaangle"), "\"conedeltaangle\" must be finite and not negative");
    }
    const auto cos_degrees = [](float degrees) { return std::cos(degrees * pi / 180); };
    EmissionProfile cone;
    cone.cos_outer = cos_degrees(outer);
    cone.cos_inner = cos_degrees(std::max(outer - rim, 0.0f));
    cone.is_linear = load_linear_falloff(p);
    return cone;
}

/// "spread": of all that leaves, how wide it fans out, in degrees.
EmissionProfile load_slats(const pbrt::ParameterSet& p) {
    // Narrower, a beam is all but parallel, and connections to it are all but dark.
    constexpr float narrowest = 0.5f;
    const float spread = p.get_float("spread", 180);
    if (!(spread >= narrowest && spread < 180)) {
        throw InputError(p.place_of("spread"),
                         fmt::format("\"spread\" must be from {} to less than 180 degrees, not {}", narrowest, spread));
    }
    EmissionProfile slats;
    slats.kind = EmissionProfile::Kind::slats;
    slats.half_angle = spread / 2 * pi / 180;
    return slats;
}

std::optional<EmissionProfile> load_profile(const pbrt::ParameterSet& p) {
    if (p.has("coneangle") && p.has("spread")) {
        throw InputError(p.place_of("spread"), "an area light takes either \"coneangle\" or \"spread\"");
    }
    return p.has("coneangle") ? std::optional(load_cone(p))
           : p.has("spread")  ? std::optional(load_slats(p))
                              : std::nullopt;
}

SpotLight load_spot(LoadContext& context, const pbrt::LightEntity& light) {
    const pbrt::ParameterSet& p = light.parameters;
    const Vec3 from = p.get_point3("from", {0, 0, 0}), to = p.get_point3("to", {0, 0, 1});
    if (!is_finite(to - from) || !(length_squared(to - from) > 0)) {
        throw InputError(p.place_of("to"), "a spot light shines from \"from\" to \"to\", which must differ");
    }
    const EmissionProfile cone = load_cone(p);
    SpotLight spot;
    spot.position = load_position(light, from);
    spot.light_from_world = AffineMap((light.world_from_light * turned_to(normalize(to - from))).inverse());
    spot.cos_outer = cone.cos_outer;
    spot.cos_inner = cone.cos_inner;
    spot.is_linear = cone.is_linear;
    spot.intensity = load_scaled(context, p, "I") * power_factor(p, spread(spot));
    return spot;
}

GoniometricLight load_goniometric(LoadContext& context, TextureLoader& textures, const pbrt::LightEntity& light) {
    Image image = load_picture(context, textures, light);
    require_square(image, light);
    if (!light.parameters.get_bool("coloured", false)) {
        for (Rgb& pixel : image.pixels) {
            pixel = Rgb(mean(pixel));
        }
    }
    GoniometricLight source;
    source.position = load_position(light, {0, 0, 0});
    // The picture's pole is along y.
    const Transform::Matrix y_is_up = {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    source.light_from_world = AffineMap((light.world_from_light * Transform(y_is_up)).inverse());
    source.picture = std::make_shared<const LightPicture>(std::move(image));
    source.intensity =
        load_scaled(context, light.parameters, "I") * power_factor(light.parameters, mean(spread(source)));
    return source;
}

/// "profile", beyond pbrt: whether a wall across the beam is lit evenly, and not a sphere.
bool load_even_profile(const pbrt::ParameterSet& p) {
    const std::string profile = p.get_string("profile", "sphere");
    if (profile != "sphere" && profile != "plane") {
        throw InputError(p.place_of("profile"),
                         fmt::format("the profile \"{}\" is unknown; known are sphere, plane", profile));
    }
    return profile == "plane";
}

/// "fovaxis", beyond pbrt: whether a field of view is that of the width, and not of the shorter side.
bool load_fov_axis(const pbrt::ParameterSet& p) {
    const std::string axis = p.get_string("fovaxis", "shorter");
    if (axis != "shorter" && axis != "x") {
        throw InputError(p.place_of("fovaxis"), fmt::format("the axis \"{}\" is unknown; known are shorter, x", axis));
    }
    return axis == "x";
}

ProjectionLight load_projection(LoadContext& context, TextureLoader& textures, const pbrt::LightEntity& light) {
    const pbrt::ParameterSet& p = light.parameters;
    const float fov = p.get_float("fov", 90);
    if (!(fov > 0 && fov < 180)) {
        throw InputError(p.place_of("fov"), fmt::format("\"fov\" must lie between 0 and 180 degrees, not {}", fov));
    }
    ProjectionLight projector;
    projector.picture = std::make_shared<const LightPicture>(refined(load_picture(context, textures, light), p));
    projector.position = load_position(light, {0, 0, 0});
    // The first row is on top.
    projector.light_from_world = AffineMap((light.world_from_light * Transform::scale(1, -1, 1)).inverse());
    const Image& image = projector.picture->image();
    const float aspect = static_cast<float>(image.width) / static_cast<float>(image.height);
    const bool is_of_width = load_fov_axis(p);
    projector.half_size =
        (is_of_width ? Vec2(1, 1 / aspect) : Vec2(std::max(aspect, 1.0f), std::max(1 / aspect, 1.0f))) *
        std::tan(0.5f * fov * pi / 180);
    projector.lights_plane_evenly = load_even_profile(p);
    if (p.has("coneangle")) {
        const EmissionProfile cone = load_cone(p);
        if (!(cone.cos_outer > 1e-3f)) {
            throw InputError(p.place_of("coneangle"), "the cone of a projected picture is narrower than 90 degrees");
        }
        projector.cone = ProjectionLight::Cone{cone.cos_inner, cone.cos_outer, cone.is_linear};
        const float half = std::sqrt(1 - sqr(cone.cos_outer)) / cone.cos_outer;
        projector.half_size = Vec2(half, half);
    }
    const Rgb full = p.has("I") ? load_scaled(context, p, "I") : Rgb(non_negative_float(p, "scale", 1));
    projector.intensity = full * power_factor(p, luminance(spread(projector)));
    return projector;
}

/// A direction, or a disk of the sky where it has an angle: then what is given is the irradiance on a facing surface as
/// well.
Light load_distant(LoadContext& context, const pbrt::LightEntity& light) {
    const pbrt::ParameterSet& p = light.parameters;
    const Vec3 from = p.get_point3("from", {0, 0, 0});
    const Vec3 to = p.get_point3("to", {0, 0, 1});
    const Vec3 direction = light.world_from_light.vector(from - to);
    if (!is_finite(direction) || !(length_squared(direction) > 0)) {
        throw InputError(p.place_of("to"), "a distant light shines from \"from\" to \"to\", which must differ");
    }
    Rgb radiance = load_scaled(context, p, "L");
    if (const float illuminance = load_target(p, "illuminance"); illuminance > 0) {
        radiance *= illuminance;
    }
    const float angle = p.get_float("angle", 0);
    if (!(angle >= 0 && angle <= 180)) {
        throw InputError(p.place_of("angle"),
                         fmt::format("\"angle\" must lie between 0 and 180 degrees, not {}", angle));
    }
    const double half = double{angle} / 2 * std::numbers::pi / 180;
    const double sine = std::sin(half), one_minus_cosine = 2 * std::pow(std::sin(half / 2), 2);
    // Below, single precision does not tell one direction of the disk from another.
    constexpr double smallest_half = 1e-5;
    if (half < smallest_half) {
        return DistantLight{normalize(direction), radiance};
    }
    return SkyDiskLight{normalize(direction), radiance / static_cast<float>(std::numbers::pi * sine * sine),
                        static_cast<float>(one_minus_cosine)};
}

bool is_dark(const Light& light) {
    struct Dark {
        bool operator()(const PointLight& l) const { return is_black(l.intensity); }
        bool operator()(const ImageInfiniteLight& l) const { return is_black(l.mean_radiance()); }
        bool operator()(const DistantLight& l) const { return is_black(l.radiance); }
        bool operator()(const UniformInfiniteLight& l) const { return is_black(l.radiance); }
        bool operator()(const SkyDiskLight& l) const { return is_black(l.radiance); }
        bool operator()(const TriangleLight& l) const { return is_black(l.radiance); }
        bool operator()(const QuadricLight& l) const { return is_black(l.radiance); }
        bool operator()(const SpotLight& l) const { return is_black(l.intensity); }
        bool operator()(const GoniometricLight& l) const { return !(light_power(l, 0) > 0); }
        bool operator()(const ProjectionLight& l) const { return !(light_power(l, 0) > 0); }
        bool operator()(const PortalInfiniteLight& l) const { return is_black(l.portal->power()); }
        bool operator()(const MediumLight& l) const { return !(l.grid->glow()->power() > 0); }
    };
    return std::visit(Dark{}, light);
}

}  // namespace

std::optional<Light> load_light(LoadContext& context, TextureLoader& textures, const pbrt::LightEntity& light) {
    const auto load = [&]() -> Light {
        if (light.type == "point") {
            return load_point(context, light);
        }
        if (light.type == "distant") {
            return load_distant(context, light);
        }
        if (light.type == "infinite") {
            return load_infinite(context, textures, light);
        }
        if (light.type == "spot") {
            return load_spot(context, light);
        }
        if (light.type == "goniometric") {
            return load_goniometric(context, textures, light);
        }
        if (light.type == "projection") {
            return load_projection(context, textures, light);
        }
        refuse_type("LightSource", light, {"distant", "goniometric", "infinite", "point", "projection", "spot"});
    };
    Light loaded = load();
    context.warnings.add_unused("LightSource", light);
    return is_dark(loaded) ? std::nullopt : std::optional(std::move(loaded));
}

AreaLight load_area_light(LoadContext& context, TextureLoader& textures, const pbrt::Entity& light) {
    if (light.type != "diffuse") {
        refuse_type("AreaLightSource", light, {"diffuse"});
    }
    const pbrt::ParameterSet& p = light.parameters;
    AreaLight result;
    result.radiance = load_scaled(context, p, "L");
    if (p.has("filename")) {
        if (p.has("L")) {
            throw InputError(p.place_of("L"), "an area light takes either \"L\" or \"filename\"");
        }
        Image image = refined(load_picture(context, textures, light), p);
        result.picture =
            std::make_shared<const LightPicture>(is_from_top(p, "origin") ? upside_down(image) : std::move(image));
    }
    result.power = load_target(p, "power");
    result.two_sided = p.get_bool("twosided", false);
    result.is_solid = p.get_bool("solid", true);
    result.is_once = p.get_bool("alphaonce", false);
    result.profile = load_profile(p);
    context.warnings.add_unused("AreaLightSource", light);
    return result;
}

}  // namespace wend
