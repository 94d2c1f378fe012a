// How a stay in a dense medium is sampled.
#pragma once

#include <wend/decision/slab_guide.h>

namespace wend {

/// How stays are sampled.
struct StayPlan {
    /// Of guided stays.
    SlabGuide::Shares shares{1};
    /// Of leaving a stay unguided.
    float unguided_probability = 0;
    /// Whether that means to classical sampling alone, or as well to what the learned field says.
    bool is_unguided_classical = true;
    /// How vertices are connected to lights that the walk may run into as well.
    struct Connecting {
        /// What multiplies the density of the walk's own directions where it is weighed against that of connections. A
        /// guided stay brings nearly the same wherever it ends, to which connections would only add noise; in a thin or
        /// badly guided medium they do the work.
        float preference = 1;
        /// Of connecting a collision at all: where connections count for little they are few.
        float probability = 1;
        /// Of connecting it along a way that boundaries refract, which takes several rays to find.
        float through_boundaries = 0;
        /// Connections of a vertex on a surface that is met from inside. It took many flights to get there, so that
        /// which lamp is chosen should not add to the variance.
        int at_surfaces = 1;
    };
    Connecting guided;    ///< in guided stays
    Connecting unguided;  ///< in others
    /// Of telling the learned field what a guided stay meets on its way: the field takes over where guides are given
    /// up.
    float told_probability = 1;
};

/// What comes after what stays have taught.
enum class NextStays {
    beside_classical,  ///< stays to learn from; unguided ones are left to classical sampling alone
    beside_field,      ///< the same, and unguided ones follow the learned field, as they are going to
    rendering,         ///< stays that teach nothing any more
};

}  // namespace wend
