#include <wend/io/pbrt/named_parameters.h>

#include <wend/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace wend::pbrt {
namespace {

/// Calls visit(name, parameters, place) for every directive that has a name here; a numbered and named one twice.
template <class AnyDescription, class Visit>
void for_each_directive(AnyDescription& d, const Visit& visit) {
    const auto one = [&](const std::string& name, auto& entity) { visit(name, entity.parameters, entity.place); };
    one("camera", d.camera);
    one("film", d.film);
    one("filter", d.filter);
    one("sampler", d.sampler);
    one("integrator", d.integrator);
    const auto named = [&](const char* kind, auto& entities) {
        for (std::size_t i = 0; i < entities.size(); ++i) {
            const std::string& name = entities[i].name;
            one(name.empty() ? fmt::format("{}[{}]", kind, i) : fmt::format("{}.{}", kind, name), entities[i]);
        }
    };
    const auto numbered = [&](const char* kind, auto& entities) {
        for (std::size_t i = 0; i < entities.size(); ++i) {
            one(fmt::format("{}[{}]", kind, i), entities[i]);
        }
    };
    named("medium", d.media);
    named("material", d.materials);
    named("texture", d.textures);
    numbered("light", d.lights);
    numbered("arealight", d.area_lights);
    numbered("shape", d.shapes);
}

/// A few names for a message; shapes are many and alike.
std::string directive_names(const Description& description) {
    constexpr std::size_t most = 30;
    std::vector<std::string> names;
    for_each_directive(description, [&](const std::string& name, const ParameterSet&, const Location&) {
        if (!name.starts_with("shape[") || name == "shape[0]") {
            names.push_back(name);
        }
    });
    const std::size_t shown = std::min(most, names.size());
    return fmt::format("{}{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                       shown < names.size() ? ", ..." : "");
}

}  // namespace

std::vector<NamedParameter> named_parameters(const Description& description) {
    std::vector<NamedParameter> all;
    for_each_directive(description, [&](const std::string& name, const ParameterSet& parameters, const Location&) {
        for (const Parameter* parameter : parameters.own()) {
            all.push_back({name + "." + parameter->name, parameter});
        }
    });
    return all;
}

void set_parameter(Description& description, const std::string& name, Parameter value) {
    const std::size_t point = name.rfind('.');
    bool found = false;
    if (point != std::string::npos && point + 1 < name.size()) {
        for_each_directive(description,
                           [&](const std::string& directive, ParameterSet& parameters, const Location& place) {
                               if (found || name.compare(0, point, directive) != 0) {
                                   return;
                               }
                               found = true;
                               value.name = name.substr(point + 1);
                               value.place = place;
                               value.looked_up = false;
                               parameters.add(std::move(value));
                           });
    }
    if (!found) {
        throw InputError(
            fmt::format("'{}': the scene has no such directive; write one of these, a point and the "
                        "parameter: {}",
                        name, directive_names(description)));
    }
}

}  // namespace wend::pbrt
