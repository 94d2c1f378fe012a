#include <wend/io/pbrt/version3.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace wend::pbrt {
namespace {

struct Name {
    std::string_view was, is;
};

/// What a name is called now; none if it is not among these.
std::optional<std::string_view> now(std::span<const Name> names, std::string_view was) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const Name& name) { return name.was == was; });
    return found == names.end() ? std::nullopt : std::optional(found->is);
}

constexpr Name samplers[] = {{"lowdiscrepancy", "paddedsobol"},
                             {"02sequence", "paddedsobol"},
                             {"maxmindist", "pmj02bn"},
                             {"random", "independent"}};

constexpr Name materials[] = {{"matte", "diffuse"},           {"plastic", "coateddiffuse"},
                              {"substrate", "coateddiffuse"}, {"uber", "coateddiffuse"},
                              {"glass", "dielectric"},        {"metal", "conductor"},
                              {"mirror", "conductor"},        {"disney", "diffuse"},
                              {"kdsubsurface", "subsurface"}, {"translucent", "diffusetransmission"}};

/// A number parameter at the place of another.
Parameter number_at(const Parameter& other, std::string name, float value) {
    return {ParameterType::real, std::move(name), other.place, other.colour_space, std::vector<float>{value}};
}

/// The channels of a colour that is given as such, if they are the same.
std::optional<float> grey(const Parameter& parameter) {
    const auto* numbers = std::get_if<std::vector<float>>(&parameter.values);
    if (parameter.type != ParameterType::rgb || numbers->size() != 3 || (*numbers)[0] != (*numbers)[1] ||
        (*numbers)[1] != (*numbers)[2]) {
        return std::nullopt;
    }
    return numbers->front();
}

bool is_black(const ParameterSet& parameters, std::string_view name) {
    for (const Parameter* parameter : parameters.all()) {
        if (parameter->name == name) {
            return grey(*parameter) == 0.0f;
        }
    }
    return false;
}

}  // namespace

void Version3::say(const Location& place, const std::string& text) const {
    warn_(place, "a part of pbrt-v3: " + text);
}

void Version3::rename_type(std::string& type, std::string_view is, const Location& place) const {
    say(place, fmt::format("\"{}\" is read as \"{}\"", type, is));
    type = is;
}

void Version3::rename(ParameterSet& parameters, std::string_view from, std::string_view to) const {
    if (parameters.has(from)) {
        say(parameters.place_of(from), fmt::format("\"{}\" is read as \"{}\"", from, to));
        parameters.rename(from, std::string(to));
    }
}

void Version3::drop(ParameterSet& parameters, std::string_view name) const {
    if (const auto dropped = parameters.remove(name)) {
        say(dropped->place, fmt::format("\"{}\" is not used", name));
    }
}

void Version3::grey_to_number(ParameterSet& parameters, std::string_view name) const {
    const auto type = parameters.type_of(name);
    if (!type || *type != ParameterType::rgb) {
        return;
    }
    const auto colour = parameters.remove(name);
    if (!colour) {
        return;
    }
    const std::optional<float> value = grey(*colour);
    if (!value) {
        throw InputError(colour->place,
                         fmt::format("a part of pbrt-v3: \"{}\" is a colour, and in pbrt-v4 a number", name));
    }
    say(colour->place, fmt::format("the colour \"{}\" is read as a number", name));
    parameters.add(number_at(*colour, std::string(name), *value));
}

void Version3::film(std::string& type, ParameterSet& parameters, const Location& place) const {
    if (type != "image") {
        return;
    }
    rename_type(type, "rgb", place);
    rename(parameters, "maxsampleluminance", "maxcomponentvalue");
    if (const auto scale = parameters.remove("scale"); scale && scale->type == ParameterType::real) {
        say(scale->place, "\"scale\" is read as \"iso\", which is 100 times as much");
        parameters.add(number_at(*scale, "iso", 100 * std::get<std::vector<float>>(scale->values).front()));
    }
}

void Version3::pixel_filter(const std::string& type, ParameterSet& parameters, const Location&) const {
    rename(parameters, "xwidth", "xradius");
    rename(parameters, "ywidth", "yradius");
    if (type != "gaussian") {
        return;
    }
    if (const auto alpha = parameters.remove("alpha"); alpha && alpha->type == ParameterType::real) {
        const float value = std::get<std::vector<float>>(alpha->values).front();
        if (!(value > 0)) {
            throw InputError(alpha->place, "a part of pbrt-v3: the \"alpha\" of a filter must be above 0");
        }
        say(alpha->place, "\"alpha\" is read as \"sigma\", 1 / sqrt(2 alpha)");
        parameters.add(number_at(*alpha, "sigma", 1 / std::sqrt(2 * value)));
    }
}

void Version3::sampler(std::string& type, const Location& place) const {
    if (const auto is = now(samplers, type)) {
        rename_type(type, *is, place);
    }
}

void Version3::integrator(std::string& type, ParameterSet& parameters, const Location& place) const {
    drop(parameters, "rrthreshold");
    if (parameters.type_of("lightsamplestrategy") == ParameterType::string &&
        parameters.get_string("lightsamplestrategy", "") == "spatial") {
        drop(parameters, "lightsamplestrategy");
    }
    if (type == "directlighting") {
        rename_type(type, "path", place);
        const Parameter at{ParameterType::integer, "maxdepth", place, ColourSpace::srgb, std::vector<int>{1}};
        parameters.add(at);
    }
}

void Version3::camera(std::string& type, ParameterSet& parameters, const Location& place) const {
    if (type == "environment") {
        rename_type(type, "spherical", place);
        parameters.add(
            {ParameterType::string, "mapping", place, ColourSpace::srgb, std::vector<std::string>{"equirectangular"}});
    }
}

void Version3::material(std::string& type, ParameterSet& parameters, const Location& place) const {
    rename(parameters, "bumpmap", "displacement");
    if (type == "mix" && parameters.has("namedmaterial1")) {
        grey_to_number(parameters, "amount");
        std::vector<std::string> names;
        // The share "amount" was that of the first.
        for (const char* name : {"namedmaterial2", "namedmaterial1"}) {
            names.push_back(parameters.get_string(name, ""));
            drop(parameters, name);
        }
        parameters.add({ParameterType::string, "materials", place, ColourSpace::srgb, std::move(names)});
        return;
    }
    const auto is = now(materials, type);
    if (!is) {
        return;
    }
    const std::string was = type;
    rename_type(type, *is, place);
    if (was == "uber" && parameters.has("opacity") && parameters.type_of("opacity") != ParameterType::rgb) {
        throw InputError(parameters.place_of("opacity"),
                         "a part of pbrt-v3: the opacity of \"uber\" has no like in "
                         "pbrt-v4; an \"alpha\" of the shape may stand for it");
    }
    if ((was == "plastic" || was == "uber") && is_black(parameters, "Ks")) {
        type = "diffuse";
        parameters.remove("roughness");
        parameters.remove("eta");
        parameters.remove("index");
    }
    if (was == "mirror") {
        parameters.add(
            {ParameterType::spectrum, "eta", place, ColourSpace::srgb, std::vector<std::string>{"metal-Ag-eta"}});
        parameters.add(
            {ParameterType::spectrum, "k", place, ColourSpace::srgb, std::vector<std::string>{"metal-Ag-k"}});
    }
    if (was == "glass" || was == "uber") {
        rename(parameters, "index", "eta");
    }
    rename(parameters, "Kd", was == "translucent" ? "transmittance" : "reflectance");
    if (was == "disney") {
        rename(parameters, "color", "reflectance");
    }
    if (was == "translucent") {
        drop(parameters, "roughness");
    }
    for (const char* name : {"Ks", "Kr", "Kt", "opacity", "reflect", "transmit"}) {
        drop(parameters, name);
    }
}

void Version3::medium(std::string& type, const Location& place) const {
    if (type == "heterogeneous") {
        rename_type(type, "uniformgrid", place);
    }
}

void Version3::light(const std::string&, ParameterSet& parameters, const Location&) const {
    const bool had_map = parameters.has("mapname");
    rename(parameters, "mapname", "filename");
    grey_to_number(parameters, "scale");
    drop(parameters, "nsamples");
    drop(parameters, "samples");
    // With a picture, the colour was a factor.
    if (had_map && parameters.type_of("L") == ParameterType::rgb) {
        const auto colour = parameters.remove("L");
        const std::optional<float> value = colour ? grey(*colour) : std::nullopt;
        if (!value) {
            throw InputError(parameters.place_of("filename"), "a light takes either \"L\" or \"filename\"");
        }
        say(colour->place, "\"L\" beside \"filename\" is read as \"scale\"");
        const float scale = parameters.get_float("scale", 1);
        parameters.add(number_at(*colour, "scale", scale * *value));
    }
}

void Version3::shape(const std::string& type, ParameterSet& parameters, const Location& place) const {
    constexpr std::string_view gone[] = {"cone", "paraboloid", "hyperboloid", "heightfield", "nurbs"};
    if (std::find(std::begin(gone), std::end(gone), type) != std::end(gone)) {
        throw InputError(place, fmt::format("Shape \"{}\" is a part of pbrt-v3 that pbrt-v4 does not have", type));
    }
    rename(parameters, "st", "uv");
    if (type == "loopsubdiv") {
        rename(parameters, "nlevels", "levels");
    }
    drop(parameters, "shadowalpha");
    drop(parameters, "discarddegenerateUVs");
}

void Version3::scale_texture(bool real, ParameterSet& parameters) const {
    if (!parameters.has("tex1") && !parameters.has("tex2")) {
        return;
    }
    const auto is_colour = [&](std::string_view name) { return parameters.type_of(name) == ParameterType::rgb; };
    if (real || is_colour("tex2") || !parameters.has("tex2")) {
        rename(parameters, "tex1", "tex");
        rename(parameters, "tex2", "scale");
    } else if (is_colour("tex1") || !parameters.has("tex1")) {
        rename(parameters, "tex2", "tex");
        rename(parameters, "tex1", "scale");
    } else {
        throw InputError(parameters.place_of("tex2"),
                         "a part of pbrt-v3: the product of two textures of colours; one "
                         "of them has to be a float texture, \"scale\"");
    }
    if (!real) {
        grey_to_number(parameters, "scale");
    }
}

void Version3::texture(std::string& kind, const std::string& type, ParameterSet& parameters,
                       const Location& place) const {
    if (kind == "color") {
        rename_type(kind, "spectrum", place);
    }
    if (type == "scale") {
        scale_texture(kind == "float", parameters);
    }
    if (type != "imagemap") {
        return;
    }
    if (const auto trilinear = parameters.remove("trilinear")) {
        say(trilinear->place, "\"trilinear\" is not used: \"filter\" takes its place");
    }
    if (const auto gamma = parameters.remove("gamma")) {
        std::string encoding = "sRGB";
        if (const auto* flags = std::get_if<std::vector<bool>>(&gamma->values)) {
            encoding = flags->front() ? "sRGB" : "linear";
        } else if (const auto* numbers = std::get_if<std::vector<float>>(&gamma->values)) {
            encoding = fmt::format("gamma {}", numbers->front());
        }
        say(gamma->place, fmt::format("\"gamma\" is read as the encoding \"{}\"", encoding));
        parameters.add(
            {ParameterType::string, "encoding", gamma->place, ColourSpace::srgb, std::vector<std::string>{encoding}});
    }
}

bool Version3::skips(std::string_view directive, const Location& place) const {
    if (directive == "WorldEnd") {
        say(place, "WorldEnd is not needed");
        return true;
    }
    constexpr std::string_view older[] = {"SurfaceIntegrator", "VolumeIntegrator", "Renderer", "Volume"};
    if (std::find(std::begin(older), std::end(older), directive) != std::end(older)) {
        throw InputError(place, fmt::format("{} is a part of pbrt-v2: a file of pbrt-v4 has Integrator and "
                                            "MakeNamedMedium instead",
                                            directive));
    }
    return false;
}

}  // namespace wend::pbrt
