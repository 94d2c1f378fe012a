#include <wend/io/load/load_scene.h>

#include <wend/io/load/backdrops.h>
#include <wend/io/load/boundaries.h>
#include <wend/io/load/camera_film.h>
#include <wend/io/load/forced_diffuse.h>
#include <wend/io/load/joined_curves.h>
#include <wend/io/load/lights.h>
#include <wend/io/load/loaded_parts.h>
#include <wend/io/load/materials.h>
#include <wend/io/load/media.h>
#include <wend/io/load/message_length.h>
#include <wend/io/load/parse_scene.h>
#include <wend/io/load/reach.h>
#include <wend/io/load/shapes.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <memory>
#include <utility>

namespace wend {
namespace {

MediumId medium_id(const std::optional<std::size_t>& index) {
    return index ? static_cast<MediumId>(*index) : vacuum;
}

/// Forgets what is around cameras and in shapes, for integrators of surfaces alone. Materials may still bring media of
/// their own.
void leave_out_media(LoadContext& context, pbrt::Description& description) {
    bool any = description.camera.medium.has_value();
    description.camera.medium.reset();
    for (pbrt::ShapeEntity& shape : description.shapes) {
        any = any || shape.interior || shape.exterior;
        shape.interior.reset();
        shape.exterior.reset();
    }
    if (any) {
        context.warnings.add(description.integrator.place,
                             fmt::format("Integrator \"{}\" leaves out all media, as pbrt does: \"volpath\" has them",
                                         description.integrator.type));
    }
}

/// Fills a SceneDescription, part by part; each refers to those before.
class SceneBuilder {
public:
    SceneBuilder(LoadContext& context, pbrt::Description& description, bool sees_media, SceneDescription& scene)
        : context_(context),
          description_(description),
          sees_media_(sees_media),
          scene_(scene),
          textures_(context, scene.textures),
          curves_(context, description) {}

    void build() {
        textures_.add(description_.textures);
        for (const pbrt::MediumEntity& medium : description_.media) {
            const int group = light_group(medium);
            scene_.media.push_back(load_part(
                context_, &LoadedParts::media, scene_.media.size(), medium.parameters,
                [](const Medium&) { return true; }, [&] { return load_medium(context_, medium); }));
            LightGroups::set(scene_.light_groups.of_media, scene_.media.size() - 1, scene_.media.size(), group);
        }
        add_materials();
        for (const pbrt::LightEntity& light : description_.lights) {
            const int group = light_group(light);
            const BackdropView view = load_backdrop_view(light);
            if (auto loaded = load_light(context_, textures_, light)) {
                add_light(std::move(*loaded), view, scene_);
                group_lights_from(scene_.lights.size() - 1, group);
            }
        }
        for (const pbrt::Entity& light : description_.area_lights) {
            area_light_groups_.push_back(light_group(light));
            area_lights_.push_back(load_area_light(context_, textures_, light));
        }
        scene_.objects.resize(description_.objects.size());
        object_boxes_.resize(description_.objects.size());
        groups_.resize(description_.objects.size() + 1);
        for (std::size_t i = 0; i < description_.shapes.size(); ++i) {
            add_shape(i);
        }
        curves_.finish(scene_.surfaces);
        for (const Group& group : groups_.back()) {
            place(group.object, *group.motion, group.place);
        }
        scene_.instances.reserve(scene_.instances.size() + description_.instances.size());
        for (const pbrt::ObjectInstance& instance : description_.instances) {
            add_instance(instance);
        }
        scene_.names.of_media = medium_names();
        warn_of_boundaries(context_, scene_, places_, scene_.names.of_media, description_.camera.place);
    }

private:
    /// What moves together is placed like an object.
    struct Group {
        std::size_t object;
        std::shared_ptr<const Motion> motion;
        Place place;  ///< of its first shape
    };

    void add_instance(const pbrt::ObjectInstance& instance) {
        place(instance.object, instance.world_from_instance, instance.place);
        for (const Group& group : groups_[instance.object]) {
            place(group.object, instance.world_from_instance * *group.motion, instance.place);
        }
    }

    void place(std::size_t object, const Motion& motion, const Place& place) {
        for (std::size_t i = 0; i < motion.key_count(); ++i) {
            require_near(place, object_boxes_[object], motion.key(i));
        }
        scene_.instances.push_back({static_cast<int>(object), motion});
    }

    /// Those that move with a shape, in its object or in the world.
    std::size_t group_of(const pbrt::ShapeEntity& entity) {
        const std::size_t in = entity.object.value_or(description_.objects.size());
        const auto [found, is_new] = group_objects_.try_emplace({in, entity.motion.get()}, scene_.objects.size());
        if (is_new) {
            groups_[in].push_back({found->second, entity.motion, entity.place});
            scene_.objects.emplace_back();
            object_boxes_.emplace_back();
        }
        return found->second;
    }

    void add_materials() {
        std::vector<LoadedMaterial> materials = load_materials(context_, textures_, description_.materials);
        if (description_.options.get_bool("forcediffuse", false)) {
            force_diffuse(materials, scene_.textures);
        }
        for (LoadedMaterial& material : materials) {
            std::optional<MediumId> inside;
            if (material.inside && sees_media_) {
                inside = static_cast<MediumId>(scene_.media.size());
                scene_.media.push_back(*material.inside);
            }
            scene_.materials.push_back(std::move(material.material));
            scene_.details.push_back(std::move(material.detail));
            inside_.push_back(inside);
            presences_.push_back(material.presence);
        }
    }

    /// None for one without triangles.
    std::optional<SharedShape> shape_of(std::size_t index, bool as_mesh) {
        pbrt::ShapeEntity& entity = description_.shapes[index];
        const auto load = [&] { return LoadedShape{load_shape(context_, entity, as_mesh), as_mesh}; };
        if (entity.type == "curve") {
            return load().shape;  // a part of what the joined ones share
        }
        const pbrt::ParameterSet parameters = context_.parts ? entity.parameters : pbrt::ParameterSet();
        return load_part(
                   context_, &LoadedParts::shapes, index, parameters,
                   [&](const LoadedShape& known) { return known.as_mesh == as_mesh; }, load)
            .shape;
    }

    /// pbrt connects to a mirrored sphere, disk or cylinder on the side that it shines to before it is mirrored, though
    /// its normals turn: such a lamp is turned back here, so that it lights what it does in pbrt.
    bool is_lamp_turned_by_mirror(const pbrt::ShapeEntity& entity, bool bounds_medium) const {
        const bool is_round = entity.type == "sphere" || entity.type == "disk" || entity.type == "cylinder";
        return context_.is_for_pbrt && is_round && entity.area_light && !bounds_medium && !entity.motion &&
               entity.world_from_object.swaps_handedness();
    }

    void add_shape(std::size_t index) {
        pbrt::ShapeEntity& entity = description_.shapes[index];
        const MediumId interior = inside_[entity.material].value_or(medium_id(entity.interior));
        const MediumId exterior = medium_id(entity.exterior);
        if (is_lamp_turned_by_mirror(entity, interior != exterior)) {
            entity.reverse_orientation = !entity.reverse_orientation;
        }
        const std::size_t patches = patches_of(entity);
        const ObjectNames::Name name = name_of(entity);
        const std::optional<SharedShape> shape = shape_of(index, entity.area_light || interior != exterior);
        if (!shape) {
            return;
        }
        const bool is_curve = std::holds_alternative<CurveSet>(**shape);
        const Box3 box =
            require_near(entity.place, fmt::format("Shape \"{}\" reaches to a point", entity.type), **shape);
        const std::optional<std::size_t> object = entity.motion ? group_of(entity) : entity.object;
        if (object) {
            object_boxes_[*object].extendBy(box);
        }
        Surface surface{*shape};
        surface.material = static_cast<int>(entity.material);
        surface.interior = is_curve ? exterior : interior;
        surface.exterior = exterior;
        surface.flip_normal = flips_normal(entity);
        surface.alpha = load_alpha(entity);
        surface.view = load_view(entity, surface);
        if (is_curve && (entity.area_light || interior != exterior)) {
            context_.warnings.add(entity.place, "curves neither shine nor bound a medium");
        } else if (entity.area_light) {
            add_area_light(entity, patches, surface);
        }
        context_.warnings.add_unused("Shape", entity);
        std::vector<int>& group = object ? scene_.objects[*object].surfaces : scene_.world_surfaces;
        if (is_curve && !group.empty() && curves_.join(group.back(), scene_.surfaces, surface, index)) {
            return;
        }
        if (is_curve) {
            curves_.begin(static_cast<int>(scene_.surfaces.size()), std::get<CurveSet>(**shape), index);
        }
        group.push_back(static_cast<int>(scene_.surfaces.size()));
        scene_.surfaces.push_back(std::move(surface));
        places_.push_back(entity.place);
        scene_.names.of_surfaces.push_back(name);
    }

    /// What the scene calls a shape, or else where it is.
    ObjectNames::Name name_of(const pbrt::ShapeEntity& entity) {
        const bool has_name = entity.parameters.has("name");
        const Place place = entity.place;
        const std::string text =
            has_name ? entity.parameters.get_string("name", "") : std::filesystem::path(place.file).filename().string();
        const auto [found, is_new] = texts_.try_emplace(text, static_cast<int>(scene_.names.texts.size()));
        if (is_new) {
            scene_.names.texts.push_back(text);
        }
        return {found->second, has_name ? 0 : place.line};
    }

    /// How many shapes a shape is to pbrt where that is not one a triangle; 0 otherwise. Asked before the shape is
    /// loaded, which takes its parameters.
    static std::size_t patches_of(const pbrt::ShapeEntity& entity) {
        if (entity.type == "bilinearmesh") {
            return std::max<std::size_t>(1, entity.parameters.get_ints("indices").size() / 4);
        }
        return entity.type == "cylinder" ? 1 : 0;
    }

    void add_area_light(const pbrt::ShapeEntity& entity, std::size_t patches, Surface& surface) {
        const AreaLight& light = area_lights_[*entity.area_light];
        const bool is_interface = std::holds_alternative<InterfaceMaterial>(scene_.materials[entity.material]);
        if (!light.is_solid && !is_interface) {
            throw InputError(entity.place,
                             "an AreaLightSource that is not \"solid\" wants a shape of \"interface\" material");
        }
        if (light.is_solid && is_interface) {
            context_.warnings.add(entity.place,
                                  "an AreaLightSource on a shape of \"interface\" material is ignored, as by pbrt");
            return;
        }
        const Rgb* alpha = surface.alpha >= 0 ? scene_.textures.constant(surface.alpha) : nullptr;
        const Presence presence = is_interface               ? Presence::passed
                                  : surface.alpha < 0        ? Presence::solid
                                  : alpha && !(alpha->r > 0) ? Presence::unseen
                                  : light.is_once            ? Presence::once
                                                             : Presence::partly;
        const auto difference = round_lamp_difference(entity.type, *surface.shape, entity.world_from_object);
        if (context_.is_for_pbrt && !difference.empty()) {
            context_.warnings.add(entity.place, fmt::format("a \"{}\" with an AreaLightSource {}: its light differs",
                                                            entity.type, difference));
        }
        const std::size_t first = scene_.lights.size();
        attach(light, {presence, patches, entity.world_from_object, entity.motion}, surface, scene_.lights);
        group_lights_from(first, area_light_groups_[*entity.area_light]);
    }

    /// The group that what shines is said to be in, to be asked for before it is loaded. Throws InputError for names
    /// that layers cannot have.
    int light_group(const pbrt::Entity& entity) {
        const pbrt::ParameterSet& p = entity.parameters;
        if (!p.has("lightgroup")) {
            return LightGroups::none;
        }
        const std::string name = p.get_string("lightgroup", "");
        const auto is_plain = [](char c) {
            return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
        };
        if (name.empty() || name == LightGroups::rest || !std::all_of(name.begin(), name.end(), is_plain)) {
            throw InputError(p.place_of("lightgroup"),
                             fmt::format("a light group's name is of letters, digits, '_' and '-', and not \"{}\": "
                                         "\"{}\" cannot be one",
                                         LightGroups::rest, name));
        }
        return scene_.light_groups.index_of(name);
    }
    void group_lights_from(std::size_t first, int group) {
        LightGroups::set(scene_.light_groups.of_lights, first, scene_.lights.size(), group);
    }

    /// Those of materials have none.
    std::vector<std::string> medium_names() const {
        std::vector<std::string> names(scene_.media.size());
        std::transform(description_.media.begin(), description_.media.end(), names.begin(),
                       [](const pbrt::MediumEntity& medium) { return medium.name; });
        return names;
    }

    /// "cameraview", once it is known whether the surface bounds a medium.
    CameraView load_view(const pbrt::ShapeEntity& entity, const Surface& surface) {
        const pbrt::ParameterSet& p = entity.parameters;
        const std::string view = p.get_string("cameraview", "shown");
        if (view != "shown" && view != "hidden" && view != "holdout") {
            throw InputError(p.place_of("cameraview"),
                             fmt::format("\"{}\" is no view of a camera; known are shown, hidden, holdout", view));
        }
        if (view == "hidden" && surface.bounds_medium()) {
            context_.warnings.add(p.place_of("cameraview"), "what bounds a medium is not hidden from the camera");
            return CameraView::shown;
        }
        return view == "hidden" ? CameraView::hidden : view == "holdout" ? CameraView::held_out : CameraView::shown;
    }

    TextureId load_alpha(const pbrt::ShapeEntity& entity) {
        std::optional<TextureId> alpha = textures_.find_presence(entity.parameters, "alpha");
        if (const TextureId presence = presences_[entity.material]; presence >= 0) {
            alpha = alpha ? textures_.product(*alpha, presence) : presence;
        }
        const Rgb* constant = alpha ? scene_.textures.constant(*alpha) : nullptr;
        const bool opaque = !alpha || (constant && constant->r >= 1);
        return opaque ? -1 : *alpha;
    }

    LoadContext& context_;
    pbrt::Description& description_;
    bool sees_media_;
    SceneDescription& scene_;
    TextureLoader textures_;
    std::vector<std::optional<MediumId>> inside_;  ///< by material
    std::vector<TextureId> presences_;             ///< LoadedMaterial::presence
    std::vector<AreaLight> area_lights_;
    std::vector<int> area_light_groups_;
    std::vector<Place> places_;  ///< of the scene's surfaces
    std::map<std::string, int> texts_;
    std::vector<Box3> object_boxes_;
    JoinedCurves curves_;
    std::vector<std::vector<Group>> groups_;  ///< by the object of the file that they are in, those of the world last
    std::map<std::pair<std::size_t, const Motion*>, std::size_t> group_objects_;
};

}  // namespace

LoadedScene load_scene(const std::filesystem::path& file, const LoadOverrides& overrides) {
    return load_scene(parse_scene(file), overrides);
}

namespace {

LoadedScene build_scene(pbrt::Description& description, const LoadOverrides& overrides, LoadedParts* parts) {
    const LoadedParts earlier = parts ? std::exchange(*parts, {}) : LoadedParts();
    LoadContext context{description.base_directory, {}};
    context.is_for_pbrt = description.is_for_pbrt;
    context.earlier = parts ? &earlier : nullptr;
    context.parts = parts;
    context.files->insert(description.files.begin(), description.files.end());
    LoadedScene loaded;
    const FilmSettings film = load_film(context, description.film, overrides.resolution);
    const SamplerSettings sampler = load_sampler(context, description.sampler, description.options);
    const IntegratorSettings integrator = load_integrator(context, description.integrator);
    if (!integrator.sees_media) {
        leave_out_media(context, description);
    }
    loaded.resolution = film.resolution;
    loaded.crop = film.crop;
    loaded.film_file = film.file;
    loaded.exposure = film.sensitivity * shutter_time(description.camera);
    loaded.balance = film.balance;
    loaded.colour_space = film.colour_space;
    loaded.filter = load_filter(context, description.filter);
    loaded.sampler = sampler.kind;
    loaded.samples = sampler.samples;
    loaded.seed = sampler.seed;
    loaded.max_depth = integrator.max_depth;
    loaded.scene.light_tree = integrator.light_tree;
    loaded.scene.camera = load_camera(context, description.camera, description.transform_times, film);
    loaded.scene.camera_medium = medium_id(description.camera.medium);
    SceneBuilder(context, description, integrator.sees_media, loaded.scene).build();
    context.warnings.add_unused("Option", description.options);
    loaded.files.assign(context.files->begin(), context.files->end());
    loaded.kept_files = std::move(context.kept_files);
    loaded.warnings = std::move(description.warnings);
    loaded.warnings.insert(loaded.warnings.end(), context.warnings.all().begin(), context.warnings.all().end());
    std::transform(loaded.warnings.begin(), loaded.warnings.end(), loaded.warnings.begin(), readable_message);
    return loaded;
}

}  // namespace

LoadedScene load_scene(pbrt::Description description, const LoadOverrides& overrides, LoadedParts* parts) {
    return with_readable_messages([&] { return build_scene(description, overrides, parts); });
}

}  // namespace wend
