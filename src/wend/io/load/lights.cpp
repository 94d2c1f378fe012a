#include <wend/io/load/colours.h>
#include <wend/io/load/lights.h>
#include <wend/io/load/reach.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace wend {
namespace {

/// pbrt's "power" and "illuminance": 0 where the parameter is absent or not positive, which pbrt takes for absent.
float load_target(const pbrt::ParameterSet& p, std::string_view name) {
    const float value = p.get_float(name, 0);
    if (!std::isfinite(value)) {
        throw InputError(p.place_of(name), fmt::format("\"{}\" must be finite", name));
    }
    return std::max(value, 0.0f);
}

/// A colour parameter times "scale"; white where it is absent.
Rgb load_scaled(LoadContext& context, const pbrt::ParameterSet& p, std::string_view name) {
    return get_colour(context, p, name, SpectrumKind::illuminant).value_or(Rgb(1.0f)) *
           non_negative_float(p, "scale", 1);
}

Rgb mean_colour(const Image& image) {
    Rgb sum;
    for (const Rgb& pixel : image.pixels) {
        sum += pixel;
    }
    return sum / static_cast<float>(image.pixels.size());
}

std::shared_ptr<const Image> load_picture(LoadContext& context, TextureLoader& textures, const pbrt::Entity& light) {
    return textures.picture(required_file(context, light, "filename"), "sRGB", light.place);
}

PointLight load_point(LoadContext& context, const pbrt::LightEntity& light, const Rgb& tint = Rgb(1.0f)) {
    const pbrt::ParameterSet& p = light.parameters;
    Rgb intensity = load_scaled(context, p, "I") * tint;
    if (const float power = load_target(p, "power"); power > 0) {
        intensity *= power * inv_4pi;
    }
    const Vec3 position = light.world_from_light.point(p.get_point3("from", {0, 0, 0}));
    require_near(light.place, fmt::format("LightSource \"{}\" stands", light.type), position);
    return {position, intensity};
}

/// Lights whose intensity depends on the direction shine as on their axis, or on average, into all directions.
PointLight replace_by_point(LoadContext& context, TextureLoader& textures, const pbrt::LightEntity& light) {
    context.warnings.add(light.place,
                         fmt::format("LightSource \"{}\" is not implemented: \"point\" takes its place", light.type));
    const Rgb tint =
        light.parameters.has("filename") ? mean_colour(*load_picture(context, textures, light)) : Rgb(1.0f);
    // The cone that is left out.
    static_cast<void>(light.parameters.get_point3("to", {0, 0, 1}));
    static_cast<void>(light.parameters.get_float("coneangle", 30));
    static_cast<void>(light.parameters.get_float("conedeltaangle", 5));
    static_cast<void>(light.parameters.get_float("fov", 90));
    return load_point(context, light, tint);
}

DistantLight load_distant(LoadContext& context, const pbrt::LightEntity& light) {
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
    return {normalize(direction), radiance};
}

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

Light load_sky_picture(LoadContext& context, TextureLoader& textures, const pbrt::LightEntity& light) {
    const pbrt::ParameterSet& p = light.parameters;
    Image image = *load_picture(context, textures, light);
    if (image.width != image.height) {
        throw InputError(
            p.place_of("filename"),
            fmt::format("the picture of an infinite light must be square (equal-area mapping), not {} x {}",
                        image.width, image.height));
    }
    for (Rgb& pixel : image.pixels) {
        if (!is_finite(pixel)) {
            throw InputError(p.place_of("filename"),
                             "the picture of the infinite light has a pixel that is not finite");
        }
        pixel = {std::max(pixel.r, 0.0f), std::max(pixel.g, 0.0f), std::max(pixel.b, 0.0f)};
    }
    float scale = non_negative_float(p, "scale", 1);
    if (const float illuminance = load_target(p, "illuminance"); illuminance > 0) {
        const float unscaled = illuminance_of(image);
        scale *= unscaled > 0 ? illuminance / unscaled : 0.0f;
    }
    return ImageInfiniteLight(std::move(image), scale, light.world_from_light);
}

Light load_infinite(LoadContext& context, TextureLoader& textures, const pbrt::LightEntity& light) {
    const pbrt::ParameterSet& p = light.parameters;
    if (p.has("portal")) {
        static_cast<void>(p.get_point3s("portal"));
        context.warnings.add(p.place_of("portal"), "portals are ignored: the infinite light shines from everywhere");
    }
    if (p.has("filename")) {
        if (p.has("L")) {
            throw InputError(p.place_of("L"), "an infinite light takes either \"L\" or \"filename\"");
        }
        return load_sky_picture(context, textures, light);
    }
    Rgb radiance = load_scaled(context, p, "L");
    if (const float illuminance = load_target(p, "illuminance"); illuminance > 0) {
        radiance *= illuminance * inv_pi;
    }
    return UniformInfiniteLight{radiance};
}

bool is_dark(const Light& light) {
    struct Dark {
        bool operator()(const PointLight& l) const { return is_black(l.intensity); }
        bool operator()(const ImageInfiniteLight& l) const { return is_black(l.mean_radiance()); }
        bool operator()(const DistantLight& l) const { return is_black(l.radiance); }
        bool operator()(const UniformInfiniteLight& l) const { return is_black(l.radiance); }
        bool operator()(const TriangleLight& l) const { return is_black(l.radiance); }
        bool operator()(const QuadricLight& l) const { return is_black(l.radiance); }
        bool operator()(const MediumLight& l) const { return !(l.grid->glow()->power() > 0); }
    };
    return std::visit(Dark{}, light);
}

/// Whether a triangle's normal must be reversed to lie on the side of its vertices' normals, or else as the surface
/// says.
bool flips(const Surface& surface, const TriangleMesh& mesh, std::size_t triangle) {
    if (mesh.normals.empty()) {
        return surface.flip_normal;
    }
    const std::uint32_t* i = &mesh.indices[3 * triangle];
    const Vec3 face = cross(mesh.positions[i[1]] - mesh.positions[i[0]], mesh.positions[i[2]] - mesh.positions[i[0]]);
    return dot(face, mesh.normals[i[0]] + mesh.normals[i[1]] + mesh.normals[i[2]]) < 0;
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
        if (light.type == "spot" || light.type == "goniometric" || light.type == "projection") {
            return replace_by_point(context, textures, light);
        }
        refuse_type("LightSource", light, {"distant", "goniometric", "infinite", "point", "projection", "spot"});
    };
    Light loaded = load();
    context.warnings.add_unused("LightSource", light);
    return is_dark(loaded) ? std::nullopt : std::optional(std::move(loaded));
}

Rgb AreaLight::radiance_of(float area) const {
    return power > 0 ? radiance * (power / (area * pi * (two_sided ? 2.0f : 1.0f))) : radiance;
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
        context.warnings.add(p.place_of("filename"), "the picture of an area light is replaced by its mean colour");
        result.radiance *= mean_colour(*load_picture(context, textures, light));
    }
    result.power = load_target(p, "power");
    result.two_sided = p.get_bool("twosided", false);
    context.warnings.add_unused("AreaLightSource", light);
    return result;
}

void attach(const AreaLight& light, const Transform& world_from_object, Surface& surface, std::vector<Light>& lights) {
    if (is_black(light.radiance)) {
        return;
    }
    surface.first_light = static_cast<int>(lights.size());
    if (const auto* quadric = std::get_if<Quadric>(&surface.shape)) {
        QuadricLight source = make_quadric_light(std::make_shared<const Quadric>(*quadric), world_from_object,
                                                 surface.flip_normal, light.radiance, light.two_sided);
        // Exact where the transform keeps shapes similar.
        source.radiance = light.radiance_of(source.object_area * std::cbrt(sqr(source.determinant)));
        lights.push_back(std::move(source));
        return;
    }
    const auto& mesh = std::get<TriangleMesh>(surface.shape);
    // Below, the area's inverse and its products leave the range of floats.
    constexpr float smallest_area = 1e-30f;
    for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
        TriangleLight source = make_triangle_light(mesh.vertex(i, 0), mesh.vertex(i, 1), mesh.vertex(i, 2),
                                                   flips(surface, mesh, i), light.radiance, light.two_sided);
        source.radiance = source.area > smallest_area ? light.radiance_of(source.area) : Rgb(0.0f);
        lights.push_back(std::move(source));
    }
}

}  // namespace wend
