#include <wend/io/pbrt/directives.h>

#include <wend/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace wend::pbrt {

const Directive* find_directive(std::string_view name) {
    using Builder = DescriptionBuilder;
    constexpr auto options = Directive::Where::before_world;
    constexpr auto world = Directive::Where::in_world;
    constexpr auto anywhere = Directive::Where::anywhere;
    // In the order of the alphabet.
    static constexpr auto table = std::to_array<Directive>({
        {"Accelerator", options, TypedDirective{&Builder::accelerator}},
        {"ActiveTransform", anywhere, SpecialDirective::active_transform},
        {"AreaLightSource", world, TypedDirective{&Builder::area_light_source}},
        {"Attribute", anywhere, SpecialDirective::attribute},
        {"AttributeBegin", world, PlainDirective{&Builder::attribute_begin}},
        {"AttributeEnd", world, PlainDirective{&Builder::attribute_end}},
        {"Camera", options, TypedDirective{&Builder::camera}},
        {"ColorSpace", anywhere, NamedDirective{&Builder::colour_space}},
        {"ConcatTransform", anywhere, NumericDirective{16, true, &Builder::concat_transform}},
        {"CoordSysTransform", anywhere, NamedDirective{&Builder::coord_sys_transform}},
        {"CoordinateSystem", anywhere, NamedDirective{&Builder::coordinate_system}},
        {"Film", options, TypedDirective{&Builder::film}},
        {"Identity", anywhere, PlainDirective{&Builder::identity}},
        {"Import", world, SpecialDirective::import},
        {"Include", anywhere, SpecialDirective::include},
        {"Integrator", options, TypedDirective{&Builder::integrator}},
        {"LightSource", world, TypedDirective{&Builder::light_source}},
        {"LookAt", anywhere, NumericDirective{9, false, &Builder::look_at}},
        {"MakeNamedMaterial", world, TypedDirective{&Builder::make_named_material}},
        {"MakeNamedMedium", anywhere, TypedDirective{&Builder::make_named_medium}},
        {"Material", world, TypedDirective{&Builder::material}},
        {"MediumInterface", anywhere, SpecialDirective::medium_interface},
        {"NamedMaterial", world, NamedDirective{&Builder::named_material}},
        {"ObjectBegin", world, NamedDirective{&Builder::object_begin}},
        {"ObjectEnd", world, PlainDirective{&Builder::object_end}},
        {"ObjectInstance", world, NamedDirective{&Builder::object_instance}},
        {"Option", options, SpecialDirective::option},
        {"PixelFilter", options, TypedDirective{&Builder::pixel_filter}},
        {"ReverseOrientation", world, PlainDirective{&Builder::reverse_orientation}},
        {"Rotate", anywhere, NumericDirective{4, false, &Builder::rotate}},
        {"Sampler", options, TypedDirective{&Builder::sampler}},
        {"Scale", anywhere, NumericDirective{3, false, &Builder::scale}},
        {"Shape", world, TypedDirective{&Builder::shape}},
        {"Texture", world, SpecialDirective::texture},
        {"Transform", anywhere, NumericDirective{16, true, &Builder::transform}},
        {"TransformBegin", world, PlainDirective{&Builder::transform_begin}},
        {"TransformEnd", world, PlainDirective{&Builder::transform_end}},
        {"TransformTimes", options, NumericDirective{2, false, &Builder::transform_times}},
        {"Translate", anywhere, NumericDirective{3, false, &Builder::translate}},
        {"WorldBegin", options, PlainDirective{&Builder::world_begin}},
    });
    const auto found =
        std::lower_bound(table.begin(), table.end(), name, [](const Directive& d, auto n) { return d.name < n; });
    return found != table.end() && found->name == name ? &*found : nullptr;
}

void require_place(const Directive& directive, bool in_world, const Location& place) {
    if (directive.where == (in_world ? Directive::Where::before_world : Directive::Where::in_world)) {
        throw InputError(place,
                         fmt::format("{} is not allowed {} WorldBegin", directive.name, in_world ? "after" : "before"));
    }
}

}  // namespace wend::pbrt
