#include <wend/io/mitsuba/sensor.h>

#include <wend/core/error.h>
#include <wend/core/vector.h>
#include <wend/io/mitsuba/directive.h>
#include <wend/io/mitsuba/media.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace wend::mitsuba {
namespace {

constexpr double degrees = 180 / 3.14159265358979323846;

struct FilmSize {
    int width, height;
    double aspect() const { return static_cast<double>(width) / height; }
};

int positive_integer(const Object& object, std::string_view name, int fallback) {
    const int value = object.integer(name, fallback);
    if (value < 1) {
        throw InputError(object.place_of(name), fmt::format("\"{}\" must be at least 1, not {}", name, value));
    }
    return value;
}

/// Half the width of what the sensor sees at distance 1.
double half_width(const Object& sensor, const FilmSize& film) {
    std::string axis = sensor.text("fov_axis", "x");
    double half = 0;
    if (sensor.has("focal_length")) {
        const std::string text = sensor.text("focal_length", "");
        const std::vector<double> numbers =
            numbers_of(text.substr(0, text.find("mm")), sensor.place_of("focal_length"));
        if (sensor.has("fov") || numbers.size() != 1 || !(numbers.front() > 0)) {
            throw InputError(sensor.place_of("focal_length"),
                             "a sensor takes either a \"fov\" or a \"focal_length\" such as \"50mm\"");
        }
        half = std::hypot(36.0, 24.0) / (2 * numbers.front());
        axis = "diagonal";
    } else {
        const double fov = sensor.number("fov", 0);
        if (!(fov > 0 && fov < 180)) {
            throw InputError(sensor.place_of("fov"),
                             fmt::format("{} needs a \"fov\" between 0 and 180 degrees", sensor.title()));
        }
        half = std::tan(fov / 2 / degrees);
    }
    const double aspect = film.aspect();
    if (axis == "x" || (axis == "smaller" && aspect <= 1) || (axis == "larger" && aspect > 1)) {
        return half;
    }
    if (axis == "y" || axis == "smaller" || axis == "larger") {
        return half * aspect;
    }
    if (axis == "diagonal") {
        return half / std::sqrt(1 + 1 / (aspect * aspect));
    }
    throw InputError(sensor.place_of("fov_axis"),
                     fmt::format("\"{}\" is no axis; known are x, y, diagonal, smaller, larger", axis));
}

void add_screen_window(Parameters& p, double half, double half_y, double shift_x, double shift_y) {
    const auto edge = [](double value) { return static_cast<float>(value); };
    p.add(
        pbrt::ParameterType::real, "screenwindow",
        std::vector<float>{edge(shift_x - half), edge(shift_x + half), edge(shift_y - half_y), edge(shift_y + half_y)});
}

void set_perspective(const Object& sensor, const FilmSize& film, Parameters& p) {
    const double half = half_width(sensor, film), half_y = half / film.aspect();
    const double x = sensor.number("principal_point_offset_x", 0), y = sensor.number("principal_point_offset_y", 0);
    if (x == 0 && y == 0) {
        p.real("fov", 2 * degrees * std::atan(std::min(half, half_y)));
    } else {
        p.real("fov", 90);
        add_screen_window(p, half, half_y, 2 * x * half, -2 * y * half_y);
    }
    if (sensor.type() == "thinlens") {
        p.real("lensradius", sensor.non_negative("aperture_radius", 0));
        p.real("focaldistance", sensor.positive("focus_distance", 1e4));
    } else {
        sensor.ignore("focus_distance");
    }
}

/// A single ray, as the narrowest of views.
Transform set_radiancemeter(const Object& sensor, const FilmSize& film, Parameters& p) {
    if (film.width != 1 || film.height != 1) {
        throw InputError(sensor.place(), fmt::format("{} needs a film of 1 by 1 pixels", sensor.title()));
    }
    constexpr double narrow = 1e-3;
    p.real("fov", narrow);
    const std::optional<Vec3> origin = sensor.vector("origin"), direction = sensor.vector("direction");
    if (origin.has_value() != direction.has_value()) {
        throw InputError(sensor.place(),
                         fmt::format("{} takes both an \"origin\" and a \"direction\", or none", sensor.title()));
    }
    if (sensor.has("to_world") || !origin) {
        return sensor.transform("to_world");
    }
    if (!(length_squared(*direction) > 0)) {
        throw InputError(sensor.place_of("direction"), "a \"direction\" must not be 0");
    }
    const Frame frame = Frame::from_z(normalize(*direction));
    const Transform::Matrix turned = {{frame.s.x, frame.t.x, frame.n.x, origin->x},
                                      {frame.s.y, frame.t.y, frame.n.y, origin->y},
                                      {frame.s.z, frame.t.z, frame.n.z, origin->z},
                                      {0, 0, 0, 1}};
    return Transform(turned);
}

/// Those that measure what no camera of ours sees.
[[noreturn]] void refuse_sensor(const Object& sensor) {
    const std::string_view instead = sensor.type() == "distant" ? "an \"orthographic\" one looks along a direction"
                                     : sensor.type() == "irradiancemeter" ? "a \"radiancemeter\" measures one ray"
                                     : sensor.type() == "batch"           ? "give one of its sensors"
                                                                          : "";
    if (!instead.empty()) {
        throw InputError(sensor.place(), fmt::format("{} is not implemented: {}", sensor.title(), instead));
    }
    refuse_type(sensor, "orthographic, perspective, radiancemeter, thinlens");
}

void add_camera(Context& context, Media& media, const Object& sensor, const FilmSize& film) {
    const std::string_view type = sensor.type();
    Parameters p(sensor.place());
    Transform to_world;
    if (type == "radiancemeter") {
        to_world = set_radiancemeter(sensor, film, p);
    } else {
        to_world = sensor.transform("to_world");
    }
    if (type == "perspective" || type == "thinlens") {
        set_perspective(sensor, film, p);
    } else if (type == "orthographic") {
        add_screen_window(p, 1, 1 / film.aspect(), 0, 0);
    } else if (type != "radiancemeter") {
        refuse_sensor(sensor);
    }
    for (const char* name : {"near_clip", "far_clip"}) {
        if (sensor.has(name)) {
            sensor.ignore(name);
            context.warn(sensor.place_of(name), fmt::format("\"{}\" is ignored: nothing is cut off", name));
        }
    }
    sensor.ignore("shutter_open");
    sensor.ignore("shutter_close");
    const Element* medium = sensor.nested_one("medium");
    const std::string around = medium ? media.name_of(*medium) : std::string();
    // The sensor's x axis points to the left.
    const Transform world_from_camera = to_world * Transform::scale(-1, 1, 1);
    in_block(context, world_from_camera.inverse(), sensor.place(), [&] {
        context.builder.medium_interface("", around, sensor.place());
        context.builder.camera(type == "orthographic" ? "orthographic" : "perspective", p.take(), sensor.place());
    });
}

void add_filter(Context& context, const Element* element, const pbrt::Location& film_place) {
    const auto add = [&](const char* type, double radius, Parameters p) {
        p.real("xradius", radius).real("yradius", radius);
        context.builder.pixel_filter(type, p.take(), element ? element->place : film_place);
    };
    if (!element) {
        return add("gaussian", 2, std::move(Parameters(film_place).real("sigma", 0.5)));
    }
    const Object filter(context, *element);
    Parameters p(filter.place());
    if (filter.type() == "box") {
        add("box", filter.positive("radius", 0.5), p);
    } else if (filter.type() == "tent") {
        add("triangle", filter.positive("radius", 1), p);
    } else if (filter.type() == "gaussian") {
        const double sigma = filter.positive("stddev", 0.5);
        add("gaussian", 4 * sigma, p.real("sigma", sigma));
    } else if (filter.type() == "mitchell") {
        add("mitchell", 2, p.real("B", filter.number("A", 1.0 / 3)).real("C", filter.number("B", 1.0 / 3)));
    } else if (filter.type() == "catmullrom") {
        add("mitchell", 2, p.real("B", 0).real("C", 0.5));
    } else if (filter.type() == "lanczos") {
        const int lobes = positive_integer(filter, "lobes", 3);
        add("sinc", lobes, p.real("tau", lobes));
    } else {
        refuse_type(filter, "box, catmullrom, gaussian, lanczos, mitchell, tent");
    }
    filter.warn_of_unused();
}

FilmSize add_film(Context& context, const Object& sensor, const std::string& picture) {
    const Element* element = sensor.nested_one("film");
    FilmSize size{768, 576};
    Parameters p(element ? element->place : sensor.place());
    const Element* filter = nullptr;
    if (element) {
        const Object film(context, *element);
        if (film.type() == "specfilm") {
            context.warn(film.place(), fmt::format("{} is for Mitsuba's spectral variants: \"hdrfilm\" takes its place",
                                                   film.title()));
            static_cast<void>(film.nested("spectrum"));
        } else if (film.type() != "hdrfilm" && film.type() != "ldrfilm" && film.type() != "mfilm") {
            refuse_type(film, "hdrfilm, specfilm");
        }
        size = {positive_integer(film, "width", size.width), positive_integer(film, "height", size.height)};
        const int left = film.integer("crop_offset_x", 0), top = film.integer("crop_offset_y", 0);
        const std::int64_t right = std::int64_t{left} + positive_integer(film, "crop_width", size.width);
        const std::int64_t bottom = std::int64_t{top} + positive_integer(film, "crop_height", size.height);
        if (film.has("crop_width") || film.has("crop_height") || left != 0 || top != 0) {
            if (left < 0 || top < 0 || right > size.width || bottom > size.height) {
                throw InputError(film.place_of("crop_width"), "the crop is not within the film");
            }
            p.add(pbrt::ParameterType::integer, "pixelbounds",
                  std::vector<int>{left, static_cast<int>(right), top, static_cast<int>(bottom)});
        }
        for (const char* name : {"file_format", "pixel_format", "component_format", "sample_border", "compensate",
                                 "banner", "high_quality_edges", "gamma"}) {
            film.ignore(name);
        }
        filter = film.nested_one("rfilter");
        film.warn_of_unused();
    }
    p.integer("xresolution", size.width).integer("yresolution", size.height).text("filename", picture);
    const pbrt::Location place = p.place();
    context.builder.film("rgb", p.take(), place);
    add_filter(context, filter, place);
    return size;
}

void add_sampler(Context& context, const Object& sensor) {
    const Element* element = sensor.nested_one("sampler");
    Parameters p(element ? element->place : sensor.place());
    const pbrt::Location place = p.place();
    std::string_view type = "zsobol";
    if (element) {
        const Object sampler(context, *element);
        type = sampler.type() == "independent" ? "independent" : "zsobol";
        p.integer("pixelsamples", positive_integer(sampler, "sample_count", 4))
            .integer("seed", sampler.integer("seed", 0));
        sampler.ignore("jitter");
        sampler.ignore("strength");
        sampler.warn_of_unused();
    } else {
        p.integer("pixelsamples", 4);
    }
    context.builder.sampler(std::string(type), p.take(), place);
}

}  // namespace

void add_sensor(Context& context, Media& media, const Element& element, const std::string& picture) {
    const Object sensor(context, element);
    const FilmSize film = add_film(context, sensor, picture);
    add_sampler(context, sensor);
    add_camera(context, media, sensor, film);
    sensor.warn_of_unused();
}

bool add_integrator(Context& context, const Element* element) {
    Parameters p(element ? element->place : pbrt::Location{});
    // Of pbrt's maxdepth: as many as there can be.
    constexpr int endless = std::numeric_limits<int>::max() - 1;
    std::string type = "path";
    int depth = -1;
    while (element) {
        const Object integrator(context, *element);
        // These write more than the picture, which another one inside of them makes.
        const Element* inner = integrator.nested_one("integrator");
        if (inner && (integrator.type() == "aov" || integrator.type() == "moment")) {
            context.warn(integrator.place(),
                         fmt::format("{}: the picture has layers of other names", integrator.title()));
            element = inner;
            continue;
        }
        constexpr std::string_view surfaces[] = {"path", "direct", "prb", "prb_basic"};
        constexpr std::string_view volumes[] = {"volpath", "volpathmis", "prbvolpath", "volpath_simple"};
        const bool is_surfaces =
            std::find(std::begin(surfaces), std::end(surfaces), integrator.type()) != std::end(surfaces);
        if (!is_surfaces && std::find(std::begin(volumes), std::end(volumes), integrator.type()) == std::end(volumes)) {
            context.warn(integrator.place(),
                         fmt::format("{} is not implemented: \"volpath\" takes its place", integrator.title()));
        }
        type = is_surfaces ? "path" : "volpath";
        depth = integrator.type() == "direct" ? 2 : integrator.integer("max_depth", -1);
        if (depth == 0 || depth < -1) {
            throw InputError(integrator.place_of("max_depth"),
                             fmt::format("\"max_depth\" is at least 1, or -1 for no limit, not {}", depth));
        }
        if (integrator.flag("hide_emitters", false)) {
            context.warn(integrator.place_of("hide_emitters"), "\"hide_emitters\" is ignored: lights are seen");
        }
        for (const char* name : {"rr_depth", "emitter_samples", "bsdf_samples", "shading_samples", "strict_normals",
                                 "use_spectral_mis", "samples_per_pass", "block_size", "timeout"}) {
            integrator.ignore(name);
        }
        integrator.warn_of_unused();
        break;
    }
    p.integer("maxdepth", depth < 0 ? endless : depth - 1);
    const pbrt::Location place = p.place();
    context.builder.integrator(type, p.take(), place);
    return type == "path";
}

}  // namespace wend::mitsuba
