// How an interior walk in a dense medium is sampled.
#pragma once

#include <wend/subsurface/interior_guide.h>

namespace wend {

/// How vertices are connected to lights that the walk may run into as well.
struct NextEventSettings {
    /// What multiplies the density of the walk's own directions where it is weighed against that of connections. A
    /// guided interior walk brings nearly the same wherever it ends, to which connections would only add noise; in
    /// a thin or badly guided medium they do the work.
    float preference = 1;
    /// Of connecting a collision at all: where connections count for little they are few.
    float probability = 1;
    /// Of connecting it along a way that boundaries refract, which takes several rays to find.
    float through_boundaries = 0;
    /// Connections of a vertex on a surface that is met from inside. It took many flights to get there, so that
    /// which lamp is chosen should not add to the variance.
    int at_surfaces = 1;
};

/// How interior walks are sampled.
struct TechniqueMix {
    /// Probability of classical sampling in guided interior walks.
    float defensive_fraction = 1;
    /// Of leaving an interior walk unguided.
    float unguided_probability = 0;
    /// Whether that means to classical sampling alone, or as well to what the learned field says.
    bool is_unguided_classical = true;
    NextEventSettings guided;    ///< in guided interior walks
    NextEventSettings unguided;  ///< in others
    /// Of recording for the learned field what a guided interior walk meets on its way: the field takes over where
    /// guides are given up.
    float recording_probability = 1;

    /// See ListsMembers: it has padding.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& mix) {
        bytes(mix.defensive_fraction, mix.unguided_probability, mix.is_unguided_classical, mix.guided, mix.unguided,
              mix.recording_probability);
    }
};

/// What comes after what interior walks have taught.
enum class NextWalks {
    beside_classical,  ///< interior walks to learn from; unguided ones are left to classical sampling alone
    beside_field,      ///< the same, and unguided ones follow the learned field, as they are going to
    rendering,         ///< interior walks that teach nothing any more
};

}  // namespace wend
