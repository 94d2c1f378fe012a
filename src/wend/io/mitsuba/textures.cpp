#include <wend/io/mitsuba/textures.h>

#include <wend/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace wend::mitsuba {
namespace {

/// Where on the texture a point is: (s, t) from (u, v). `repeats`: how many units of ours are one of theirs. Rows of
/// pictures are counted from above, and v grows along them: t grows upwards.
void set_mapping(const Object& texture, double repeats, bool is_picture, Parameters& p) {
    const Transform m = texture.transform("to_uv");
    const double flip = is_picture ? -1 : 1;
    const auto number = [](double value) { return static_cast<float>(value); };
    p.add(pbrt::ParameterType::real, "uvmatrix",
          std::vector<float>{number(repeats * m.element(0, 0)), number(repeats * m.element(0, 1)),
                             number(repeats * m.element(0, 3)), number(flip * repeats * m.element(1, 0)),
                             number(flip * repeats * m.element(1, 1)),
                             number(flip * repeats * m.element(1, 3) + (is_picture ? 1 : 0))});
}

void refuse_texture(const Object& texture) {
    refuse_type(texture, "bitmap, checkerboard, mesh_attribute, volume");
}

/// "vertex_color, face_heat".
std::string names_of(const std::vector<MeshAttribute>& attributes) {
    std::string names;
    for (const MeshAttribute& attribute : attributes) {
        names += (names.empty() ? "" : ", ") + attribute.name;
    }
    return names;
}

}  // namespace

ColourOrTexture Textures::colour(const Object& object, std::string_view name, const Rgb& fallback) {
    const Element* given = object.find(name);
    if (!given) {
        return fallback;
    }
    if (is_texture(*given)) {
        return add_colours(*given);
    }
    return colour_of(context_, *given, SpectrumUse::reflectance);
}

NumberOrTexture Textures::number(const Object& object, std::string_view name, double fallback) {
    const Element* given = object.find(name);
    if (!given) {
        return static_cast<float>(fallback);
    }
    if (is_texture(*given)) {
        return add_numbers(*given);
    }
    return luminance(colour_of(context_, *given, SpectrumUse::unbounded));
}

TextureRef Textures::add_made(const std::string& type, Parameters& p) {
    const pbrt::Location place = p.place();
    const std::string name = context_.new_name();
    context_.builder.texture(name, "float", type, p.take(), place);
    return {name};
}

TextureRef Textures::scaled(const TextureRef& texture, double factor, const pbrt::Location& place) {
    Parameters p(place);
    p.real("tex", NumberOrTexture(texture)).real("scale", factor);
    return add_made("scale", p);
}

TextureRef Textures::inverted(const TextureRef& texture, const pbrt::Location& place) {
    Parameters p(place);
    p.real("tex1", 1).real("tex2", 0).real("amount", NumberOrTexture(texture));
    return add_made("mix", p);
}

TextureRef Textures::behind(const pbrt::Location& place) {
    if (behind_.empty()) {
        Parameters p(place);
        p.real("tex1", 0).real("tex2", 1);
        behind_ = add_made("sides", p).name;
    }
    return {behind_};
}

TextureRef Textures::add(const Element& element, const std::string& kind) {
    const bool is_of_mesh = element.attribute("type") == "mesh_attribute";
    const std::tuple key(&element, kind, is_of_mesh ? mesh_number() : 0);
    if (const auto known = known_.find(key); known != known_.end()) {
        return known->second;
    }
    constexpr int deepest = 32;
    if (++depth_ > deepest) {
        throw InputError(element.place, "textures are made of each other, too deeply or in a circle");
    }
    const Object texture(context_, element);
    Parameters p(texture.place());
    std::string type = "imagemap";
    if (texture.type() == "bitmap") {
        set_bitmap(texture, kind, p);
    } else if (texture.type() == "checkerboard") {
        type = "checkerboard";
        set_checkerboard(texture, kind, p);
    } else if (is_of_mesh) {
        type = "mesh";
        set_attribute(texture, kind, p);
    } else if (texture.type() == "volume") {
        type = "constant";
        set_volume(texture, kind, p);
    } else {
        refuse_texture(texture);
    }
    texture.warn_of_unused();
    const TextureRef name{context_.new_name()};
    context_.builder.texture(name.name, kind, type, p.take(), texture.place());
    known_.emplace(key, name);
    --depth_;
    return name;
}

BitmapWays ways_of_bitmap(const Object& texture) {
    const std::string filter = texture.text("filter_type", "bilinear"), wrap = texture.text("wrap_mode", "repeat");
    if (filter != "bilinear" && filter != "nearest") {
        throw InputError(texture.place_of("filter_type"),
                         fmt::format("\"{}\" is no filter; known are bilinear, nearest", filter));
    }
    if (wrap != "repeat" && wrap != "clamp" && wrap != "mirror") {
        throw InputError(texture.place_of("wrap_mode"),
                         fmt::format("\"{}\" is no way to wrap; known are repeat, mirror, clamp", wrap));
    }
    return {filter == "nearest" ? "point" : filter, wrap};
}

void Textures::set_bitmap(const Object& texture, const std::string& kind, Parameters& p) {
    p.text("filename", texture.file("filename").string());
    const BitmapWays ways = ways_of_bitmap(texture);
    p.text("filter", ways.filter).text("wrap", ways.wrap);
    if (texture.flag("raw", false)) {
        p.text("encoding", "raw");
    }
    if (kind == "float") {
        p.text("channels", "luminance");
    }
    texture.ignore("format");
    texture.ignore("accel");
    set_mapping(texture, 1, true, p);
}

void Textures::set_checkerboard(const Object& texture, const std::string& kind, Parameters& p) {
    constexpr double first = 0.4, second = 0.2;
    if (kind == "float") {
        // As numbers, Mitsuba has the squares the other way round.
        p.real("tex2", number(texture, "color0", first)).real("tex1", number(texture, "color1", second));
    } else {
        p.colour("tex1", colour(texture, "color0", Rgb(static_cast<float>(first))))
            .colour("tex2", colour(texture, "color1", Rgb(static_cast<float>(second))));
    }
    set_mapping(texture, 2, false, p);
}

void Textures::set_mesh(const TriangleMeshData* mesh) {
    mesh_ = mesh && !mesh->attributes.empty() ? mesh : nullptr;
    meshes_ += mesh_ != nullptr;
}

/// Of a vertex or a triangle.
void Textures::set_attribute(const Object& texture, const std::string& kind, Parameters& p) {
    const std::string name = texture.text("name", "");
    const auto none = std::vector<MeshAttribute>();
    const std::vector<MeshAttribute>& all = mesh_ ? mesh_->attributes : none;
    const auto found = std::find_if(all.begin(), all.end(), [&](const MeshAttribute& a) { return a.name == name; });
    if (found == all.end()) {
        throw InputError(texture.place_of("name"), fmt::format("the shape has no attribute \"{}\"; {}", name,
                                                               all.empty() ? "it has none: PLY and serialized files may"
                                                                           : "it has " + names_of(all)));
    }
    const auto scale = static_cast<float>(texture.number("scale", 1));
    const std::size_t channels = kind == "float" ? 1 : 3;
    std::vector<float> values;
    for (std::size_t i = 0; i < found->values.size(); i += found->channels) {
        const float* value = &found->values[i];
        const Rgb colour = found->channels == 1 ? Rgb(value[0]) : Rgb(value[0], value[1], value[2]);
        if (channels == 1) {
            values.push_back(luminance(colour) * scale);
        } else {
            values.insert(values.end(), {colour.r * scale, colour.g * scale, colour.b * scale});
        }
    }
    std::vector<int> indices(mesh_->indices.begin(), mesh_->indices.end());
    if (name.starts_with("face_")) {
        for (std::size_t i = 0; i < indices.size(); ++i) {
            indices[i] = static_cast<int>(i / 3);
        }
    }
    p.add(pbrt::ParameterType::real, "values", std::move(values))
        .add(pbrt::ParameterType::integer, "indices", std::move(indices));
}

/// One that is the same everywhere.
void Textures::set_volume(const Object& texture, const std::string& kind, Parameters& p) {
    const Element* element = texture.nested_one("volume");
    if (!element || element->attribute("type") != "constvolume") {
        throw InputError(texture.place(), fmt::format("{} of anything but a <volume type=\"constvolume\"> is not "
                                                      "implemented: bake it into a <texture type=\"bitmap\">",
                                                      texture.title()));
    }
    const Object volume(context_, *element);
    if (kind == "float") {
        p.real("value", number(volume, "value", 1));
    } else {
        p.colour("value", colour(volume, "value", Rgb(1.0f)));
    }
    volume.warn_of_unused();
}

}  // namespace wend::mitsuba
