// The parameters of one directive, asked for by name and type.
#pragma once

#include <wend/core/vector.h>
#include <wend/io/pbrt/parameter.h>

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace wend::pbrt {

/// What follows a directive, and behind it the defaults of the Attribute directives in force.
///
/// A getter returns the default (or nothing, or an empty list) where the parameter is absent, and throws InputError at
/// the place of the parameter where it has another type or, for single values, another count. Every getter marks its
/// parameter as looked up; the marks are shared by copies, and getters are not thread-safe.
class ParameterSet {
public:
    ParameterSet() = default;
    /// `directive` is the place to blame for what is missing.
    explicit ParameterSet(Location directive, ColourSpace space = ColourSpace::srgb)
        : directive_(std::move(directive)), colour_space_(space) {}

    /// Takes the place of one of this name (whatever its type), which it returns: null if there was none. Throws
    /// InputError if there are far too many.
    std::shared_ptr<const Parameter> add(Parameter parameter);
    /// Gives one of the directive's own parameters another name, in the place of one that has it. Nothing happens where
    /// it is absent.
    void rename(std::string_view from, std::string to);
    /// Takes one of the directive's own parameters away; null where it is absent.
    std::shared_ptr<const Parameter> remove(std::string_view name);
    /// Parameters to fall back on. Replaces earlier ones; may be null.
    void set_defaults(std::shared_ptr<const ParameterSet> defaults) { defaults_ = std::move(defaults); }
    /// Takes over `others`, which override those of the same name.
    void override_with(const ParameterSet& others);

    /// Whether these are the very parameters of the other set, and not just alike.
    bool is_same_as(const ParameterSet& other) const { return own_ == other.own_ && defaults_ == other.defaults_; }
    bool has(std::string_view name) const { return find(name) != nullptr; }
    /// That of the directive.
    ColourSpace colour_space() const { return colour_space_; }
    /// The type under which a parameter was given; does not mark it as looked up.
    std::optional<ParameterType> type_of(std::string_view name) const;
    /// The place of the parameter, or of the directive if it is absent: for messages about its value.
    const Location& place_of(std::string_view name) const;

    float get_float(std::string_view name, float fallback) const;
    int get_int(std::string_view name, int fallback) const;
    bool get_bool(std::string_view name, bool fallback) const;
    std::string get_string(std::string_view name, const std::string& fallback) const;
    Vec2 get_point2(std::string_view name, const Vec2& fallback) const;
    Vec2 get_vector2(std::string_view name, const Vec2& fallback) const;
    Vec3 get_point3(std::string_view name, const Vec3& fallback) const;
    Vec3 get_vector3(std::string_view name, const Vec3& fallback) const;
    Vec3 get_normal3(std::string_view name, const Vec3& fallback) const;

    /// rgb, spectrum or blackbody.
    std::optional<ColourValue> get_colour(std::string_view name) const;
    /// rgb, spectrum, blackbody or texture.
    std::optional<std::variant<ColourValue, TextureName>> get_colour_or_texture(std::string_view name) const;
    std::variant<float, TextureName> get_float_or_texture(std::string_view name, float fallback) const;
    std::optional<TextureName> get_texture(std::string_view name) const;

    std::vector<float> get_floats(std::string_view name) const;
    std::vector<int> get_ints(std::string_view name) const;
    std::vector<bool> get_bools(std::string_view name) const;
    std::vector<std::string> get_strings(std::string_view name) const;
    std::vector<Vec2> get_point2s(std::string_view name) const;
    std::vector<Vec2> get_vector2s(std::string_view name) const;
    std::vector<Vec3> get_point3s(std::string_view name) const;
    std::vector<Vec3> get_vector3s(std::string_view name) const;
    std::vector<Vec3> get_normal3s(std::string_view name) const;
    std::vector<RgbColour> get_rgbs(std::string_view name) const;

    /// Moves a large array of numbers out, flat (three floats a point3), leaving the parameter without values: it must
    /// not be asked for again. Copies where the values are shared with another set.
    std::vector<float> take_numbers(std::string_view name, ParameterType type);
    std::vector<int> take_ints(std::string_view name);

    /// The directive's own parameters that nobody has asked for, in the order of the file. Defaults are not listed:
    /// they are meant for some directives and not for others.
    std::vector<const Parameter*> unused() const;

    /// The directive's own, in the order of the file.
    std::vector<const Parameter*> own() const;

    /// Own parameters and then defaults that are not overridden.
    std::vector<const Parameter*> all() const;

private:
    std::shared_ptr<Parameter> find(std::string_view name) const;
    const Parameter* look_up(std::string_view name, std::initializer_list<ParameterType> allowed) const;
    const Parameter* look_up_one(std::string_view name, std::initializer_list<ParameterType> allowed) const;
    template <typename Vector>
    Vector get_vector(std::string_view name, ParameterType type, const Vector& fallback) const;
    template <typename Vector>
    std::vector<Vector> get_vectors(std::string_view name, ParameterType type) const;
    template <typename Value>
    std::vector<Value> get_list(std::string_view name, ParameterType type) const;
    template <typename Value>
    std::vector<Value> take_list(std::string_view name, ParameterType type);

    Location directive_;
    ColourSpace colour_space_ = ColourSpace::srgb;
    std::vector<std::shared_ptr<Parameter>> own_;
    std::shared_ptr<const ParameterSet> defaults_;
};

}  // namespace wend::pbrt
