// Objects of a Mitsuba scene: what their properties say.
#pragma once

#include <wend/core/transform.h>
#include <wend/core/vector.h>
#include <wend/io/mitsuba/element.h>
#include <wend/io/pbrt/description_builder.h>

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace wend::mitsuba {

/// What all who read a scene share.
struct Context {
    const Document& document;
    pbrt::DescriptionBuilder& builder;
    std::unordered_set<const Element*> used{};  ///< that somebody asked for
    std::set<std::filesystem::path> files{};    ///< that were read, beside those of the document
    int names = 0;                              ///< that were made up

    /// One that no file gives anything.
    std::string new_name() { return "#" + std::to_string(++names); }
    void warn(const pbrt::Location& place, const std::string& text) { builder.warn(place, text); }
};

/// Numbers between spaces and commas. Throws InputError for what is none, or not finite.
std::vector<double> numbers_of(std::string_view text, const pbrt::Location& place);

/// An element with a type: properties by their names, of which each getter marks what it returns as used. All throw
/// InputError at a property of another kind, that is given twice, or whose value is no such.
class Object {
public:
    Object(Context& context, const Element& element) : context_(context), element_(element) {}

    const Element& element() const { return element_; }
    const pbrt::Location& place() const { return element_.place; }
    std::string_view type() const { return element_.attribute("type"); }
    bool is_one_of(std::initializer_list<std::string_view> types) const;
    /// `<bsdf type="diffuse">`, for messages.
    std::string title() const;

    /// The property or object of this name, references resolved; null where it is absent.
    const Element* find(std::string_view name) const;
    /// Where it is, or the object.
    const pbrt::Location& place_of(std::string_view name) const;
    bool has(std::string_view name) const { return find(name) != nullptr; }

    double number(std::string_view name, double fallback) const;
    /// Throws InputError unless the number is above 0, or not below it.
    double positive(std::string_view name, double fallback) const;
    double non_negative(std::string_view name, double fallback) const;
    int integer(std::string_view name, int fallback) const;
    bool flag(std::string_view name, bool fallback) const;
    std::string text(std::string_view name, const std::string& fallback) const;
    std::optional<Vec3> vector(std::string_view name) const;
    Transform transform(std::string_view name) const;
    /// The existing file that a text names. Throws InputError where there is none, or no such text.
    std::filesystem::path file(std::string_view name) const;

    /// Objects of a tag, whatever their names, references resolved.
    std::vector<const Element*> nested(std::string_view tag) const;
    /// The one of a tag; null where there is none. Throws InputError where there are several.
    const Element* nested_one(std::string_view tag) const;

    /// Says which properties nobody asked for.
    void warn_of_unused() const;
    /// That a property is known, but of no matter.
    void ignore(std::string_view name) const { static_cast<void>(find(name)); }

    Context& context() const { return context_; }

private:
    const Element& resolved(const Element& child) const;
    const Element* find_property(std::string_view name, std::string_view tag) const;

    Context& context_;
    const Element& element_;
};

/// "<bsdf type="frob"> is unknown; known are ...", with its place.
[[noreturn]] void refuse_type(const Object& object, const std::string& known);

}  // namespace wend::mitsuba
