#include <wend/io/mitsuba/tags.h>

#include <wend/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <span>

namespace wend::mitsuba {
namespace {

/// An attribute that begins with ! must be there.
struct TagRow {
    std::string_view tag;
    TagKind kind;
    std::array<std::string_view, 5> attributes;
};

constexpr std::array<std::string_view, 5> of_objects{"!type", "id", "name", "version"};
constexpr std::array<std::string_view, 5> of_values{"!name", "!value"};
constexpr std::array<std::string_view, 5> of_vectors{"!name", "value", "x", "y", "z"};
constexpr std::array<std::string_view, 5> of_steps{"value", "x", "y", "z"};

constexpr auto rows = std::to_array<TagRow>({
    {"scene", TagKind::object, {"!version", "id", "name", "type"}},
    {"bsdf", TagKind::object, of_objects},
    {"emitter", TagKind::object, of_objects},
    {"film", TagKind::object, of_objects},
    {"integrator", TagKind::object, of_objects},
    {"medium", TagKind::object, of_objects},
    {"phase", TagKind::object, of_objects},
    {"rfilter", TagKind::object, of_objects},
    {"sampler", TagKind::object, of_objects},
    {"sensor", TagKind::object, of_objects},
    {"shape", TagKind::object, of_objects},
    {"texture", TagKind::object, of_objects},
    {"volume", TagKind::object, of_objects},
    {"float", TagKind::property, of_values},
    {"integer", TagKind::property, of_values},
    {"boolean", TagKind::property, of_values},
    {"string", TagKind::property, of_values},
    {"rgb", TagKind::property, of_values},
    {"vector", TagKind::property, of_vectors},
    {"point", TagKind::property, of_vectors},
    {"spectrum", TagKind::property, {"name", "value", "filename", "type", "id"}},
    {"transform", TagKind::transform, {"!name"}},
    {"translate", TagKind::step, of_steps},
    {"scale", TagKind::step, of_steps},
    {"rotate", TagKind::step, {"!angle", "value", "x", "y", "z"}},
    {"lookat", TagKind::step, {"!origin", "!target", "up"}},
    {"matrix", TagKind::step, {"!value"}},
    {"ref", TagKind::reference, {"!id", "name"}},
    {"include", TagKind::include, {"!filename", "name"}},
    {"alias", TagKind::alias, {"!id", "!as"}},
    {"default", TagKind::parameter, {"!name", "!value"}},
    {"path", TagKind::folder, {"!value"}},
});

void check_attributes(const TagRow& row, const Element& element) {
    for (const auto& [name, value] : element.attributes) {
        const bool is_known = std::any_of(row.attributes.begin(), row.attributes.end(), [&](std::string_view known) {
            return name == (known.starts_with('!') ? known.substr(1) : known);
        });
        if (!is_known) {
            throw InputError(element.place, fmt::format("<{}> has no attribute \"{}\"", element.tag, name));
        }
    }
    for (const std::string_view known : row.attributes) {
        if (known.starts_with('!') && !element.has(known.substr(1))) {
            throw InputError(element.place,
                             fmt::format("<{}> needs the attribute \"{}\"", element.tag, known.substr(1)));
        }
    }
}

}  // namespace

TagKind check_tag(const Element& element) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const TagRow& r) { return r.tag == element.tag; });
    if (row == rows.end()) {
        std::string known;
        for (const TagRow& r : rows) {
            known += fmt::format("{}{}", known.empty() ? "" : ", ", r.tag);
        }
        throw InputError(element.place, fmt::format("<{}> is unknown; known are {}", element.tag, known));
    }
    check_attributes(*row, element);
    // Spectra of a type are objects as textures are.
    if (element.tag == "spectrum") {
        if (element.has("type")) {
            return TagKind::object;
        }
        if (!element.has("name") || element.has("value") == element.has("filename")) {
            throw InputError(element.place,
                             "<spectrum> needs a \"name\", and one of \"value\", \"filename\", \"type\"");
        }
    }
    return row->kind;
}

}  // namespace wend::mitsuba
