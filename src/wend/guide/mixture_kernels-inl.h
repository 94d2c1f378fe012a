// The kernels of a mixture (kernels.h), for one vector target.
#include <wend/guide/kernels.h>
#include <wend/numeric/wide-inl.h>

#include <numbers>

#if defined(WEND_GUIDE_MIXTURE_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WEND_GUIDE_MIXTURE_KERNELS_INL_H
#undef WEND_GUIDE_MIXTURE_KERNELS_INL_H
#else
#define WEND_GUIDE_MIXTURE_KERNELS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace wend::guide::HWY_NAMESPACE {

using namespace wend::HWY_NAMESPACE;

static_assert(lanes_per_block == floats_per_block);

/// The lanes from i on.
HWY_INLINE Floats at(const Lanes& lanes, int i) {
    return Floats::load(lanes.value + i);
}

/// Calls body(i) for every first lane of a vector.
template <class Body>
HWY_INLINE void for_lanes(int lanes, const Body& body) {
    for (int i = 0; i < lanes; i += Floats::count) {
        body(i);
    }
}

/// A direction, the same or another in each lane.
struct Directions {
    Floats x, y, z;

    HWY_INLINE Directions(Floats own_x, Floats own_y, Floats own_z) : x(own_x), y(own_y), z(own_z) {}
    HWY_INLINE explicit Directions(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}

    HWY_INLINE Floats squared_distance(const Directions& to) const {
        const Floats dx = x - to.x, dy = y - to.y, dz = z - to.z;
        return dx * dx + dy * dy + dz * dz;
    }
    HWY_INLINE void store(int i, MixtureLanes& mixture) const {
        x.store(mixture.mean_x.value + i);
        y.store(mixture.mean_y.value + i);
        z.store(mixture.mean_z.value + i);
    }
};

/// The means from i on.
HWY_INLINE Directions means(const MixtureLanes& mixture, int i) {
    return {at(mixture.mean_x, i), at(mixture.mean_y, i), at(mixture.mean_z, i)};
}

HWY_INLINE Directions turned_means(const MixtureLanes& mixture, int i, const Vec3& offset,
                                   const Lanes& inverse_distance) {
    const Directions own = means(mixture, i);
    const Floats inverse = at(inverse_distance, i);
    const Floats x = own.x + offset.x * inverse, y = own.y + offset.y * inverse, z = own.z + offset.z * inverse;
    const Floats squared = x * x + y * y + z * z, length = sqrt(squared);
    // 1 / length without waiting for the root.
    const Floats scale = length * (1 / squared);
    // On top of the source no direction is better than another.
    const Floats near = 1e-3f;
    return {where_greater(length, near, x * scale, own.x), where_greater(length, near, y * scale, own.y),
            where_greater(length, near, z * scale, own.z)};
}

HWY_INLINE float density(const MixtureLanes& mixture, const Directions& direction) {
    return sum_over(mixture.lanes(), [&](int i) HWY_ATTR {
        const Floats squared = direction.squared_distance(means(mixture, i));
        return at(mixture.amplitude, i) *
               fast_exp2(-0.5f * std::numbers::log2e_v<float> * at(mixture.kappa, i) * squared);
    });
}

inline float density(const MixtureLanes& mixture, const Vec3& direction) {
    return density(mixture, Directions(direction));
}

inline void turn(const MixtureLanes& mixture, const Vec3& offset, const Lanes& inverse_distance, MixtureLanes& turned) {
    for_lanes(mixture.lanes(),
              [&](int i) HWY_ATTR { turned_means(mixture, i, offset, inverse_distance).store(i, turned); });
    turned.kappa.copy(mixture.blocks(), mixture.kappa);
    turned.weight.copy(mixture.blocks(), mixture.weight);
    turned.amplitude.copy(mixture.blocks(), mixture.amplitude);
}

}  // namespace wend::guide::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
