// The decisions of a walk, as a bundle of values.
#pragma once

#include <wend/decision/direction.h>
#include <wend/decision/distance.h>
#include <wend/decision/roulette_splitting.h>

namespace wend {

template <class D>
concept WalkDecisions = requires(const D& d) {
    requires DistanceDecision<decltype(d.distance)>;
    requires RouletteSplittingDecision<decltype(d.survival)>;
    d.direction;
};

struct ClassicalDecisions {
    ClassicalDistance distance;
    ClassicalDirection direction;
    ClassicalRoulette survival;
};

template <class Field, class Distance, class Survival>
struct GuidedDecisions {
    Distance distance;
    GuidedDirection<Field> direction;
    Survival survival;
};
// C++20 deduces this by itself, but clang only from version 17 on.
template <class Field, class Distance, class Survival>
GuidedDecisions(Distance, GuidedDirection<Field>, Survival) -> GuidedDecisions<Field, Distance, Survival>;

}  // namespace wend
