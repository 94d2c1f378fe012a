#include <wend/io/mitsuba/version0.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace wend::mitsuba {
namespace {

bool is_upper(char c) {
    return std::isupper(static_cast<unsigned char>(c)) != 0;
}

/// "intIOR" as "int_ior".
std::string with_underscores(std::string_view name) {
    std::string result;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (is_upper(name[i]) && i > 0 && !is_upper(name[i - 1])) {
            result += '_';
        }
        result += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
    }
    return result;
}

std::unique_ptr<Element> step(const Element& of, std::string tag, std::string x, std::string y) {
    auto element = std::make_unique<Element>();
    element->tag = std::move(tag);
    element->place = of.place;
    element->attributes = {{"x", std::move(x)}, {"y", std::move(y)}};
    return element;
}

}  // namespace

void rename_version0(Element& element) {
    if (element.tag == "lookAt") {
        element.tag = "lookat";
    }
    for (auto& [key, value] : element.attributes) {
        if (key == "name") {
            value = with_underscores(value);
        }
    }
}

void complete_version0(Element& object) {
    if (object.tag == "bsdf" && object.attribute("type") == "diffuse") {
        for (const std::unique_ptr<Element>& child : object.children) {
            for (auto& [key, value] : child->attributes) {
                value = key == "name" && value == "diffuse_reflectance" ? "reflectance" : value;
            }
        }
    }
    if (object.tag != "texture") {
        return;
    }
    std::array<std::string, 4> values{"0", "0", "1", "1"};
    constexpr std::array<std::string_view, 4> names{"uoffset", "voffset", "uscale", "vscale"};
    bool has_any = false;
    std::erase_if(object.children, [&](const std::unique_ptr<Element>& child) {
        const auto name = std::find(names.begin(), names.end(), child->attribute("name"));
        if (child->tag != "float" || name == names.end()) {
            return false;
        }
        values[static_cast<std::size_t>(name - names.begin())] = child->attribute("value");
        return has_any = true;
    });
    if (has_any) {
        auto transform = std::make_unique<Element>();
        transform->tag = "transform";
        transform->place = object.place;
        transform->attributes = {{"name", "to_uv"}};
        transform->children.push_back(step(object, "translate", values[0], values[1]));
        transform->children.push_back(step(object, "scale", values[2], values[3]));
        object.children.push_back(std::move(transform));
    }
}

}  // namespace wend::mitsuba
