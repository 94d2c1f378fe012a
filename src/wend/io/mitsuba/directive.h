// What a scene is described in: pbrt's directives, each with the place in the Mitsuba scene that it comes from.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/transform.h>
#include <wend/io/mitsuba/object.h>
#include <wend/io/pbrt/parameters.h>

#include <array>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace wend::mitsuba {

/// The name of a texture that was added to the scene.
struct TextureRef {
    std::string name;
};

/// A colour or number, or a texture of such.
using ColourOrTexture = std::variant<Rgb, TextureRef>;
using NumberOrTexture = std::variant<float, TextureRef>;

/// The parameters of a directive.
class Parameters {
public:
    explicit Parameters(pbrt::Location place) : set_(place), place_(std::move(place)) {}

    Parameters& real(std::string name, double value) {
        return add(pbrt::ParameterType::real, std::move(name), std::vector<float>{static_cast<float>(value)});
    }
    Parameters& integer(std::string name, int value) {
        return add(pbrt::ParameterType::integer, std::move(name), std::vector<int>{value});
    }
    Parameters& flag(std::string name, bool value) {
        return add(pbrt::ParameterType::boolean, std::move(name), std::vector<bool>{value});
    }
    Parameters& text(std::string name, std::string value) {
        return add(pbrt::ParameterType::string, std::move(name), std::vector<std::string>{std::move(value)});
    }
    Parameters& colour(std::string name, const Rgb& value) {
        return add(pbrt::ParameterType::rgb, std::move(name), std::vector<float>{value.r, value.g, value.b});
    }
    Parameters& colour(std::string name, const ColourOrTexture& value) {
        const auto* texture = std::get_if<TextureRef>(&value);
        return texture ? add_texture(std::move(name), *texture) : colour(std::move(name), std::get<Rgb>(value));
    }
    Parameters& real(std::string name, const NumberOrTexture& value) {
        const auto* texture = std::get_if<TextureRef>(&value);
        return texture ? add_texture(std::move(name), *texture) : real(std::move(name), double{std::get<float>(value)});
    }
    Parameters& point(std::string name, const Vec3& value) {
        return add(pbrt::ParameterType::point3, std::move(name), std::vector<float>{value.x, value.y, value.z});
    }
    Parameters& add(pbrt::ParameterType type, std::string name, pbrt::ParameterValues values) {
        set_.add({type, std::move(name), place_, pbrt::ColourSpace::srgb, std::move(values)});
        return *this;
    }
    /// Those of another, too.
    Parameters& add(const pbrt::ParameterSet& others) {
        set_.override_with(others);
        return *this;
    }

    const pbrt::Location& place() const { return place_; }
    pbrt::ParameterSet take() { return std::move(set_); }

private:
    Parameters& add_texture(std::string name, const TextureRef& texture) {
        return add(pbrt::ParameterType::texture, std::move(name), std::vector<std::string>{texture.name});
    }

    pbrt::ParameterSet set_;
    pbrt::Location place_;
};

/// Adds directives that have a transform, and change nothing for those after them.
template <class Action>
void in_block(Context& context, const Transform& transform, const pbrt::Location& place, const Action& action) {
    context.builder.attribute_begin(place);
    std::array<double, 16> column_major{};
    for (std::size_t i = 0; i < column_major.size(); ++i) {
        column_major[i] = transform.element(static_cast<int>(i % 4), static_cast<int>(i / 4));
    }
    context.builder.transform(column_major, place);
    action();
    context.builder.attribute_end(place);
}

}  // namespace wend::mitsuba
