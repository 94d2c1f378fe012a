#include <wend/app/parsed_scene.h>
#include <wend/core/error.h>
#include <wend/io/pbrt/named_parameters.h>
#include <wend/io/volume_file.h>

#include "bindings.h"

#include <nanobind/stl/variant.h>

#include <fmt/format.h>

namespace wend::python {
namespace {

using ScenePointer = std::shared_ptr<ParsedScene>;

ScenePointer load(const std::string& file, const std::string& resolution, const std::string& crop,
                  std::optional<int> max_depth, const std::string& sampler) {
    const nb::gil_scoped_release release;
    return ParsedScene::load({file, resolution, crop, max_depth, sampler});
}

/// For scenes that a program writes.
ScenePointer load_text(const std::string& text, const std::string& folder, const std::string& name,
                       const std::string& resolution, const std::string& crop, std::optional<int> max_depth,
                       const std::string& sampler) {
    const nb::gil_scoped_release release;
    return ParsedScene::of_text(text, folder, {name, resolution, crop, max_depth, sampler});
}

/// Two corners of the box, in the world of the file, that holds all of a grid.
std::pair<std::array<float, 3>, std::array<float, 3>> volume_bounds(const std::string& file, const std::string& grid) {
    const nb::gil_scoped_release release;
    const Volume volume = read_volume(file, grid);
    const Box3 box = volume.grid.bounds();
    Box3 world;
    for (int corner = 0; corner < 8; ++corner) {
        world.extendBy(
            volume.world_from_index.point(Vec3(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                               corner & 4 ? box.max.z : box.min.z)));
    }
    return {{world.min.x, world.min.y, world.min.z}, {world.max.x, world.max.y, world.max.z}};
}

/// Of each parameter its name, its type as files spell it, and the values, flat; those with more than `most` elements
/// are left out.
std::vector<std::tuple<std::string, std::string, pbrt::ParameterValues>> parameters(const ParsedScene& scene,
                                                                                    std::size_t most) {
    std::vector<std::tuple<std::string, std::string, pbrt::ParameterValues>> all;
    for (const auto& [name, parameter] : pbrt::named_parameters(scene.description())) {
        if (parameter->count() <= most) {
            all.emplace_back(name, to_string(parameter->type), parameter->values);
        }
    }
    return all;
}

/// By name, type and numbers or texts.
using Changes =
    std::vector<std::tuple<std::string, std::string, std::variant<std::vector<double>, std::vector<std::string>>>>;

/// The values as the type wants them; throws InputError for others.
pbrt::ParameterValues values_of(const std::string& name, pbrt::ParameterType type,
                                const std::variant<std::vector<double>, std::vector<std::string>>& given) {
    using enum pbrt::ParameterType;
    const auto* texts = std::get_if<std::vector<std::string>>(&given);
    const bool wants_texts = type == string || type == texture || (type == spectrum && texts);
    if (wants_texts != (texts != nullptr)) {
        throw InputError(fmt::format("{}: a \"{}\" wants {}", name, to_string(type), wants_texts ? "text" : "numbers"));
    }
    if (texts) {
        return *texts;
    }
    const auto& numbers = std::get<std::vector<double>>(given);
    if (type == integer) {
        return std::vector<int>(numbers.begin(), numbers.end());
    }
    if (type == boolean) {
        return std::vector<bool>(numbers.begin(), numbers.end());
    }
    return std::vector<float>(numbers.begin(), numbers.end());
}

ScenePointer with_parameters(const ParsedScene& scene, const Changes& changes) {
    const nb::gil_scoped_release release;
    pbrt::Description description = scene.description();
    std::string text = scene.changes();
    for (const auto& [name, type, given] : changes) {
        const auto known = pbrt::parameter_type_named(type);
        if (!known) {
            throw InputError(fmt::format("{}: unknown type '{}': one of {}", name, type, pbrt::parameter_type_names()));
        }
        pbrt::Parameter parameter;
        parameter.type = *known;
        parameter.values = values_of(name, *known, given);
        const auto per_element = static_cast<std::size_t>(pbrt::components_of(*known));
        const std::size_t count = std::visit([](const auto& list) { return list.size(); }, given);
        if (count == 0 || (std::holds_alternative<std::vector<double>>(given) && count % per_element != 0)) {
            throw InputError(fmt::format("{}: {} numbers make no whole \"{}\"", name, count, type));
        }
        pbrt::set_parameter(description, name, std::move(parameter));
        text += fmt::format("{} {}", type, name);
        std::visit([&](const auto& list) { text += fmt::format(" {}\n", fmt::join(list, " ")); }, given);
    }
    return std::make_shared<ParsedScene>(scene.options(), std::move(description), std::move(text), &scene);
}

}  // namespace

void bind_scenes(nb::module_& module) {
    nb::class_<ParsedScene>(module, "Scene", "A scene and its settings, ready to be rendered.")
        .def_prop_ro("file", [](const ParsedScene& s) { return s.session().scene_file(); })
        .def_prop_ro("film_file", [](const ParsedScene& s) { return s.session().film_file(); })
        .def_prop_ro("resolution",
                     [](const ParsedScene& s) {
                         const Vec2i& size = s.session().resolution();
                         return std::pair(size.x, size.y);
                     })
        .def_prop_ro("spp", [](const ParsedScene& s) { return s.session().settings().samples; })
        .def_prop_ro("max_depth", [](const ParsedScene& s) { return s.session().settings().max_depth; })
        .def_prop_ro("seed", [](const ParsedScene& s) { return s.session().settings().seed; })
        .def_prop_ro("bounds",
                     [](const ParsedScene& s) {
                         const Box3& box = s.session().scene().bounds();
                         return std::pair(std::tuple(box.min.x, box.min.y, box.min.z),
                                          std::tuple(box.max.x, box.max.y, box.max.z));
                     })
        .def_prop_ro("warnings", [](const ParsedScene& s) { return s.session().warnings(); })
        .def(
            "shares_geometry_with",
            [](const ParsedScene& s, const ParsedScene& other) {
                return s.session().scene().shares_geometry_with(other.session().scene());
            },
            nb::arg("other"))
        .def("parameters", &parameters, nb::arg("most"))
        .def("with_parameters", &with_parameters, nb::arg("changes"));
    module.def("volume_bounds", &volume_bounds, nb::arg("file"), nb::arg("grid"),
               "Two corners of the box that holds all of a grid of an OpenVDB or NanoVDB file.");
    module.def("load", &load, nb::arg("file"), nb::arg("resolution"), nb::arg("crop"), nb::arg("max_depth").none(),
               nb::arg("sampler"));
    module.def("load_text", &load_text, nb::arg("text"), nb::arg("folder"), nb::arg("name"), nb::arg("resolution"),
               nb::arg("crop"), nb::arg("max_depth").none(), nb::arg("sampler"));
}

}  // namespace wend::python
