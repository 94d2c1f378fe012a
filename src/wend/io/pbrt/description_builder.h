// The meaning of each directive: one function a directive, called in the order of the file.
#pragma once

#include <wend/io/pbrt/description.h>
#include <wend/io/pbrt/graphics_state.h>
#include <wend/io/pbrt/name_table.h>
#include <wend/io/pbrt/version3.h>

#include <memory>
#include <set>
#include <span>
#include <string>
#include <unordered_set>

namespace wend::pbrt {

/// Collects a Description. Every `place` is that of the directive; all functions throw InputError for what pbrt
/// forbids.
class DescriptionBuilder {
public:
    explicit DescriptionBuilder(std::filesystem::path base_directory);
    DescriptionBuilder(const DescriptionBuilder&) = delete;
    DescriptionBuilder& operator=(const DescriptionBuilder&) = delete;

    bool in_world() const { return in_world_; }
    /// What becomes of directives of pbrt-v3.
    const Version3& version3() const { return version3_; }
    ColourSpace colour_space() const { return states_.current().colour_space; }
    /// Adds a warning, unless it was there before.
    void warn(const Location& place, const std::string& message);
    /// That a parameter is given twice, once for each name.
    void warn_of_repeated(const Parameter& last, const Parameter& earlier);

    // Options, before WorldBegin.
    void accelerator(std::string type, ParameterSet parameters, const Location& place);
    void camera(std::string type, ParameterSet parameters, const Location& place);
    void film(std::string type, ParameterSet parameters, const Location& place);
    void integrator(std::string type, ParameterSet parameters, const Location& place);
    void option(Parameter parameter);
    void pixel_filter(std::string type, ParameterSet parameters, const Location& place);
    void sampler(std::string type, ParameterSet parameters, const Location& place);
    void world_begin(const Location& place);

    // Transforms.
    void active_transform(ActiveTransform which);
    void concat_transform(std::span<const double> column_major, const Location& place);
    void coordinate_system(const std::string& name, const Location& place);
    void coord_sys_transform(const std::string& name, const Location& place);
    void identity(const Location& place);
    void look_at(std::span<const double> eye_look_up, const Location& place);
    void rotate(std::span<const double> degrees_and_axis, const Location& place);
    void scale(std::span<const double> factors, const Location& place);
    void transform(std::span<const double> column_major, const Location& place);
    void transform_times(std::span<const double> start_and_end, const Location& place);
    void translate(std::span<const double> offset, const Location& place);

    // Attributes and blocks.
    void attribute(const std::string& target, ParameterSet parameters, const Location& place);
    void attribute_begin(const Location& place);
    void attribute_end(const Location& place);
    void begin_import(const Location& place);
    void colour_space(const std::string& name, const Location& place);
    void end_import(const Location& place);
    void material(std::string type, ParameterSet parameters, const Location& place);
    void medium_interface(const std::string& interior, const std::string& exterior, const Location& place);
    void named_material(const std::string& name, const Location& place);
    void object_begin(const std::string& name, const Location& place);
    void object_end(const Location& place);
    void reverse_orientation(const Location& place);
    void transform_begin(const Location& place);
    void transform_end(const Location& place);

    // Contents.
    void area_light_source(std::string type, ParameterSet parameters, const Location& place);
    void light_source(std::string type, ParameterSet parameters, const Location& place);
    void make_named_material(std::string name, ParameterSet parameters, const Location& place);
    void make_named_medium(std::string name, ParameterSet parameters, const Location& place);
    void object_instance(const std::string& name, const Location& place);
    void shape(std::string type, ParameterSet parameters, const Location& place);
    void texture(std::string name, std::string kind, std::string type, ParameterSet parameters, const Location& place);

    /// Closes the scene at the end of the main file: everything opened must be closed, and every name used defined.
    Description finish(const Location& end);

private:
    GraphicsState& state() { return states_.current(); }
    /// The start transform, with a warning where it differs from the end transform. Null where it is none, with a
    /// warning that `what` does not have its effect.
    const Transform* still_transform(const Location& place, const std::string& what);
    /// From the start transform to the end transform. Null where one of them is none, with such a warning.
    std::shared_ptr<const Motion> motion(const Location& place, const std::string& what);
    /// At rest, with a warning, where one of the two mirrors and the other does not.
    Motion motion_between(const Transform& start, const Transform& end, const Location& place);
    /// What the graphics state names, from then on to be defined.
    std::optional<std::size_t> use_medium(const std::shared_ptr<const UsedName>& medium);
    std::size_t use_material();
    void require_textures(const ParameterSet& parameters) const;

    Version3 version3_{[this](const Location& place, const std::string& text) { warn(place, text); }};
    Description description_;
    StateStack states_;
    NameTable materials_{"material"};
    NameTable media_{"medium"};
    NameTable objects_{"object"};
    NameTable textures_{"texture"};
    std::unordered_set<std::string> texture_names_;
    std::set<std::string> warned_;
    std::set<std::string> repeated_;
    std::optional<std::size_t> open_object_;
    std::shared_ptr<const Motion> last_motion_;  ///< for the next shape that moves like it
    bool in_world_ = false;
};

}  // namespace wend::pbrt
