#include <wend/io/mitsuba/object.h>

#include <wend/core/error.h>
#include <wend/io/mitsuba/document.h>
#include <wend/io/mitsuba/transforms.h>

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

namespace wend::mitsuba {
namespace {

constexpr std::string_view spaces = " \t\r\n";

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(spaces);
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(spaces) - first + 1);
}

double number_of(std::string_view text, const pbrt::Location& place) {
    const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value) ||
        std::abs(value) > double{std::numeric_limits<float>::max()}) {
        throw InputError(place, fmt::format("\"{}\" is no number", text.substr(0, 80)));
    }
    return value;
}

}  // namespace

std::vector<double> numbers_of(std::string_view text, const pbrt::Location& place) {
    constexpr std::string_view separators = " ,\t\r\n";
    std::vector<double> numbers;
    for (std::size_t begin = text.find_first_not_of(separators); begin != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
        numbers.push_back(number_of(text.substr(begin, end - begin), place));
        begin = text.find_first_not_of(separators, end);
    }
    return numbers;
}

bool Object::is_one_of(std::initializer_list<std::string_view> types) const {
    return std::find(types.begin(), types.end(), type()) != types.end();
}

std::string Object::title() const {
    return fmt::format("<{} type=\"{}\">", element_.tag, type());
}

const Element& Object::resolved(const Element& child) const {
    if (child.tag != "ref") {
        return child;
    }
    const auto found = context_.document.ids.find(std::string(child.attribute("id")));
    if (found == context_.document.ids.end()) {
        throw InputError(child.place, fmt::format("nothing has the id \"{}\"", child.attribute("id")));
    }
    return *found->second;
}

const Element* Object::find(std::string_view name) const {
    const Element* found = nullptr;
    for (const std::unique_ptr<Element>& child : element_.children) {
        if (child->attribute("name") != name) {
            continue;
        }
        if (found) {
            throw InputError(child->place, fmt::format("\"{}\" of {} is given twice", name, title()));
        }
        found = child.get();
        context_.used.insert(found);
    }
    return found ? &resolved(*found) : nullptr;
}

const pbrt::Location& Object::place_of(std::string_view name) const {
    for (const std::unique_ptr<Element>& child : element_.children) {
        if (child->attribute("name") == name) {
            return child->place;
        }
    }
    return place();
}

const Element* Object::find_property(std::string_view name, std::string_view tag) const {
    const Element* found = find(name);
    if (found && found->tag != tag) {
        throw InputError(found->place,
                         fmt::format("\"{}\" of {} is a <{}>, not a <{}>", name, title(), tag, found->tag));
    }
    return found;
}

double Object::number(std::string_view name, double fallback) const {
    const Element* found = find(name);
    if (!found) {
        return fallback;
    }
    if (found->tag != "float" && found->tag != "integer") {
        throw InputError(found->place,
                         fmt::format("\"{}\" of {} is a number here, not a <{}>", name, title(), found->tag));
    }
    return number_of(trimmed(found->attribute("value")), found->place);
}

double Object::positive(std::string_view name, double fallback) const {
    const double value = number(name, fallback);
    if (!(value > 0)) {
        throw InputError(place_of(name), fmt::format("\"{}\" must be above 0, not {}", name, value));
    }
    return value;
}

double Object::non_negative(std::string_view name, double fallback) const {
    const double value = number(name, fallback);
    if (!(value >= 0)) {
        throw InputError(place_of(name), fmt::format("\"{}\" must not be below 0, but is {}", name, value));
    }
    return value;
}

int Object::integer(std::string_view name, int fallback) const {
    const Element* found = find_property(name, "integer");
    if (!found) {
        return fallback;
    }
    const std::string_view text = trimmed(found->attribute("value"));
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
        throw InputError(found->place, fmt::format("\"{}\" is no whole number", text.substr(0, 80)));
    }
    return value;
}

bool Object::flag(std::string_view name, bool fallback) const {
    const Element* found = find_property(name, "boolean");
    if (!found) {
        return fallback;
    }
    const std::string_view text = trimmed(found->attribute("value"));
    const bool is_true = text == "true" || text == "True" || text == "TRUE";
    if (!is_true && text != "false" && text != "False" && text != "FALSE") {
        throw InputError(found->place, fmt::format("\"{}\" is neither true nor false", text.substr(0, 80)));
    }
    return is_true;
}

std::string Object::text(std::string_view name, const std::string& fallback) const {
    const Element* found = find_property(name, "string");
    return found ? std::string(found->attribute("value")) : fallback;
}

std::optional<Vec3> Object::vector(std::string_view name) const {
    const Element* found = find(name);
    if (!found) {
        return std::nullopt;
    }
    if (found->tag != "vector" && found->tag != "point") {
        throw InputError(found->place,
                         fmt::format("\"{}\" of {} is a vector or a point, not a <{}>", name, title(), found->tag));
    }
    return Vec3(vector_of(*found, 0));
}

Transform Object::transform(std::string_view name) const {
    const Element* found = find_property(name, "transform");
    return found ? transform_of(*found) : Transform();
}

std::filesystem::path Object::file(std::string_view name) const {
    const std::string given = text(name, "");
    if (given.empty()) {
        throw InputError(place_of(name), fmt::format("{} needs the property \"{}\"", title(), name));
    }
    std::filesystem::path path = find_file(context_.document, given, place_of(name));
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        throw InputError(place_of(name), fmt::format("there is no file \"{}\"", path.string()));
    }
    context_.files.insert(path);
    return path;
}

std::vector<const Element*> Object::nested(std::string_view tag) const {
    std::vector<const Element*> found;
    for (const std::unique_ptr<Element>& child : element_.children) {
        const Element& target = resolved(*child);
        if (target.tag == tag) {
            context_.used.insert(child.get());
            found.push_back(&target);
        }
    }
    return found;
}

const Element* Object::nested_one(std::string_view tag) const {
    const std::vector<const Element*> found = nested(tag);
    if (found.size() > 1) {
        throw InputError(found[1]->place, fmt::format("{} takes one <{}>, not {}", title(), tag, found.size()));
    }
    return found.empty() ? nullptr : found.front();
}

void Object::warn_of_unused() const {
    for (const std::unique_ptr<Element>& child : element_.children) {
        if (!context_.used.contains(child.get())) {
            const std::string_view name = child->attribute("name");
            context_.warn(child->place, name.empty() ? fmt::format("<{}> in {} is not used", child->tag, title())
                                                     : fmt::format("\"{}\" of {} is not used", name, title()));
        }
    }
}

void refuse_type(const Object& object, const std::string& known) {
    throw InputError(object.place(), fmt::format("{} is unknown; known are {}", object.title(), known));
}

}  // namespace wend::mitsuba
