// A transform that changes with time.
#pragma once

#include <wend/core/transform.h>

#include <cstddef>
#include <vector>

namespace wend {

/// Where something stands, both ways.
struct Placement {
    AffineMap world_from_object;
    AffineMap object_from_world;
};

/// A transform from time 0 to time 1, as in pbrt: place and stretch change evenly, and it turns evenly by the shortest
/// way (shoemake1992).
///
/// It is held as transforms at equal steps of time. Between them matrices are interpolated, as Embree does it, so that
/// what rays hit and what is known of the hit agree. A step turns by no more than 1/128 of a half turn: what is away
/// from the axis comes nearer to it by 8e-5 at most.
class Motion {
public:
    /// At rest.
    Motion(const Transform& still = {}) : first_(still) {}
    /// Throws std::domain_error if only one of the two mirrors: between them there would be none.
    Motion(const Transform& start, const Transform& end);

    /// Of what moves within what moves.
    Motion operator*(const Motion& inner) const;

    bool is_moving() const { return !later_.empty(); }
    /// Time 0.
    const Transform& start() const { return first_; }
    /// At equal steps of time, the first at 0 and the last at 1; one of what is at rest.
    std::size_t key_count() const { return 1 + later_.size(); }
    const Transform& key(std::size_t i) const { return i == 0 ? first_ : later_[i - 1]; }

    /// At a time from 0 to 1.
    Placement at(float time) const;

    friend bool operator==(const Motion&, const Motion&) = default;

private:
    Transform first_;
    std::vector<Transform> later_;
};

}  // namespace wend
