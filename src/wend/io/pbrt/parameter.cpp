#include <wend/io/pbrt/parameter.h>

#include <array>

namespace wend::pbrt {
namespace {

struct TypeRow {
    ParameterType type;
    std::string_view name;
    std::string_view synonym;
    int components;
};

// In the order of the enumeration.
constexpr std::array<TypeRow, 13> rows = {{{ParameterType::real, "float", "", 1},
                                           {ParameterType::integer, "integer", "", 1},
                                           {ParameterType::boolean, "bool", "", 1},
                                           {ParameterType::string, "string", "", 1},
                                           {ParameterType::point2, "point2", "", 2},
                                           {ParameterType::vector2, "vector2", "", 2},
                                           {ParameterType::point3, "point3", "point", 3},
                                           {ParameterType::vector3, "vector3", "vector", 3},
                                           {ParameterType::normal3, "normal3", "normal", 3},
                                           {ParameterType::rgb, "rgb", "color", 3},
                                           {ParameterType::spectrum, "spectrum", "", 2},
                                           {ParameterType::blackbody, "blackbody", "", 1},
                                           {ParameterType::texture, "texture", "", 1}}};

}  // namespace

std::string_view to_string(ParameterType type) {
    return rows[static_cast<std::size_t>(type)].name;
}

std::optional<ParameterType> parameter_type_named(std::string_view name) {
    for (const TypeRow& row : rows) {
        if (name == row.name || (name == row.synonym && !name.empty())) {
            return row.type;
        }
    }
    return std::nullopt;
}

std::string parameter_type_names() {
    std::string names;
    for (const TypeRow& row : rows) {
        names += (names.empty() ? "" : ", ") + std::string(row.name);
    }
    return names;
}

int components_of(ParameterType type) {
    return rows[static_cast<std::size_t>(type)].components;
}

std::size_t Parameter::count() const {
    const std::size_t size = std::visit([](const auto& list) { return list.size(); }, values);
    const bool named = std::holds_alternative<std::vector<std::string>>(values);
    return named ? size : size / static_cast<std::size_t>(components_of(type));
}

}  // namespace wend::pbrt
