#include <wend/app/extra_layers.h>

#include <wend/core/error.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace wend {
namespace {

constexpr std::array<std::pair<std::string_view, PathPart>, path_parts> parts_by_path{
    {{"emission", PathPart::emission},
     {"background", PathPart::background},
     {"direct", PathPart::direct},
     {"indirect", PathPart::indirect},
     {"volume", PathPart::volume}}};
constexpr std::string_view lights = "lights", halves = "halves", geometry = "geometry", objects = "cryptomatte";

bool has(const std::vector<std::string>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// The parts of a film in their order.
struct AskedParts {
    std::vector<std::string> names;
    PartsPlan plan;

    AskedParts(const std::vector<std::string>& asked, const Scene& scene) {
        const std::size_t count = scene.lights().size();
        for (std::size_t i = 0; i < count; ++i) {
            plan.is_at_infinity.push_back(is_at_infinity(scene.lights()[i]));
        }
        for (const auto& [name, part] : parts_by_path) {
            if (has(asked, name)) {
                plan.by_path[static_cast<std::size_t>(part)] = add(std::string(name));
            }
        }
        if (has(asked, lights)) {
            add_groups(scene);
        }
        plan.count = static_cast<int>(names.size());
    }

private:
    int add(std::string name) {
        names.push_back(std::move(name));
        return static_cast<int>(names.size()) - 1;
    }

    void add_groups(const Scene& scene) {
        const LightGroups& groups = scene.description().light_groups;
        const int first = static_cast<int>(names.size());
        for (const std::string& name : groups.names) {
            add(light_group_prefix + name);
        }
        const int others = add(std::string(light_group_prefix) + LightGroups::rest);
        const auto part_of = [&](int group) { return group == LightGroups::none ? others : first + group; };
        for (std::size_t id = 0; id < scene.media().size(); ++id) {
            plan.by_medium.push_back(part_of(LightGroups::get(groups.of_media, id)));
        }
        for (std::size_t i = 0; i < scene.lights().size(); ++i) {
            const auto* medium = std::get_if<MediumLight>(&scene.lights()[i]);
            plan.by_light.push_back(medium ? plan.by_medium[static_cast<std::size_t>(medium->medium)]
                                           : part_of(LightGroups::get(groups.of_lights, i)));
        }
    }
};

ObjectIds ids_of(const Scene& scene) {
    const SceneDescription& d = scene.description();
    ObjectIds ids;
    for (std::size_t i = 0; i < d.surfaces.size(); ++i) {
        ids.of_surfaces.push_back(cryptomatte_id(d.names.surface(i)));
    }
    for (std::size_t i = 0; i < d.media.size(); ++i) {
        ids.of_media.push_back(cryptomatte_id(d.names.medium(i)));
    }
    return ids;
}

}  // namespace

std::string extra_layer_names() {
    std::string text;
    for (const auto& [name, part] : parts_by_path) {
        text.append(name).append(", ");
    }
    return text.append(lights).append(", ").append(halves).append(", ").append(geometry).append(", ").append(objects);
}

void check_extra_layers(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        const bool is_part = std::any_of(parts_by_path.begin(), parts_by_path.end(),
                                         [&](const auto& part) { return part.first == name; });
        if (!is_part && name != lights && name != halves && name != geometry && name != objects) {
            throw InputError("layers: there is no '" + name + "', but " + extra_layer_names());
        }
    }
}

FilmLayers film_layers(const std::vector<std::string>& names, const Scene& scene) {
    return {AskedParts(names, scene).names, has(names, halves), has(names, geometry), has(names, objects)};
}

void ask_for_layers(const std::vector<std::string>& names, const Scene& scene, RenderSettings& settings) {
    check_extra_layers(names);
    settings.layers = names;
    std::sort(settings.layers.begin(), settings.layers.end());
    settings.layers.erase(std::unique(settings.layers.begin(), settings.layers.end()), settings.layers.end());
    settings.parts = AskedParts(names, scene).plan;
    if (has(names, objects)) {
        settings.objects = ids_of(scene);
    }
}

}  // namespace wend
