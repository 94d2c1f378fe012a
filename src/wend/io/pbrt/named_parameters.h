// The parameters of a whole scene under one name each, to list and to change them.
#pragma once

#include <wend/io/pbrt/description.h>

#include <string>
#include <vector>

namespace wend::pbrt {

/// A parameter of a scene.
struct NamedParameter {
    /// Of the directive, a point, and of the parameter: `camera`, `film`, `filter`, `sampler`, `integrator` (there is
    /// one of each), `medium.NAME`, `material.NAME`, `texture.NAME` for what has a name, and by number in the order of
    /// the file, from 0, `light[2]`, `arealight[0]`, `shape[5]`, `material[0]` (before any Material). Thus
    /// `medium.fog.sigma_s` and `light[0].power`.
    std::string name;
    const Parameter* parameter;
};

/// Those that the file gives, in the order of directives above. They live as long as the description.
std::vector<NamedParameter> named_parameters(const Description& description);

/// Gives a parameter another value, or adds it to its directive; other descriptions that share it keep theirs. What it
/// is called and where it stands is for this function to fill in: the parameter's own name and place are ignored.
/// Throws InputError, naming those that there are, for a directive that the description has not. Whether the directive
/// knows such a parameter is for its reader to say.
void set_parameter(Description& description, const std::string& name, Parameter value);

}  // namespace wend::pbrt
