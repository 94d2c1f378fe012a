// What pbrt-v4 only renamed, so that files for pbrt-v3 can be read.
#pragma once

#include <wend/io/pbrt/parameters.h>

#include <functional>
#include <string>
#include <string_view>

namespace wend::pbrt {

/// Turns directives of pbrt-v3 into what pbrt-v4 calls them. Each function changes a type and its parameters where they
/// can only be meant for pbrt-v3, and tells of it; a directive of pbrt-v4 is left as it is. What changed its meaning
/// since throws InputError.
class Version3 {
public:
    /// `warn` is called with what was taken for what.
    using Warn = std::function<void(const Location& place, const std::string& text)>;
    explicit Version3(Warn warn) : warn_(std::move(warn)) {}

    void film(std::string& type, ParameterSet& parameters, const Location& place) const;
    void pixel_filter(const std::string& type, ParameterSet& parameters, const Location& place) const;
    void sampler(std::string& type, const Location& place) const;
    void integrator(std::string& type, ParameterSet& parameters, const Location& place) const;
    void camera(std::string& type, ParameterSet& parameters, const Location& place) const;
    void material(std::string& type, ParameterSet& parameters, const Location& place) const;
    void medium(std::string& type, const Location& place) const;
    void light(const std::string& type, ParameterSet& parameters, const Location& place) const;
    void shape(const std::string& type, ParameterSet& parameters, const Location& place) const;
    /// `kind` is what the texture's values are, "float" or "spectrum" in pbrt-v4.
    void texture(std::string& kind, const std::string& type, ParameterSet& parameters, const Location& place) const;
    /// A directive that pbrt-v4 does not know, found in the file. Whether it means nothing, so that it may be skipped.
    bool skips(std::string_view directive, const Location& place) const;

private:
    void rename_type(std::string& type, std::string_view now, const Location& place) const;
    void rename(ParameterSet& parameters, std::string_view from, std::string_view to) const;
    /// Takes away what pbrt-v4 has no place for.
    void drop(ParameterSet& parameters, std::string_view name) const;
    /// A colour that is grey as the number that pbrt-v4 has in its place.
    void grey_to_number(ParameterSet& parameters, std::string_view name) const;
    void scale_texture(bool real, ParameterSet& parameters) const;
    void say(const Location& place, const std::string& text) const;

    Warn warn_;
};

}  // namespace wend::pbrt
