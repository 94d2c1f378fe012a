// What a walk tells on its way, for path_records.h.
#pragma once

#include <wend/guide/path_records.h>

#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace wend::guide {

/// Writes down the vertices of a walk. The walk tells every factor of its weight and every radiance it finds at the
/// time it does; the log knows which vertex that belongs to. The estimate of the walk and its records so cannot differ.
///
/// A walk may have any number of vertices, its log has not: what is found after the last one belongs to that.
class PathLog {
public:
    /// What the log of one walk holds.
    static constexpr std::size_t most_vertices = 1 << 18;

    /// Forgets the last walk.
    void start() {
        vertices_.clear();
        at_ = {};
    }

    /// The walk's weight was multiplied by this: a flight, survival, a mirror.
    void weigh(const Rgb& weight) { at_.weight *= weight; }

    /// Radiance found here, its own weights included but not the walk's.
    void gather(const Rgb& radiance) {
        if (at_.vertex != PathVertex::root) {
            current().gathered += at_.weight * radiance;
        }
    }

    /// Gathers a medium's own light, which came before any vertex, from this mean distance from the last vertex.
    void glow(const Rgb& radiance, float distance) {
        gather(radiance);
        if (at_.vertex != PathVertex::root) {
            const float seen = mean(at_.weight * radiance);
            current().glow += seen;
            current().glow_over_distance += seen / distance;
        }
    }

    /// The vertex at hand was connected to a light: `fluence` is the radiance over the density of the direction, and
    /// `brought` that times the scattering function, which the walk gathers too. Where there are several connections
    /// they add up, and the direction and the distance are those of one that outweighs those before it.
    void connect(const Vec3& to_light, float distance, float fluence, const Rgb& brought) {
        if (fluence >= at_.light_fluence) {
            at_.to_light = to_light;
            at_.light_distance = distance;
        }
        at_.light_fluence += fluence;
        at_.connected += brought;
    }

    /// The vertex at hand is on a surface: the normal on the side that the walk came from.
    void face(const Vec3& normal) { at_.normal = normal; }

    /// The walk met something at this distance from the last vertex. Only the first time counts.
    void meet(float distance) {
        if (at_.vertex != PathVertex::root && current().distance == std::numeric_limits<float>::infinity()) {
            current().distance = distance;
        }
    }

    /// A direction was drawn and the walk's weight multiplied by `weight`, scattering function over density. Where the
    /// density is that of a mixture, its parts are told as well.
    void scatter(const Vec3& position, const Vec3& direction, float density, const Rgb& weight, bool in_volume,
                 float classical_density = 0, float guided_density = 0) {
        if (vertices_.size() == most_vertices) {
            const Branch last = std::exchange(at_, {});
            at_.vertex = last.vertex;
            at_.weight = last.weight * weight;
            return;
        }
        PathVertex v;
        v.position = position;
        v.direction = direction;
        v.density = density;
        v.classical_density = classical_density;
        v.guided_density = guided_density;
        v.arrival = at_.weight;
        v.scattering = weight;
        v.parent = at_.vertex;
        v.in_volume = in_volume;
        v.normal = at_.normal;
        v.connected = at_.connected;
        v.to_light = at_.to_light;
        v.light_distance = at_.light_distance;
        v.light_fluence = at_.light_fluence;
        at_ = {};
        at_.vertex = static_cast<std::int32_t>(vertices_.size());
        vertices_.push_back(v);
    }

    /// The same of a direction as decisions draw it (DirectionSample).
    template <class Sample>
    void scatter(const Vec3& position, const Sample& drawn, bool in_volume) {
        scatter(position, drawn.direction, drawn.density, drawn.weight(), in_volume, drawn.classical_density,
                drawn.guided_density);
    }

    /// Where the walk is: where it is split, each copy goes on from the place kept before.
    struct Branch {
        /// The last vertex whose direction was drawn.
        std::int32_t vertex = PathVertex::root;
        /// Gained since that vertex.
        Rgb weight{1.0f};
        /// Brought by connections at the vertex at hand, whose direction is not drawn yet. What follows is of it too.
        Rgb connected;
        /// The direction of the connection that outweighs the others.
        Vec3 to_light{0, 0, 0};
        /// How far that light is.
        float light_distance = std::numeric_limits<float>::infinity();
        /// Fluence that all connections found.
        float light_fluence = 0;
        /// Of the surface; zero in a volume.
        Vec3 normal{0, 0, 0};
    };
    /// Where the walk is now: to be kept before it is split.
    const Branch& branch() const { return at_; }
    /// Goes on from a place that was kept, within the same walk.
    void resume(const Branch& branch) { at_ = branch; }

    /// The walk so far, parents before children: for PathRecords::add(). Valid until the walk goes on.
    std::span<const PathVertex> vertices() const { return vertices_; }

private:
    PathVertex& current() { return vertices_[static_cast<std::size_t>(at_.vertex)]; }

    std::vector<PathVertex> vertices_;
    Branch at_;
};

}  // namespace wend::guide
