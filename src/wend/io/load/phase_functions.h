#pragma once

#include <wend/io/load/context.h>
#include <wend/medium/phase.h>

namespace wend {

/// The phase function of a medium: Henyey and Greenstein's by "g", or what the parameter "phase" names, which pbrt does
/// not have:
/// - "henyeygreenstein"; "rayleigh"; "cornetteshanks" by "g"; "draine" by "g" and "alpha" (1 where it is not given);
/// - "henyeygreensteinmixture": up to four of theirs by the lists "g" and "weights";
/// - "fog": droplets of "diameter" micrometres (20), from 5 to 50, as Mie's theory has them (jendersie2023);
/// - "fournierforand": particles in water, of "index" (1.1) and "slope" (3.5835) (fournier1999);
/// - "tabulated": the lists "angles" (degrees, from 0 to 180) and "values", or a "file" of pairs of both, a table of
///   Mie's theory for example; linear in the cosine between them, in any unit.
/// Throws InputError for other names and values out of range.
PhaseFunction load_phase(LoadContext& context, const pbrt::ParameterSet& parameters);

}  // namespace wend
