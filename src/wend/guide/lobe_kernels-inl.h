// The kernel that fitting a cell's lobes spends its time in (kernels.h), for one vector target.
#include <wend/guide/kernels.h>
#include <wend/guide/mixture_kernels-inl.h>

#include <algorithm>
#include <array>

#if defined(WEND_GUIDE_LOBE_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WEND_GUIDE_LOBE_KERNELS_INL_H
#undef WEND_GUIDE_LOBE_KERNELS_INL_H
#else
#define WEND_GUIDE_LOBE_KERNELS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace wend::guide::HWY_NAMESPACE {

/// An observation as each lobe sees it.
struct alignas(cache_line) SeenByLobes {
    /// Re-aimed at the reference point, and its squared distance from the lobe's mean.
    Lanes x{Unset{}}, y{Unset{}}, z{Unset{}}, beyond{Unset{}};
    /// The logarithm of the lobe's density there; then the density over the largest one's.
    Lanes density{Unset{}};
    /// The observation's weight over the sum of these.
    float scale;
};

/// Combines the lanes of whole blocks by an associative and commutative operation, in one order for all widths.
template <class Operation>
HWY_INLINE float reduce(int lanes, const Lanes& numbers, const Operation& combine) {
    static_assert(lanes_per_block == 8);
    // By half blocks: what was just stored by wide instructions comes back at once by narrower ones, not the reverse.
    float b[4];
    for (int j = 0; j < 4; ++j) {
        b[j] = combine(numbers[j], numbers[j + 4]);
    }
    for (int first = lanes_per_block; first < lanes; first += lanes_per_block) {
        for (int j = 0; j < 4; ++j) {
            b[j] = combine(b[j], combine(numbers[first + j], numbers[first + j + 4]));
        }
    }
    return combine(combine(b[0], b[2]), combine(b[1], b[3]));
}

HWY_INLINE void see(const LobeLanes& lobes, int lanes, const Observation& observation, SeenByLobes& seen) {
    const Vec3 w = observation.direction, t = observation.offset;
    const float along = dot(w, t);
    const float across = std::max(0.0f, length_squared(t) - along * along);
    for_lanes(lanes, [&](int i) HWY_ATTR {
        // The inverse of VmfMixture::re_aimed: where the ray meets the sphere of the lobe's distance, seen from the
        // reference point.
        const Floats b = at(lobes.inverse_distance, i);
        const Floats inside = 1 - b * b * across;
        const Floats distance = b * along + sqrt(max(inside, 0));
        const Directions direction(distance * w.x - b * t.x, distance * w.y - b * t.y, distance * w.z - b * t.z);
        direction.x.store(seen.x.value + i);
        direction.y.store(seen.y.value + i);
        direction.z.store(seen.z.value + i);
        const Floats beyond = direction.squared_distance({at(lobes.x, i), at(lobes.y, i), at(lobes.z, i)});
        beyond.store(seen.beyond.value + i);
        (at(lobes.log_amplitude, i) - at(lobes.half_kappa, i) * beyond).store(seen.density.value + i);
    });
}

HWY_INLINE void divide(int lanes, const Observation& observation, SeenByLobes& seen) {
    // Shares of a record below this count as none: their squares would be too small to be normal numbers, which
    // processors are slow at.
    constexpr float negligible = 1e-15f;
    const float largest = reduce(lanes, seen.density, [](float a, float b) HWY_ATTR { return a > b ? a : b; });
    for_lanes(lanes, [&](int i) HWY_ATTR {
        const Floats share = fast_exp(at(seen.density, i) - largest);
        where_greater(share, negligible, share, 0).store(seen.density.value + i);
    });
    seen.scale = observation.weight / reduce(lanes, seen.density, [](float a, float b) HWY_ATTR { return a + b; });
}

HWY_INLINE void add(const LobeLanes& lobes, int lanes, const Observation& observation, const SeenByLobes& seen,
                    SumLanes& sums) {
    const Vec3 t = observation.offset;
    const float offset_squared = length_squared(t);
    for_lanes(lanes, [&](int i) HWY_ATTR {
        const auto count = [i](Lanes& sum, Floats term) HWY_ATTR { (at(sum, i) + term).store(sum.value + i); };
        const Floats share = at(seen.density, i), weight = share * seen.scale;
        const Floats x = at(seen.x, i), y = at(seen.y, i), z = at(seen.z, i), beyond = at(seen.beyond, i);
        const Floats mean_x = at(lobes.x, i), mean_y = at(lobes.y, i), mean_z = at(lobes.z, i);
        const Floats weighted_inverse = weight * observation.inverse_distance;
        count(sums.weight, weight);
        count(sums.weight_square, weight * weight);
        count(sums.x, weight * x);
        count(sums.y, weight * y);
        count(sums.z, weight * z);
        count(sums.offset_x, weight * t.x);
        count(sums.offset_y, weight * t.y);
        count(sums.offset_z, weight * t.z);
        count(sums.inverse_distance, weighted_inverse);
        count(sums.inverse_distance_square, weighted_inverse * observation.inverse_distance);
        // What is left of the turning after re-aiming, and what re-aiming has taken away.
        const Floats mean_offset = t.x * mean_x + t.y * mean_y + t.z * mean_z;
        const Floats direction_offset = t.x * x + t.y * y + t.z * z;
        const Floats mean_direction = x * mean_x + y * mean_y + z * mean_z;
        const Floats spread = weight * (offset_squared - mean_offset * mean_offset);
        count(sums.turn,
              weight * (direction_offset - mean_offset * mean_direction) + at(lobes.inverse_distance, i) * spread);
        count(sums.spread, spread);
        const Floats u = x * at(lobes.u_x, i) + y * at(lobes.u_y, i) + z * at(lobes.u_z, i);
        const Floats v = x * at(lobes.v_x, i) + y * at(lobes.v_y, i) + z * at(lobes.v_z, i);
        count(sums.straight, weight * (u * u - v * v));
        count(sums.oblique, weight * (2 * u * v));
        // 1 - cos is half the squared chord.
        count(sums.beyond_square, 0.25f * weight * (beyond * beyond));
        count(sums.red, share * (observation.red * seen.scale));
        count(sums.blue, share * (observation.blue * seen.scale));
    });
}

inline void add_observations(const LobeLanes& lobes, std::span<const Observation> observations, SumLanes& sums) {
    const int lanes = lobes.blocks * lanes_per_block;
    // A few at a time, step by step: a single observation is one long chain of dependent operations, which leaves most
    // of a processor waiting.
    constexpr std::size_t group_size = 8;
    std::array<SeenByLobes, group_size> seen;
    for (; !observations.empty(); observations = observations.subspan(std::min(group_size, observations.size()))) {
        const auto group = observations.first(std::min(group_size, observations.size()));
        for (std::size_t k = 0; k < group.size(); ++k) {
            see(lobes, lanes, group[k], seen[k]);
        }
        for (std::size_t k = 0; k < group.size(); ++k) {
            divide(lanes, group[k], seen[k]);
        }
        for (std::size_t k = 0; k < group.size(); ++k) {
            add(lobes, lanes, group[k], seen[k], sums);
        }
    }
}

}  // namespace wend::guide::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
