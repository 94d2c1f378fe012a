// The numbers of a product of a mixture with what scatters (product.h).
#pragma once

#include <wend/guide/lanes.h>
#include <wend/sampling/axial_lobes.h>

namespace wend::guide {

/// Of numbers that are not negative, what those before each one add up to, by a tree of few steps: never less than for
/// the one before, and the same across a 0.
struct SumsBelow {
    int lanes;
    float total;
    float sum[max_lobes + 1];
};

/// A product V H / Z.
struct ProductLanes {
    /// Its weights are not set: nothing asks for them.
    MixtureLanes mixture;
    AxialLobes scatterer;
    /// Of the parts that the lobes of the mixture have of Z.
    SumsBelow below;
    /// Z, and what the product of densities is multiplied by.
    float integral, scale;
    /// Of each pair of lobes, those of one axial lobe side by side, what the pairs up to it have of the part, so that a
    /// sample need not find them again. Only the pairs there are have some.
    float pair_sums[AxialLobes::capacity * max_lobes];

    ProductLanes(int lobes, const AxialLobes& other) : mixture(lobes, Unset{}), scatterer(other) {}

    /// The part of Z that each lobe of the mixture has.
    const float* parts() const { return pair_sums + (scatterer.size() - 1) * mixture.lanes(); }
};

}  // namespace wend::guide
