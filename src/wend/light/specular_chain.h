// Ways to lights through smooth boundaries that refract, which block straight connections.
#pragma once

#include <wend/scene/scene.h>

#include <array>
#include <optional>
#include <span>
#include <variant>

namespace wend {

/// A way that smooth boundaries refract, to a point on a light.
struct SpecularChain {
    /// Within one medium.
    struct Leg {
        Ray ray;
        float length;  ///< infinite for the last one to a light at infinity
        MediumId medium;
        int refractions = 0;  ///< before it
    };

    Vec3 direction;  ///< of its first leg, unit length
    /// Of radiance, by the boundaries: their transmittances over the squared ratios of indices.
    Rgb transmitted{1.0f};
    /// Density of the first direction over that of the straight one to the same point, where points on lights are
    /// drawn.
    float density_ratio = 1;
    int refractions = 0;
    int vertices = 0;  ///< of those, what counts towards a walk's largest depth
    Hit end;           ///< on the light, if it is not at infinity

    std::span<const Leg> legs() const { return {storage_.data(), static_cast<std::size_t>(count_)}; }
    /// Whether there was room for one more.
    bool add(const Leg& leg) {
        if (count_ == most_legs) {
            return false;
        }
        storage_[static_cast<std::size_t>(count_++)] = leg;
        return true;
    }

private:
    static constexpr int most_legs = 16;
    std::array<Leg, most_legs> storage_;
    int count_ = 0;
};

/// The way from `straight.origin`, in `medium`, to the point at `distance` along the straight ray, or to where that
/// ends up in its direction if `distance` is infinite, found by Newton's method from the straight direction
/// (hanika2015, with rays in place of points on the boundaries): a function of its arguments, so that who got there by
/// chance can ask whether it would have been found. Of several ways it is one. Nothing where no boundary refracts, or
/// none of the tries gets there.
std::optional<SpecularChain> find_specular_chain(const Scene& scene, const Ray& straight, float distance,
                                                 const MediumState& medium);

/// Whether connections look for a light behind boundaries: one that rays can meet, and that is not the same from
/// everywhere, which any ray meets as well. Whether a lamp that is partly there is met differs from ray to ray, and
/// what a portal sends from place to place.
inline bool is_seen_through_boundaries(const Light& light) {
    const bool is_lamp = std::holds_alternative<TriangleLight>(light) || std::holds_alternative<QuadricLight>(light);
    return (is_lamp && presence_of(light) == Presence::solid) || std::holds_alternative<ImageInfiniteLight>(light) ||
           std::holds_alternative<SkyDiskLight>(light);
}

}  // namespace wend
