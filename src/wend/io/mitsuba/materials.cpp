#include <wend/io/mitsuba/materials.h>

#include <wend/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace wend::mitsuba {
namespace {

/// The BSDFs in one that wraps others.
std::vector<const Element*> inner_of(const Object& bsdf, std::size_t least, std::size_t most) {
    std::vector<const Element*> inner = bsdf.nested("bsdf");
    if (inner.size() < least || inner.size() > most) {
        throw InputError(
            bsdf.place(),
            fmt::format("{} has {} <bsdf> in it, not {}", bsdf.title(),
                        least == most ? fmt::format("{}", least) : fmt::format("{} or {}", least, most), inner.size()));
    }
    return inner;
}

}  // namespace

SurfaceLook Materials::look_of(const Element* element, const pbrt::Location& shape, bool shines,
                               const TriangleMeshData* mesh) {
    textures_.set_mesh(mesh);
    if (!element) {
        if (shines) {
            return {black(), {}};
        }
        if (default_.empty()) {
            const auto plain = std::make_unique<Element>(Element{"bsdf", {{"type", "diffuse"}}, {}, shape});
            default_ = make(Object(context_, *plain), {});
        }
        return {default_, {}};
    }
    const Object bsdf(context_, *element);
    if (auto look = masked(bsdf)) {
        return *look;
    }
    return {name_of(*element, {}), {}};
}

void Materials::warn_of_holes(const Object& bsdf) {
    if (is_of_surfaces_ && !is_told_of_holes_) {
        is_told_of_holes_ = true;
        context_.warn(bsdf.place(), fmt::format("what passes {} is no bounce, and light without size passes, too, as "
                                                "in Mitsuba's \"volpath\": in its \"path\" neither is so",
                                                bsdf.title()));
    }
}

void Materials::warn_of_panes(const Object& bsdf) {
    if (!is_of_surfaces_ && has_points_ && !is_told_of_panes_) {
        is_told_of_panes_ = true;
        context_.warn(bsdf.place(), fmt::format("light without size does not pass {}, as in Mitsuba's \"path\": in its "
                                                "\"volpath\" it does",
                                                bsdf.title()));
    }
}

/// Where a part of a surface is not there: `mask`, or a blend with `null`.
std::optional<SurfaceLook> Materials::masked(const Object& bsdf) {
    if (bsdf.type() == "mask") {
        const Element* inner = inner_of(bsdf, 1, 1).front();
        const SurfaceLook look{name_of(*inner, {}), textures_.number(bsdf, "opacity", 0.5)};
        bsdf.warn_of_unused();
        warn_of_holes(bsdf);
        return look;
    }
    if (bsdf.type() != "blendbsdf") {
        return filter(bsdf);
    }
    const std::vector<const Element*> inner = inner_of(bsdf, 2, 2);
    const bool first = inner[0]->attribute("type") == "null", second = inner[1]->attribute("type") == "null";
    if (first == second) {
        return std::nullopt;
    }
    const NumberOrTexture weight = textures_.number(bsdf, "weight", 0.5);
    const auto* texture = std::get_if<TextureRef>(&weight);
    const NumberOrTexture rest = texture ? NumberOrTexture(textures_.inverted(*texture, bsdf.place()))
                                         : NumberOrTexture(1 - std::get<float>(weight));
    bsdf.warn_of_unused();
    warn_of_holes(bsdf);
    return SurfaceLook{name_of(*inner[first ? 1 : 0], {}), first ? weight : rest};
}

/// What changes polarization is, without it, a black surface that has holes: of what meets a polarizer half passes.
std::optional<SurfaceLook> Materials::filter(const Object& bsdf) {
    const bool is_retarder = bsdf.type() == "retarder";
    if (!is_retarder && bsdf.type() != "polarizer" && bsdf.type() != "circular") {
        return std::nullopt;
    }
    for (const char* name : {"theta", "delta", "polarizing", "left_handed"}) {
        bsdf.ignore(name);
    }
    const double passing = is_retarder ? 1 : 0.5;
    const Element* given = bsdf.find("transmittance");
    if (given && !is_texture(*given)) {
        const Rgb colour = colour_of(context_, *given, SpectrumUse::reflectance);
        if (colour != Rgb(colour.r)) {
            context_.warn(given->place, fmt::format("the \"transmittance\" of {} is taken as grey", bsdf.title()));
        }
    }
    const NumberOrTexture share = textures_.number(bsdf, "transmittance", 1);
    bsdf.warn_of_unused();
    if (const auto* number = std::get_if<float>(&share)) {
        return SurfaceLook{black(), static_cast<float>(1 - passing * static_cast<double>(*number))};
    }
    const TextureRef part = textures_.scaled(std::get<TextureRef>(share), passing, bsdf.place());
    return SurfaceLook{black(), textures_.inverted(part, bsdf.place())};
}

std::string Materials::name_of(const Element& element, const Setting& setting) {
    const std::tuple key(&element, setting.is_two_sided, setting.detail, textures_.mesh_number());
    if (const auto known = names_.find(key); known != names_.end()) {
        return known->second;
    }
    constexpr int deepest = 32;
    if (++depth_ > deepest) {
        throw InputError(element.place, "BSDFs are made of each other, too deeply or in a circle");
    }
    const Object bsdf(context_, element);
    std::string name = make(bsdf, setting);
    bsdf.warn_of_unused();
    --depth_;
    names_.emplace(key, name);
    return name;
}

std::string Materials::make(const Object& bsdf, const Setting& setting) {
    const std::string_view type = bsdf.type();
    if (type == "twosided") {
        return two_sided(bsdf, setting);
    }
    if (type == "bumpmap" || type == "normalmap") {
        return detailed(bsdf, setting);
    }
    if (type == "blendbsdf") {
        return blended(bsdf, setting);
    }
    if (type == "mask") {
        context_.warn(bsdf.place(), "a \"mask\" within other BSDFs is ignored: what it holds is there everywhere");
        bsdf.ignore("opacity");
        return name_of(*inner_of(bsdf, 1, 1).front(), setting);
    }
    if (type == "thindielectric") {
        warn_of_panes(bsdf);
    }
    return add_model(bsdf, models_.of(bsdf), setting);
}

std::string Materials::add(const Object& bsdf, const std::string& type, Parameters& p) {
    std::string name = context_.new_name();
    p.text("type", type);
    context_.builder.make_named_material(name, p.take(), bsdf.place());
    return name;
}

std::string Materials::add_model(const Object& bsdf, Model model, const Setting& setting) {
    if (setting.detail) {
        set_detail(*setting.detail, model.parameters);
    }
    const std::string name = add(bsdf, model.type, model.parameters);
    return model.is_one_sided && !setting.is_two_sided ? mix(bsdf, name, black(), textures_.behind(bsdf.place()))
                                                       : name;
}

std::string Materials::mix(const Object& bsdf, const std::string& first, const std::string& second,
                           const NumberOrTexture& amount) {
    Parameters p(bsdf.place());
    p.add(pbrt::ParameterType::string, "materials", std::vector<std::string>{first, second}).real("amount", amount);
    return add(bsdf, "mix", p);
}

std::string Materials::black() {
    if (black_.empty()) {
        black_ = context_.new_name();
        Parameters p({});
        p.text("type", "diffuse").colour("reflectance", Rgb(0.0f));
        context_.builder.make_named_material(black_, p.take(), {});
    }
    return black_;
}

std::string Materials::two_sided(const Object& bsdf, Setting setting) {
    const std::vector<const Element*> inner = inner_of(bsdf, 1, 2);
    setting.is_two_sided = true;
    const std::string front = name_of(*inner.front(), setting);
    return inner.size() == 1 ? front
                             : mix(bsdf, front, name_of(*inner.back(), setting), textures_.behind(bsdf.place()));
}

std::string Materials::detailed(const Object& bsdf, Setting setting) {
    if (setting.detail) {
        context_.warn(bsdf.place(), fmt::format("{} is ignored within another one", bsdf.title()));
        bsdf.warn_of_unused();
    } else {
        setting.detail = &bsdf.element();
    }
    return name_of(*inner_of(bsdf, 1, 1).front(), setting);
}

std::string Materials::blended(const Object& bsdf, const Setting& setting) {
    const std::vector<const Element*> inner = inner_of(bsdf, 2, 2);
    const NumberOrTexture weight = textures_.number(bsdf, "weight", 0.5);
    const std::string first = name_of(*inner[0], setting);
    return mix(bsdf, first, name_of(*inner[1], setting), weight);
}

void Materials::set_detail(const Element& element, Parameters& p) {
    const Object detail(context_, element);
    if (detail.flag("use_shadowing_function", true)) {
        context_.warn(detail.place_of("use_shadowing_function"),
                      fmt::format("light on a {} is not weakened where it grazes what the normals show "
                                  "(\"use_shadowing_function\")",
                                  detail.type()));
    }
    if (detail.flag("flip_invalid_normals", true)) {
        context_.warn(detail.place_of("flip_invalid_normals"),
                      fmt::format("what the normals of a {} show is dark where it faces away from the view "
                                  "(\"flip_invalid_normals\")",
                                  detail.type()));
    }
    const std::vector<const Element*> maps = detail.nested("texture");
    if (maps.size() != 1) {
        throw InputError(detail.place(), fmt::format("{} has one <texture>, not {}", detail.title(), maps.size()));
    }
    if (detail.type() == "normalmap") {
        const Object map(context_, *maps.front());
        if (map.type() != "bitmap") {
            throw InputError(map.place(), "a \"normalmap\" has a <texture type=\"bitmap\">");
        }
        if (!map.flag("raw", false)) {
            context_.warn(map.place(), "the bitmap of a normalmap is taken for \"raw\"");
        }
        p.text("normalmap", map.file("filename").string()).text("normalmaporigin", "top");
        map.warn_of_unused();
        return;
    }
    const TextureRef height = textures_.add_numbers(*maps.front());
    p.real("displacement", NumberOrTexture(textures_.scaled(height, detail.number("scale", 1), detail.place())));
}

}  // namespace wend::mitsuba
