// Phase functions as von Mises–Fisher lobes, for products with learned mixtures (docs/theory/learned_field.md).
#pragma once

#include <wend/medium/phase.h>
#include <wend/sampling/axial_lobes.h>

namespace wend {

/// Henyey and Greenstein's function as one to five lobes, around +z for the direction of propagation before the
/// collision. Over the whole sphere, the ratio to the function stays within 1.022 up to |g| = 0.9, 1.065 up to 0.95,
/// 1.17 up to 0.98 and 1.29 up to 0.99.
AxialLobes lobes_of(const HenyeyGreenstein& phase);

/// The lobes of its parts; the ratio stays within that of the worst part.
AxialLobes lobes_of(const HenyeyGreensteinMixture& phase);

/// Two for each of Henyey and Greenstein's. cosh(k cosine) with cosh(k) = 1 + alpha stands for 1 + alpha cosine²: lobes
/// that only add up cannot follow it closer. Between the directions where the ratio to the function is largest and
/// least, it differs by a factor of 1.03 at alpha = 1, 2.5 at 40 and 7.2 at 250, beside that of the lobes of g.
AxialLobes lobes_of(const Draine& phase);

}  // namespace wend
