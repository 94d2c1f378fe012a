// The constant adjoint: the answer of one who knows nothing, and the exact one in a white furnace.
#pragma once

#include <wend/adjoint/adjoint.h>

namespace wend {

/// The same radiance at every point from every direction. Its incident distribution is the uniform one, a lobe of
/// concentration 0, whose product with a lobe is that lobe and has the integral 1/(4 pi): guiding by it is classical
/// sampling.
class ConstantAdjoint {
public:
    explicit constexpr ConstantAdjoint(float radiance) : radiance_(radiance) {}

    Vmf incident(const Vec3& /*position*/) const { return {}; }
    constexpr float fluence() const { return 4 * pi * radiance_; }

private:
    float radiance_;
};

static_assert(Adjoint<ConstantAdjoint>);

}  // namespace wend
