// Parameters that several kinds of media have.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/transform.h>
#include <wend/core/vector.h>
#include <wend/io/load/context.h>
#include <wend/medium/grid.h>
#include <wend/medium/medium.h>

#include <memory>
#include <string_view>

namespace wend {

/// Per unit of length; 1 where it is absent.
Rgb load_coefficient(LoadContext& context, const pbrt::ParameterSet& p, std::string_view name);

/// The emitter's radiance "Le", black where there is none.
Rgb load_emitted(LoadContext& context, const pbrt::ParameterSet& p);

/// pbrt calls it "Lescale", scenes for its earlier versions "LeScale".
std::string_view emission_scale_name(const pbrt::ParameterSet& p);

struct Coefficients {
    Rgb absorption;
    Rgb scattering;
};

/// "sigma_a" and "sigma_s", times "scale".
Coefficients load_coefficients(LoadContext& context, const pbrt::ParameterSet& p);

/// "p0" and "p1": where a grid is, in the medium's space. Throws InputError where that is empty.
Box3 load_box(const pbrt::ParameterSet& p);

/// A medium that glows by its temperature. `scale` multiplies the black body.
std::shared_ptr<GridEmission> make_emission_sampler(const pbrt::ParameterSet& p,
                                                    std::shared_ptr<const Grid> temperature,
                                                    const Transform& index_from_world, float scale);

/// "temperatureoffset" and "temperaturescale" of a grid of temperatures, by which a medium glows.
void set_temperature(const pbrt::ParameterSet& p, std::shared_ptr<const Grid> temperature,
                     const Transform& index_from_world, GridEmission& emission);

/// "glow": what a medium emits per unit of length, whatever it absorbs. One colour, or those at 0, "glowstep",
/// 2 "glowstep", ... kelvin.
std::shared_ptr<GridEmission> load_glow(LoadContext& context, const pbrt::ParameterSet& p);

}  // namespace wend
