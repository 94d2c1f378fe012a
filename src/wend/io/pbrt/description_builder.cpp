#include <wend/io/pbrt/description_builder.h>

#include <fmt/format.h>

#include <cctype>
#include <stdexcept>
#include <utility>

namespace wend::pbrt {
namespace {

// pbrt writes matrices column by column.
Transform transform_of(std::span<const double> column_major) {
    Transform::Matrix m;
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column) {
            m[row][column] = column_major[4 * column + row];
        }
    }
    return Transform(m);
}

// Puts an entity at its index, which names used before their definition may have reserved.
template <typename E>
void place_at(std::vector<E>& entities, std::size_t index, E entity) {
    if (index >= entities.size()) {
        entities.resize(index + 1);
    }
    entities[index] = std::move(entity);
}

// What pbrt makes of the names of options: "force-diffuse" and "forceDiffuse" are "forcediffuse".
std::string without_case_and_dashes(std::string_view name) {
    std::string result;
    for (const char c : name) {
        if (c != '-' && c != '_') {
            result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        }
    }
    return result;
}

std::string type_parameter(const ParameterSet& parameters, const Location& place) {
    if (!parameters.has("type")) {
        throw InputError(place, "the parameter \"string type\" is missing");
    }
    return parameters.get_string("type", "");
}

}  // namespace

DescriptionBuilder::DescriptionBuilder(std::filesystem::path base_directory) {
    description_.base_directory = std::move(base_directory);
    materials_.define_anonymous({});
}

const Transform* DescriptionBuilder::still_transform(const Location& place, const std::string& what) {
    if (const auto& fault = state().ctm.fault) {
        warn(fault->place, fmt::format("{}: {}", what, fault->text));
        return nullptr;
    }
    if (state().ctm.is_moving()) {
        warn(place, "lights, media and textures do not move: they stay where they are at the start");
    }
    return &state().ctm.start;
}

Motion DescriptionBuilder::motion_between(const Transform& start, const Transform& end, const Location& place) {
    try {
        return {start, end};
    } catch (const std::domain_error& error) {
        warn(place, fmt::format("{}: what has them stays where it is at the start", error.what()));
        return {start};
    }
}

std::shared_ptr<const Motion> DescriptionBuilder::motion(const Location& place, const std::string& what) {
    const MovingTransform& ctm = state().ctm;
    for (const auto& fault : {ctm.fault, ctm.fault_at_end}) {
        if (fault) {
            warn(fault->place, fmt::format("{}: {}", what, fault->text));
            return nullptr;
        }
    }
    if (!last_motion_ || last_motion_->start() != ctm.start ||
        last_motion_->key(last_motion_->key_count() - 1) != ctm.end) {
        last_motion_ = std::make_shared<const Motion>(motion_between(ctm.start, ctm.end, place));
    }
    return last_motion_;
}

std::optional<std::size_t> DescriptionBuilder::use_medium(const std::shared_ptr<const UsedName>& medium) {
    return medium ? std::optional(media_.use(medium->name, medium->place)) : std::nullopt;
}

std::size_t DescriptionBuilder::use_material() {
    const auto& named = state().named_material;
    return named ? materials_.use(named->name, named->place) : state().material;
}

void DescriptionBuilder::require_textures(const ParameterSet& parameters) const {
    for (const Parameter* parameter : parameters.all()) {
        if (parameter->type != ParameterType::texture) {
            continue;
        }
        for (const std::string& name : std::get<std::vector<std::string>>(parameter->values)) {
            if (!texture_names_.contains(name)) {
                throw InputError(parameter->place,
                                 fmt::format("\"{}\": the texture \"{}\" is not defined", parameter->name, name));
            }
        }
    }
}

void DescriptionBuilder::warn(const Location& place, const std::string& message) {
    if (warned_.insert(message).second) {
        description_.warnings.push_back(to_string(Place(place)) + ": warning: " + message);
    }
}

void DescriptionBuilder::warn_of_repeated(const Parameter& last, const Parameter& earlier) {
    if (repeated_.insert(last.name).second) {
        warn(last.place, fmt::format("\"{}\" is given twice: the last one counts, not that at {}", last.name,
                                     to_string(Place(earlier.place))));
    }
}

void DescriptionBuilder::accelerator(std::string type, ParameterSet parameters, const Location& place) {
    description_.accelerator = {std::move(type), std::move(parameters), place};
}

void DescriptionBuilder::camera(std::string type, ParameterSet parameters, const Location& place) {
    const MovingTransform& ctm = state().ctm;
    for (const auto& fault : {ctm.fault, ctm.fault_at_end}) {
        if (fault) {
            throw InputError(fault->place, fault->text);
        }
    }
    version3_.camera(type, parameters, place);
    states_.coordinate_systems()["camera"] = {ctm.start.inverse(), ctm.end.inverse()};
    description_.camera = {{std::move(type), std::move(parameters), place},
                           motion_between(ctm.start.inverse(), ctm.end.inverse(), place),
                           use_medium(state().exterior)};
}

void DescriptionBuilder::film(std::string type, ParameterSet parameters, const Location& place) {
    version3_.film(type, parameters, place);
    description_.film = {std::move(type), std::move(parameters), place};
}

void DescriptionBuilder::integrator(std::string type, ParameterSet parameters, const Location& place) {
    version3_.integrator(type, parameters, place);
    description_.integrator = {std::move(type), std::move(parameters), place};
}

void DescriptionBuilder::option(Parameter parameter) {
    parameter.name = without_case_and_dashes(parameter.name);
    const Parameter last{parameter.type, parameter.name, parameter.place, parameter.colour_space, {}};
    if (const auto earlier = description_.options.add(std::move(parameter))) {
        warn_of_repeated(last, *earlier);
    }
}

void DescriptionBuilder::pixel_filter(std::string type, ParameterSet parameters, const Location& place) {
    version3_.pixel_filter(type, parameters, place);
    description_.filter = {std::move(type), std::move(parameters), place};
}

void DescriptionBuilder::sampler(std::string type, ParameterSet parameters, const Location& place) {
    version3_.sampler(type, place);
    description_.sampler = {std::move(type), std::move(parameters), place};
}

void DescriptionBuilder::world_begin(const Location&) {
    in_world_ = true;
    state().ctm = {};
    state().active = ActiveTransform::all;
    states_.coordinate_systems()["world"] = {};
}

void DescriptionBuilder::active_transform(ActiveTransform which) {
    state().active = which;
}

void DescriptionBuilder::concat_transform(std::span<const double> column_major, const Location& place) {
    state().change_transforms([&](const Transform& ctm) { return ctm * transform_of(column_major); }, place);
}

void DescriptionBuilder::coordinate_system(const std::string& name, const Location&) {
    states_.coordinate_systems()[name] = state().ctm;
}

void DescriptionBuilder::coord_sys_transform(const std::string& name, const Location& place) {
    const auto system = states_.coordinate_systems().find(name);
    if (system == states_.coordinate_systems().end()) {
        warn(place, fmt::format("the coordinate system \"{}\" is not defined: nothing changes, as in pbrt", name));
        return;
    }
    state().ctm = system->second;
}

void DescriptionBuilder::identity(const Location& place) {
    state().set_transforms([] { return Transform(); }, place);
}

void DescriptionBuilder::look_at(std::span<const double> v, const Location& place) {
    const auto triple = [&](std::size_t i) { return Imath::V3d(v[i], v[i + 1], v[i + 2]); };
    state().change_transforms(
        [&](const Transform& ctm) { return ctm * Transform::look_at(triple(0), triple(3), triple(6)); }, place);
}

void DescriptionBuilder::rotate(std::span<const double> v, const Location& place) {
    state().change_transforms([&](const Transform& ctm) { return ctm * Transform::rotate(v[0], v[1], v[2], v[3]); },
                              place);
}

void DescriptionBuilder::scale(std::span<const double> v, const Location& place) {
    state().change_transforms([&](const Transform& ctm) { return ctm * Transform::scale(v[0], v[1], v[2]); }, place);
}

void DescriptionBuilder::transform(std::span<const double> column_major, const Location& place) {
    state().set_transforms([&] { return transform_of(column_major); }, place);
}

void DescriptionBuilder::transform_times(std::span<const double> v, const Location& place) {
    if (v[0] > v[1]) {
        throw InputError(place, "the end time is before the start time");
    }
    if (description_.camera.world_from_camera.is_moving()) {
        warn(place, "TransformTimes after Camera are those of the camera, too");
    }
    description_.transform_times = {static_cast<float>(v[0]), static_cast<float>(v[1])};
}

void DescriptionBuilder::translate(std::span<const double> v, const Location& place) {
    state().change_transforms([&](const Transform& ctm) { return ctm * Transform::translate(v[0], v[1], v[2]); },
                              place);
}

void DescriptionBuilder::attribute(const std::string& target, ParameterSet parameters, const Location& place) {
    AttributeDefaults& defaults = state().defaults;
    std::shared_ptr<const ParameterSet>* const chosen = target == "shape"      ? &defaults.shape
                                                        : target == "light"    ? &defaults.light
                                                        : target == "material" ? &defaults.material
                                                        : target == "medium"   ? &defaults.medium
                                                        : target == "texture"  ? &defaults.texture
                                                                               : nullptr;
    if (!chosen) {
        throw InputError(place, fmt::format("\"{}\": expected shape, light, material, medium or texture", target));
    }
    ParameterSet merged = *chosen ? **chosen : ParameterSet(place);
    merged.override_with(parameters);
    *chosen = std::make_shared<const ParameterSet>(std::move(merged));
}

void DescriptionBuilder::attribute_begin(const Location& place) {
    states_.open(StateStack::Block::attribute, place);
}

void DescriptionBuilder::attribute_end(const Location& place) {
    if (const auto open = states_.innermost(); !open || *open == StateStack::Block::import) {
        warn(place, "AttributeEnd without AttributeBegin is left out, as by pbrt");
        return;
    }
    states_.close(StateStack::Block::attribute, place);
}

void DescriptionBuilder::begin_import(const Location& place) {
    states_.open(StateStack::Block::import, place);
}

void DescriptionBuilder::end_import(const Location& place) {
    states_.close(StateStack::Block::import, place);
}

void DescriptionBuilder::colour_space(const std::string& name, const Location& place) {
    const auto space = colour_space_named(name);
    if (!space) {
        warn(place, fmt::format("the colour space \"{}\" is unknown, and nothing changes, as in pbrt; known are srgb, "
                                "dci-p3, rec2020 and aces2065-1",
                                name));
        return;
    }
    state().colour_space = *space;
}

void DescriptionBuilder::material(std::string type, ParameterSet parameters, const Location& place) {
    version3_.material(type, parameters, place);
    parameters.set_defaults(state().defaults.material);
    state().material = materials_.define_anonymous(place);
    state().named_material.reset();
    place_at(description_.materials, state().material, {{std::move(type), std::move(parameters), place}, ""});
}

void DescriptionBuilder::medium_interface(const std::string& interior, const std::string& exterior,
                                          const Location& place) {
    const auto medium = [&](const std::string& name) {
        return name.empty() ? nullptr : std::make_shared<const UsedName>(UsedName{name, place});
    };
    state().interior = medium(interior);
    state().exterior = medium(exterior);
}

void DescriptionBuilder::named_material(const std::string& name, const Location& place) {
    state().named_material = std::make_shared<const UsedName>(UsedName{name, place});
}

void DescriptionBuilder::object_begin(const std::string& name, const Location& place) {
    if (open_object_) {
        throw InputError(
            place, fmt::format("ObjectBegin within the object \"{}\" at {}", description_.objects[*open_object_].name,
                               to_string(Place(description_.objects[*open_object_].place))));
    }
    states_.open(StateStack::Block::object, place);
    open_object_ = objects_.define(name, place);
    place_at(description_.objects, *open_object_, {name, place});
}

void DescriptionBuilder::object_end(const Location& place) {
    states_.close(StateStack::Block::object, place);
    open_object_.reset();
}

void DescriptionBuilder::reverse_orientation(const Location&) {
    state().reverse_orientation = !state().reverse_orientation;
}

void DescriptionBuilder::transform_begin(const Location& place) {
    warn(place, "TransformBegin and TransformEnd are deprecated and mean AttributeBegin and AttributeEnd");
    attribute_begin(place);
}

void DescriptionBuilder::transform_end(const Location& place) {
    attribute_end(place);
}

void DescriptionBuilder::area_light_source(std::string type, ParameterSet parameters, const Location& place) {
    version3_.light(type, parameters, place);
    parameters.set_defaults(state().defaults.light);
    state().area_light = description_.area_lights.size();
    description_.area_lights.push_back({std::move(type), std::move(parameters), place});
}

void DescriptionBuilder::light_source(std::string type, ParameterSet parameters, const Location& place) {
    version3_.light(type, parameters, place);
    parameters.set_defaults(state().defaults.light);
    if (const Transform* world_from_light =
            still_transform(place, fmt::format("LightSource \"{}\" is left out", type))) {
        description_.lights.push_back(
            {{std::move(type), std::move(parameters), place}, *world_from_light, use_medium(state().exterior)});
    }
}

void DescriptionBuilder::make_named_material(std::string name, ParameterSet parameters, const Location& place) {
    parameters.set_defaults(state().defaults.material);
    std::string type = type_parameter(parameters, place);
    version3_.material(type, parameters, place);
    const std::size_t index = materials_.define(name, place);
    place_at(description_.materials, index, {{std::move(type), std::move(parameters), place}, std::move(name)});
}

void DescriptionBuilder::make_named_medium(std::string name, ParameterSet parameters, const Location& place) {
    if (name.empty()) {
        throw InputError(place, "a medium needs a name: \"\" means vacuum");
    }
    parameters.set_defaults(state().defaults.medium);
    std::string type = type_parameter(parameters, place);
    version3_.medium(type, place);
    const std::size_t index = media_.define(name, place);
    const Transform* transform = still_transform(place, fmt::format("the medium \"{}\" is not transformed", name));
    place_at(description_.media, index,
             {{std::move(type), std::move(parameters), place}, std::move(name), transform ? *transform : Transform()});
}

void DescriptionBuilder::object_instance(const std::string& name, const Location& place) {
    if (open_object_) {
        throw InputError(place, "an ObjectInstance may not be part of an object");
    }
    const std::size_t object = objects_.use(name, place);
    if (const auto moved = motion(place, fmt::format("an instance of \"{}\" is left out", name))) {
        description_.instances.push_back({object, *moved, place});
    }
}

void DescriptionBuilder::shape(std::string type, ParameterSet parameters, const Location& place) {
    version3_.shape(type, parameters, place);
    parameters.set_defaults(state().defaults.shape);
    const auto moved = motion(place, fmt::format("Shape \"{}\" is left out", type));
    if (!moved) {
        return;
    }
    std::optional<std::size_t> area_light = state().area_light;
    if (area_light && open_object_) {
        warn(place, "shapes of object instances cannot be area lights: they do not shine");
        area_light.reset();
    }
    const bool moves = moved->is_moving();
    description_.shapes.push_back({{std::move(type), std::move(parameters), place},
                                   moves ? Transform() : moved->start(),
                                   moves ? moved : nullptr,
                                   state().reverse_orientation,
                                   use_material(),
                                   use_medium(state().interior),
                                   use_medium(state().exterior),
                                   area_light,
                                   open_object_});
}

void DescriptionBuilder::texture(std::string name, std::string kind, std::string type, ParameterSet parameters,
                                 const Location& place) {
    version3_.texture(kind, type, parameters, place);
    if (kind != "float" && kind != "spectrum") {
        throw InputError(place, fmt::format("\"{}\": expected a texture of kind float or spectrum", kind));
    }
    parameters.set_defaults(state().defaults.texture);
    const Transform* transform = still_transform(place, fmt::format("the texture \"{}\" is not transformed", name));
    textures_.define(kind + ' ' + name, place);
    texture_names_.insert(name);
    description_.textures.push_back({{std::move(type), std::move(parameters), place},
                                     std::move(name),
                                     kind == "float" ? TextureKind::real : TextureKind::spectrum,
                                     transform ? *transform : Transform()});
}

Description DescriptionBuilder::finish(const Location& end) {
    if (!in_world_) {
        throw InputError(end, "the file ends before WorldBegin");
    }
    states_.require_all_closed();
    materials_.require_all_defined();
    media_.require_all_defined();
    objects_.require_all_defined();
    const auto require_textures_of = [&](const auto& entities) {
        for (const Entity& entity : entities) {
            require_textures(entity.parameters);
        }
    };
    require_textures_of(description_.textures);
    require_textures_of(description_.materials);
    require_textures_of(description_.media);
    require_textures_of(description_.lights);
    require_textures_of(description_.area_lights);
    require_textures_of(description_.shapes);
    return std::move(description_);
}

}  // namespace wend::pbrt
