#include <wend/io/mitsuba/emitters.h>

#include <wend/core/error.h>
#include <wend/io/mitsuba/directive.h>
#include <wend/io/mitsuba/spectra.h>
#include <wend/io/mitsuba/textures.h>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace wend::mitsuba {
namespace {

void add(const Object& emitter, const Transform& world_from_light, const char* type, Parameters& p) {
    in_block(emitter.context(), world_from_light, emitter.place(),
             [&] { emitter.context().builder.light_source(type, p.take(), emitter.place()); });
}

Rgb light_of(const Object& emitter, std::string_view name) {
    return colour_of(emitter, name, SpectrumUse::light, Rgb(1.0f));
}

void add_point(const Object& emitter) {
    Parameters p(emitter.place());
    p.colour("I", light_of(emitter, "intensity"));
    if (const std::optional<Vec3> position = emitter.vector("position")) {
        if (emitter.has("to_world")) {
            throw InputError(emitter.place_of("position"), "a light takes either a \"position\" or a \"to_world\"");
        }
        p.point("from", *position);
    }
    add(emitter, emitter.transform("to_world"), "point", p);
}

/// The picture that an emitter shines by.
void set_picture(const Object& bitmap, Parameters& p) {
    p.text("filename", bitmap.file("filename").string());
    if (bitmap.flag("raw", false)) {
        p.text("encoding", "raw");
    }
    // Where it is mirrored, its edges are as where it is clamped.
    const BitmapWays ways = ways_of_bitmap(bitmap);
    p.text("filter", ways.filter).text("wrap", ways.wrap == "repeat" ? "repeat" : "clamp");
    bitmap.ignore("format");
    bitmap.ignore("accel");
    bitmap.warn_of_unused();
}

/// The picture that a spot throws into the square around its cone: whether it has one.
bool set_thrown(const Object& emitter, double cutoff, Parameters& p) {
    const Element* texture = emitter.find("texture");
    if (!texture) {
        return false;
    }
    if (!is_texture(*texture) || texture->attribute("type") != "bitmap" || cutoff >= 89.9) {
        emitter.context().warn(emitter.place_of("texture"),
                               "the \"texture\" of a spot is ignored where it is no bitmap, "
                               "or the cone no narrower than 90 degrees");
        return false;
    }
    set_picture(Object(emitter.context(), *texture), p);
    return true;
}

void add_spot(const Object& emitter) {
    const double cutoff = emitter.number("cutoff_angle", 20);
    const double beam = emitter.number("beam_width", cutoff * 3 / 4);
    if (!(cutoff > 0 && cutoff <= 180 && beam >= 0 && beam <= cutoff)) {
        throw InputError(emitter.place_of("cutoff_angle"),
                         "the \"cutoff_angle\" must lie between 0 and 180 degrees, the \"beam_width\" within it");
    }
    Parameters p(emitter.place());
    p.colour("I", light_of(emitter, "intensity"))
        .real("coneangle", cutoff)
        .real("conedeltaangle", cutoff - beam)
        .text("falloff", "linear");
    const Transform to_world = emitter.transform("to_world");
    if (set_thrown(emitter, cutoff, p)) {
        // Its first row is where y is least.
        add(emitter, to_world * Transform::scale(1, -1, 1), "projection", p);
    } else {
        add(emitter, to_world, "spot", p);
    }
}

void add_directional(const Object& emitter) {
    Parameters p(emitter.place());
    p.colour("L", light_of(emitter, "irradiance")).point("from", {0, 0, 0});
    if (const std::optional<Vec3> direction = emitter.vector("direction")) {
        if (emitter.has("to_world")) {
            throw InputError(emitter.place_of("direction"), "a light takes either a \"direction\" or a \"to_world\"");
        }
        if (!(length_squared(*direction) > 0)) {
            throw InputError(emitter.place_of("direction"), "a \"direction\" must not be 0");
        }
        p.point("to", *direction);
    } else {
        p.point("to", {0, 0, 1});
    }
    add(emitter, emitter.transform("to_world"), "distant", p);
}

void add_constant(const Object& emitter) {
    Parameters p(emitter.place());
    p.colour("L", light_of(emitter, "radiance"));
    emitter.ignore("to_world");
    add(emitter, {}, "infinite", p);
}

void add_environment(const Object& emitter) {
    Parameters p(emitter.place());
    p.text("filename", emitter.file("filename").string())
        .text("mapping", "equirectangular")
        .flag("rowsatpoles", true)
        .real("scale", emitter.non_negative("scale", 1));
    emitter.ignore("mis_compensation");
    // Its middle is towards z, its left towards x, and its top towards y; of ours towards x, y and z.
    const Transform::Matrix m = {{0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, 0}, {0, 0, 0, 1}};
    add(emitter, emitter.transform("to_world") * Transform(m), "infinite", p);
}

/// `fov` is that of the picture's width.
void add_projector(const Object& emitter) {
    const Element* picture = emitter.find("irradiance");
    if (!picture || picture->attribute("type") != "bitmap") {
        throw InputError(emitter.place_of("irradiance"),
                         "a \"projector\" needs an \"irradiance\" of <texture type=\"bitmap\">");
    }
    const Object bitmap(emitter.context(), *picture);
    Parameters p(emitter.place());
    const double fov = emitter.number("fov", 0);
    if (!(fov > 0 && fov < 180) || emitter.text("fov_axis", "x") != "x") {
        throw InputError(emitter.place_of("fov"), "a \"projector\" needs a \"fov\" between 0 and 180 degrees, along x");
    }
    set_picture(bitmap, p);
    p.real("fov", fov)
        .text("fovaxis", "x")
        .text("profile", "plane")
        // As Mitsuba has it.
        .real("scale", double{pi} * emitter.non_negative("scale", 1));
    add(emitter, emitter.transform("to_world") * Transform::scale(-1, 1, 1), "projection", p);
}

struct Kind {
    std::string_view type;
    void (*add)(const Object&);
};
constexpr Kind kinds[] = {{"constant", add_constant}, {"directional", add_directional}, {"envmap", add_environment},
                          {"point", add_point},       {"projector", add_projector},     {"spot", add_spot}};

/// The picture of an area light, or its colour.
void set_radiance(const Object& emitter, Parameters& p) {
    const Element* radiance = emitter.find("radiance");
    if (!radiance || !is_texture(*radiance)) {
        p.colour("L", light_of(emitter, "radiance"));
        return;
    }
    const Object bitmap(emitter.context(), *radiance);
    if (bitmap.type() != "bitmap") {
        throw InputError(bitmap.place(), "the \"radiance\" of an area light may vary by a <texture type=\"bitmap\">");
    }
    set_picture(bitmap, p);
    p.text("origin", "top");
}

/// Of Mitsuba's own tables, which only Mitsuba can read.
void warn_of_sky(const Object& emitter) {
    const std::string file = emitter.place().file ? emitter.place().file->name : "SCENE.xml";
    emitter.context().warn(
        emitter.place(),
        fmt::format(
            "{} is not implemented: it is left out. {}", emitter.title(),
            emitter.type() == "sunsky"
                ? fmt::format("\"python -m wend.mitsuba_sky {} -o sky.exr\" (pip install wend mitsuba) writes it "
                              "as a picture, and says which <emitter type=\"envmap\"> and <emitter "
                              "type=\"directional\"> take its place",
                              file)
                : "An <emitter type=\"sunsky\"> of one hour can be made a picture: see \"python -m "
                  "wend.mitsuba_sky\""));
}

}  // namespace

void add_emitter(Context& context, const Element& element) {
    const Object emitter(context, element);
    const auto kind =
        std::find_if(std::begin(kinds), std::end(kinds), [&](const Kind& k) { return k.type == emitter.type(); });
    if (kind == std::end(kinds)) {
        if (emitter.type() != "sunsky" && emitter.type() != "timed_sunsky") {
            refuse_type(emitter, "constant, directional, envmap, point, projector, spot; on shapes: area");
        }
        warn_of_sky(emitter);
        return;
    }
    // What it stands in is where it is.
    static_cast<void>(emitter.nested("medium"));
    emitter.ignore("sampling_weight");
    kind->add(emitter);
    emitter.warn_of_unused();
}

void add_area_emitter(Context& context, const Element& element) {
    const Object emitter(context, element);
    if (emitter.type() != "area" && emitter.type() != "directionalarea") {
        refuse_type(emitter, "area, directionalarea");
    }
    Parameters p(emitter.place());
    set_radiance(emitter, p);
    if (emitter.type() == "directionalarea") {
        // Its "radiance" is the power of a unit of area. Connections to a narrower beam are all but dark.
        constexpr double degrees = 2;
        p.real("spread", degrees).real("scale", 1 / double{pi});
        context.warn(emitter.place(), fmt::format("{} shines along its normals alone: it fans out by {} degrees",
                                                  emitter.title(), degrees));
    }
    emitter.ignore("sampling_weight");
    static_cast<void>(emitter.nested("medium"));
    emitter.warn_of_unused();
    context.builder.area_light_source("diffuse", p.take(), emitter.place());
}

}  // namespace wend::mitsuba
