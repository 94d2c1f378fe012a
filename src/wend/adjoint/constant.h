// The constant adjoint: the answer of one who knows nothing, and the exact one in a white furnace.
#pragma once

#include <wend/adjoint/adjoint.h>
#include <wend/sampling/warp.h>

namespace wend {

/// Equal radiance from everywhere. Its product with lobes is those lobes: guiding by it is classical sampling.
class UniformRadiance {
public:
    class Product : public AxialLobes {
    public:
        explicit Product(const AxialLobes& lobes) : AxialLobes(lobes) {}
        static constexpr float integral() { return inv_4pi; }
    };

    Vec3 sample(Vec2 u) const { return to_sphere(u); }
    float density(const Vec3& /*direction*/) const { return inv_4pi; }
    Product product(const AxialLobes& lobes) const { return Product(lobes); }
};

/// The same radiance at every point from every direction.
class ConstantAdjoint {
public:
    explicit constexpr ConstantAdjoint(float radiance) : radiance_(radiance) {}

    UniformRadiance incident(const Vec3& /*position*/) const { return {}; }
    constexpr float fluence() const { return 4 * pi * radiance_; }
    constexpr Rgb in_scattered(const UniformRadiance::Product& product) const {
        return Rgb(fluence() * product.integral());
    }
    /// Any would do, both ways of sampling being the same; half costs least if they differ by rounding.
    static constexpr float defensive_fraction() { return 0.5f; }

private:
    float radiance_;
};

static_assert(Adjoint<ConstantAdjoint>);

}  // namespace wend
