#include <wend/io/load/camera_film.h>

#include <wend/io/load/lenses.h>
#include <wend/io/load/panoramas.h>
#include <wend/io/load/reach.h>
#include <wend/io/spectrum/colour_space.h>
#include <wend/io/spectrum/white_balance.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

// The most that filters and samples per pixel can sensibly be asked for: beyond, a number is a mistake.
constexpr float largest_filter_radius = 1000;

/// `count` numbers, or none where the parameter is absent or has another number of them.
template <class Numbers>
Numbers exactly(LoadContext& context, const pbrt::ParameterSet& parameters, std::string_view name, Numbers values,
                std::size_t count) {
    if (!values.empty() && values.size() != count) {
        context.warnings.add(
            parameters.place_of(name),
            fmt::format("\"{}\" takes {} values, not {}: it is ignored, as by pbrt", name, count, values.size()));
        return {};
    }
    return values;
}

PixelRect clamp_to(const PixelRect& rect, const Vec2i& resolution) {
    return {{std::max(rect.min.x, 0), std::max(rect.min.y, 0)},
            {std::min(rect.max.x, resolution.x), std::min(rect.max.y, resolution.y)}};
}

PixelRect load_pixel_bounds(const pbrt::ParameterSet& parameters, const std::vector<int>& bounds, const Vec2i& in_file,
                            const Vec2i& resolution) {
    const auto scaled = [](int value, int from, int to) {
        const double v = std::round(static_cast<double>(value) * to / from);
        return static_cast<int>(std::clamp(v, -1e9, 1e9));
    };
    const PixelRect rect =
        clamp_to({{scaled(bounds[0], in_file.x, resolution.x), scaled(bounds[2], in_file.y, resolution.y)},
                  {scaled(bounds[1], in_file.x, resolution.x), scaled(bounds[3], in_file.y, resolution.y)}},
                 resolution);
    if (rect.width() <= 0 || rect.height() <= 0) {
        throw InputError(parameters.place_of("pixelbounds"), "\"pixelbounds\" holds no pixel of the picture");
    }
    return rect;
}

PixelRect load_crop_window(const pbrt::ParameterSet& parameters, const std::vector<float>& window,
                           const Vec2i& resolution) {
    const auto [x0, x1] = std::minmax(window[0], window[1]);
    const auto [y0, y1] = std::minmax(window[2], window[3]);
    const auto pixel = [](float fraction, int size) {
        return static_cast<int>(std::ceil(std::clamp(fraction, 0.0f, 1.0f) * static_cast<float>(size)));
    };
    const PixelRect rect{{pixel(x0, resolution.x), pixel(y0, resolution.y)},
                         {pixel(x1, resolution.x), pixel(y1, resolution.y)}};
    if (rect.width() <= 0 || rect.height() <= 0) {
        throw InputError(parameters.place_of("cropwindow"), "\"cropwindow\" holds no pixel of the picture");
    }
    return rect;
}

float load_aspect(const pbrt::ParameterSet& parameters, const Vec2i& resolution) {
    return positive_float(parameters, "frameaspectratio",
                          static_cast<float>(resolution.x) / static_cast<float>(resolution.y));
}

/// The file's own, if there is one.
std::optional<ScreenWindow> load_screen_window(LoadContext& context, const pbrt::ParameterSet& parameters) {
    const std::vector<float> window =
        exactly(context, parameters, "screenwindow", parameters.get_floats("screenwindow"), 4);
    if (window.empty()) {
        return std::nullopt;
    }
    const bool finite = std::all_of(window.begin(), window.end(), [](float v) { return std::isfinite(v); });
    if (!finite || window[0] == window[1] || window[2] == window[3]) {
        throw InputError(parameters.place_of("screenwindow"), "\"screenwindow\" is empty");
    }
    return ScreenWindow{window[0], window[1], window[2], window[3]};
}

/// The shorter side is from -1 to 1.
ScreenWindow screen_window_of(float aspect) {
    const float x = std::max(aspect, 1.0f);
    const float y = std::max(1 / aspect, 1.0f);
    return {-x, x, -y, y};
}

/// What a pinhole is focused on does not matter, be it 0.
float load_focal_distance(const pbrt::ParameterSet& parameters, float lens_radius) {
    constexpr float far_away = 1e6f;
    if (lens_radius > 0) {
        return positive_float(parameters, "focaldistance", far_away);
    }
    static_cast<void>(parameters.get_float("focaldistance", far_away));
    return far_away;
}

PerspectiveCamera load_perspective(const pbrt::ParameterSet& parameters, const ScreenWindow& screen) {
    const float fov = parameters.get_float("fov", 90);
    if (!(fov > 0 && fov < 180)) {
        throw InputError(parameters.place_of("fov"),
                         fmt::format("\"fov\" must lie between 0 and 180 degrees, not {}", fov));
    }
    const float scale = std::tan(0.5f * fov * pi / 180);
    const float lens_radius = non_negative_float(parameters, "lensradius", 0);
    return {{screen.x_min * scale, screen.x_max * scale, screen.y_min * scale, screen.y_max * scale},
            lens_radius,
            load_focal_distance(parameters, lens_radius)};
}

SphericalCamera load_spherical(const pbrt::ParameterSet& parameters) {
    const std::string mapping = parameters.get_string("mapping", "equalarea");
    if (mapping == "equalarea") {
        return {SphericalCamera::Mapping::equal_area};
    }
    if (mapping == "equirectangular") {
        return {SphericalCamera::Mapping::equirectangular};
    }
    throw InputError(parameters.place_of("mapping"),
                     fmt::format("the mapping \"{}\" is unknown; known are equalarea, equirectangular", mapping));
}

int positive_int(const pbrt::ParameterSet& parameters, std::string_view name, int fallback) {
    const int value = parameters.get_int(name, fallback);
    if (value < 1) {
        throw InputError(parameters.place_of(name), fmt::format("\"{}\" must be at least 1, not {}", name, value));
    }
    return value;
}

/// By "sensor", "whitebalance" and the colour space. A measured sensor has a white even where the file gives it none.
ColourMatrix load_balance(LoadContext& context, const pbrt::ParameterSet& parameters) {
    constexpr float white_of_sensors = 6500;
    const std::string sensor = parameters.get_string("sensor", "cie1931");
    const bool is_measured = sensor != "cie1931";
    if (is_measured && sensor != "nikon_d850") {
        context.warnings.add(parameters.place_of("sensor"),
                             fmt::format("the colours of the sensor \"{}\" are not known: those of \"nikon_d850\" "
                                         "take their place",
                                         sensor));
    }
    const float given = parameters.get_float("whitebalance", 0);
    const float temperature = given == 0 && is_measured ? white_of_sensors : given;
    const ColourMatrix in_space = rec709_from(parameters.colour_space(), temperature != 0).inverse();
    if (temperature == 0) {
        return in_space;
    }
    try {
        return in_space * (is_measured ? sensor_balance(double{temperature}) : white_balance(double{temperature}));
    } catch (const InputError& error) {
        throw InputError(parameters.place_of("whitebalance"), error.what());
    }
}

/// Says what a film of pbrt's holds that ours does not, and asks for what only it has.
void replace_film(LoadContext& context, const pbrt::Entity& film) {
    const pbrt::ParameterSet& p = film.parameters;
    std::string_view lost =
        "albedo, normals and variance have other names unless --layer-names pbrt is given, positions are there with "
        "--layers geometry, and slopes are not";
    if (film.type == "spectral") {
        lost = "the picture has colours, and no layers by wavelength";
        static_cast<void>(p.get_int("nbuckets", 16));
        static_cast<void>(p.get_float("lambdamin", 360));
        static_cast<void>(p.get_float("lambdamax", 830));
    } else {
        static_cast<void>(p.get_string("coordinatesystem", "camera"));
    }
    context.warnings.add(film.place,
                         fmt::format("Film \"{}\" is not implemented: \"rgb\" takes its place; {}", film.type, lost));
}

}  // namespace

FilmSettings load_film(LoadContext& context, const pbrt::Entity& film, const std::optional<Vec2i>& resolution) {
    const pbrt::ParameterSet& p = film.parameters;
    if (film.type == "gbuffer" || film.type == "spectral") {
        replace_film(context, film);
    } else if (film.type != "rgb") {
        refuse_type("Film", film, {"rgb", "gbuffer", "spectral"});
    }
    FilmSettings settings;
    const Vec2i in_file{positive_int(p, "xresolution", 1280), positive_int(p, "yresolution", 720)};
    settings.resolution = resolution.value_or(in_file);
    if (std::int64_t{settings.resolution.x} * settings.resolution.y > Film::max_pixels) {
        throw InputError(resolution ? film.place : p.place_of("xresolution"),
                         fmt::format("a picture of {} x {} pixels is too large: the most is {} pixels",
                                     settings.resolution.x, settings.resolution.y, Film::max_pixels));
    }
    settings.crop = {{0, 0}, settings.resolution};
    const auto bounds = exactly(context, p, "pixelbounds", p.get_ints("pixelbounds"), 4);
    const auto window = exactly(context, p, "cropwindow", p.get_floats("cropwindow"), 4);
    if (!window.empty()) {
        settings.crop = load_crop_window(p, window, settings.resolution);
    } else if (!bounds.empty()) {
        settings.crop = load_pixel_bounds(p, bounds, in_file, settings.resolution);
    }
    settings.file = p.get_string("filename", "pbrt.exr");
    settings.diagonal = positive_float(p, "diagonal", 35) / 1000;
    settings.sensitivity = positive_float(p, "iso", 100) / 100;
    settings.balance = load_balance(context, p);
    settings.colour_space = p.colour_space();
    if (p.has("maxcomponentvalue")) {
        static_cast<void>(p.get_float("maxcomponentvalue", 0));
        context.warnings.add(p.place_of("maxcomponentvalue"),
                             "\"maxcomponentvalue\" is ignored: clamping would darken the picture");
    }
    // These change neither what is rendered nor what is written here: files hold 32-bit floats.
    static_cast<void>(p.get_bool("savefp16", true));
    context.warnings.add_unused("Film", film);
    return settings;
}

Camera load_camera(LoadContext& context, const pbrt::CameraEntity& camera, const pbrt::TransformTimes& times,
                   const FilmSettings& film) {
    const pbrt::ParameterSet& p = camera.parameters;
    const Vec2i resolution = film.resolution;
    const float aspect = load_aspect(p, resolution);
    const std::optional<ScreenWindow> window = load_screen_window(context, p);
    const ScreenWindow screen = window.value_or(screen_window_of(aspect));
    Camera::Kind kind;
    if (camera.type == "perspective") {
        kind = load_perspective(p, screen);
    } else if (camera.type == "orthographic") {
        const float lens_radius = non_negative_float(p, "lensradius", 0);
        kind = OrthographicCamera{screen, lens_radius, load_focal_distance(p, lens_radius)};
    } else if (camera.type == "spherical") {
        kind = load_spherical(p);
    } else if (camera.type == "panorama") {
        kind = PanoramicCamera{std::make_shared<const Panorama>(load_panorama(p, window, aspect))};
    } else if (camera.type == "realistic") {
        const float width = static_cast<float>(resolution.x), height = static_cast<float>(resolution.y);
        kind = load_realistic(context, camera, Vec2(width, height) * (film.diagonal / std::hypot(width, height)));
    } else {
        refuse_type("Camera", camera, {"perspective", "orthographic", "panorama", "spherical", "realistic"});
    }
    static_cast<void>(shutter_time(camera));
    context.warnings.add_unused("Camera", camera);
    for (std::size_t i = 0; i < camera.world_from_camera.key_count(); ++i) {
        require_near(camera.place, "the camera stands", camera.world_from_camera.key(i).point({0, 0, 0}));
    }
    const Shutter shutter{p.get_float("shutteropen", 0), p.get_float("shutterclose", 1), times.start, times.end};
    return Camera(kind, camera.world_from_camera, resolution.x, resolution.y, shutter);
}

float shutter_time(const pbrt::CameraEntity& camera) {
    const pbrt::ParameterSet& p = camera.parameters;
    const float time = p.get_float("shutterclose", 1) - p.get_float("shutteropen", 0);
    if (!(time > 0) || !std::isfinite(time)) {
        throw InputError(p.place_of("shutterclose"), "the shutter must close after it opens");
    }
    return time;
}

Filter load_filter(LoadContext& context, const pbrt::Entity& filter) {
    const pbrt::ParameterSet& p = filter.parameters;
    const auto radius = [&](std::string_view name, float fallback) {
        const float r = positive_float(p, name, fallback);
        if (r > largest_filter_radius) {
            throw InputError(p.place_of(name),
                             fmt::format("\"{}\" must not exceed {} pixels", name, largest_filter_radius));
        }
        return r;
    };
    const auto make = [&]() -> Filter {
        if (filter.type == "box") {
            return Filter::box(radius("xradius", 0.5f), radius("yradius", 0.5f));
        }
        if (filter.type == "triangle") {
            return Filter::triangle(radius("xradius", 2), radius("yradius", 2));
        }
        if (filter.type == "gaussian") {
            return Filter::gaussian(radius("xradius", 1.5f), radius("yradius", 1.5f), positive_float(p, "sigma", 0.5f));
        }
        if (filter.type == "mitchell") {
            const float b = p.get_float("B", 1.0f / 3);
            const float c = p.get_float("C", 1.0f / 3);
            if (!std::isfinite(b) || !std::isfinite(c)) {
                throw InputError(filter.place, "\"B\" and \"C\" must be finite");
            }
            return Filter::mitchell(radius("xradius", 2), radius("yradius", 2), b, c);
        }
        if (filter.type == "sinc") {
            return Filter::sinc(radius("xradius", 4), radius("yradius", 4), positive_float(p, "tau", 3));
        }
        refuse_type("PixelFilter", filter, {"box", "gaussian", "mitchell", "sinc", "triangle"});
    };
    Filter result = make();
    context.warnings.add_unused("PixelFilter", filter);
    return result;
}

SamplerSettings load_sampler(LoadContext& context, const pbrt::Entity& sampler, const pbrt::ParameterSet& options) {
    const pbrt::ParameterSet& p = sampler.parameters;
    SamplerSettings settings;
    if (sampler.type == "independent") {
        settings.kind = SamplerKind::independent;
    } else if (sampler.type == "stratified") {
        const std::int64_t samples = std::int64_t{positive_int(p, "xsamples", 4)} * positive_int(p, "ysamples", 4);
        settings.samples = static_cast<int>(std::min<std::int64_t>(samples, 1 << 30));
    } else if (sampler.type != "halton" && sampler.type != "paddedsobol" && sampler.type != "pmj02bn" &&
               sampler.type != "sobol" && sampler.type != "zsobol") {
        refuse_type("Sampler", sampler,
                    {"halton", "independent", "paddedsobol", "pmj02bn", "sobol", "stratified", "zsobol"});
    }
    if (sampler.type != "stratified") {
        settings.samples = positive_int(p, "pixelsamples", 16);
    }
    settings.seed = static_cast<std::uint32_t>(p.get_int("seed", options.get_int("seed", 0)));
    // How points are scrambled or jittered is the sampler's own affair here.
    static_cast<void>(p.get_string("randomization", ""));
    static_cast<void>(p.get_bool("jitter", true));
    context.warnings.add_unused("Sampler", sampler);
    return settings;
}

IntegratorSettings load_integrator(LoadContext& context, const pbrt::Entity& integrator) {
    const pbrt::ParameterSet& p = integrator.parameters;
    constexpr std::string_view walks[] = {"path", "randomwalk", "simplepath", "simplevolpath", "volpath"};
    constexpr std::string_view surfaces_alone[] = {"path", "randomwalk", "simplepath"};
    constexpr std::string_view others[] = {"ambientocclusion", "bdpt", "function", "lightpath", "mlt", "sppm"};
    if (std::count(std::begin(others), std::end(others), integrator.type) > 0) {
        context.warnings.add(
            integrator.place,
            fmt::format("Integrator \"{}\" is not implemented: \"volpath\" takes its place", integrator.type));
    } else if (std::count(std::begin(walks), std::end(walks), integrator.type) == 0) {
        refuse_type("Integrator", integrator,
                    {"ambientocclusion", "bdpt", "function", "lightpath", "mlt", "path", "randomwalk", "simplepath",
                     "simplevolpath", "sppm", "volpath"});
    }
    IntegratorSettings settings;
    settings.sees_media = std::count(std::begin(surfaces_alone), std::end(surfaces_alone), integrator.type) == 0;
    settings.max_depth = p.get_int("maxdepth", 5);
    if (settings.max_depth < 0) {
        throw InputError(p.place_of("maxdepth"),
                         fmt::format("\"maxdepth\" must not be below 0, but is {}", settings.max_depth));
    }
    const std::string lights = p.get_string("lightsampler", "bvh");
    settings.light_tree = lights == "bvh";
    if (lights == "uniform" || lights == "exhaustive") {
        context.warnings.add(
            p.place_of("lightsampler"),
            fmt::format("the light sampler \"{}\" is not implemented: \"power\" takes its place", lights));
    } else if (lights != "bvh" && lights != "power") {
        throw InputError(
            p.place_of("lightsampler"),
            fmt::format("the light sampler \"{}\" is unknown; known are bvh, power, uniform, exhaustive", lights));
    }
    if (p.get_bool("regularize", false)) {
        context.warnings.add(p.place_of("regularize"),
                             "\"regularize\" is ignored: rougher materials would bias the picture");
    }
    context.warnings.add_unused("Integrator", integrator);
    return settings;
}

}  // namespace wend
