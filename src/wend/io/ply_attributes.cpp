#include <wend/io/ply_attributes.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace wend::ply {
namespace {

constexpr float largest_byte = 255;

/// Where a property of this name is that is no list; none if there is none.
std::optional<std::size_t> find(const Element& element, std::string_view name) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        if (element.properties[i].name == name && !element.properties[i].count_type) {
            return i;
        }
    }
    return std::nullopt;
}

/// What the names of an attribute's fields end on.
constexpr std::array<std::string_view, 4> endings = {"xyz", "rgb", "012", "123"};
constexpr std::string_view colour_ending = endings[1];

/// The ending of which a name has the letter at a place, or none.
std::optional<std::string_view> ending_of(std::string_view name, std::size_t at) {
    if (name.size() < 3 || name[name.size() - 2] != '_') {
        return std::nullopt;
    }
    const auto found =
        std::find_if(endings.begin(), endings.end(), [&](std::string_view e) { return e[at] == name.back(); });
    return found == endings.end() ? std::nullopt : std::optional(*found);
}

void set_scale(const Element& element, AttributeFields& fields) {
    if (element.properties[fields.fields.front()].type == Type::uint8 && fields.fields.size() == 3) {
        fields.scale = 1 / largest_byte;
    }
}

}  // namespace

std::vector<AttributeFields> attributes_of(const Element& element, std::string_view prefix) {
    std::vector<AttributeFields> attributes;
    for (const auto& names : {std::array<std::string_view, 3>{"r", "g", "b"}, {"red", "green", "blue"}}) {
        const auto r = find(element, names[0]), g = find(element, names[1]), b = find(element, names[2]);
        if (r && g && b) {
            attributes.push_back({std::string(prefix) + "color", {*r, *g, *b}});
            break;
        }
    }
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const std::string& name = element.properties[i].name;
        const auto ending = ending_of(name, 0);
        if (!ending || element.properties[i].count_type || name.starts_with("texture_")) {
            continue;
        }
        const std::string stem = name.substr(0, name.size() - 2);
        AttributeFields attribute{std::string(prefix) + stem + (*ending == colour_ending ? "_color" : ""), {i}};
        const auto second = find(element, stem + "_" + (*ending)[1]), third = find(element, stem + "_" + (*ending)[2]);
        if (second && third) {
            attribute.fields.insert(attribute.fields.end(), {*second, *third});
        }
        // Numbers that begin with 0 do not begin with 1 as well.
        const bool is_within = name.ends_with("_1") && find(element, stem + "_0");
        const bool is_known = std::any_of(attributes.begin(), attributes.end(),
                                          [&](const AttributeFields& other) { return other.name == attribute.name; });
        if (second.has_value() == third.has_value() && !is_known && !is_within) {
            attributes.push_back(std::move(attribute));
        }
    }
    for (AttributeFields& attribute : attributes) {
        set_scale(element, attribute);
    }
    return attributes;
}

AttributeRows::AttributeRows(const Element& element, std::string_view prefix)
    : fields_(attributes_of(element, prefix)), row_(element.properties.size()) {
    for (const AttributeFields& fields : fields_) {
        attributes_.push_back({fields.name, fields.fields.size(), {}});
    }
}

void AttributeRows::add_row() {
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        for (const std::size_t field : fields_[i].fields) {
            attributes_[i].values.push_back(row_[field] * fields_[i].scale);
        }
    }
}

}  // namespace wend::ply
