// A guided interior walk in a dense medium, as a technique of the path tracer.
#pragma once

#include <wend/decision/channels.h>
#include <wend/decision/direction.h>
#include <wend/sampling/sampler.h>
#include <wend/scene/scene.h>
#include <wend/subsurface/interior_walk.h>
#include <wend/transport/subsurface_guides.h>
#include <wend/transport/vertex.h>

#include <optional>

namespace wend {

/// What a technique draws: a flight and, where connections are to know it, the probability of passing its segment.
struct TechniqueFlight {
    Flight flight;
    std::optional<float> pass_probability;
};

/// Aims an InteriorWalk by what is known of the medium, wherever the path is.
class InteriorTechnique {
public:
    /// Of a whole interior walk, however it is aimed (docs/theory/subsurface.md).
    static constexpr bool bounds_weights = true;

    const InteriorWalk& walk() const { return walk_; }

    /// The path is at the boundary of the medium that it is in or enters, on its way in a direction.
    void enter(const SubsurfaceGuides& guides, MediumId medium, const Hit& hit, const Vec3& direction,
               const Rgb& throughput) {
        guides_ = &guides;
        medium_ = medium;
        guides.enter(medium, hit, direction, channel_probabilities(throughput), walk_);
    }

    /// Most flights end long before the boundary: no ray need be traced further than they go.
    float draw_distance(Sampler& sampler) const { return walk_.draw_distance(sampler.uniform()); }
    /// The flight of a distance that was `drawn`, where the medium goes on for `length`.
    TechniqueFlight fly(float length, float drawn) {
        // Connections know the probabilities of an interior walk where they start from one of its collisions.
        const bool has_turned = walk_.has_turned();
        const InteriorFlight flight = walk_.fly(length, drawn);
        return {flight.flight, has_turned ? std::optional(flight.pass_probability) : std::nullopt};
    }

    /// Those of a collision: the walk as it was there, which other branches of the path go on from as well.
    class Directions {
    public:
        Directions(const InteriorWalk& walk, const Vec3& before, Pcg32& random)
            : here_(walk), directions_(here_, before, random) {}
        Directions(const Directions&) = delete;
        Directions& operator=(const Directions&) = delete;

        std::optional<DirectionSample> sample(float u, const Vec2& u2) const { return directions_.sample(u, u2); }
        float density(const Vec3& w) const { return directions_.density(w); }
        std::optional<Rgb> in_scattered() const { return std::nullopt; }
        std::optional<Vec3> sample_emitters() const { return directions_.sample_emitters(); }
        float emitter_density(const Vec3& w) const { return directions_.emitter_density(w); }

        /// The interior walk once it goes from here in a direction.
        InteriorWalk towards(const Vec3& w) const {
            InteriorWalk there = here_;
            there.turn(directions_, w);
            return there;
        }

    private:
        friend class InteriorTechnique;

        InteriorWalk here_;
        InteriorWalk::Directions directions_;
    };

    /// Aims the walk at the collision, and asks it.
    template <class Decisions>
    Directions directions(const Decisions& /*decisions*/, const VolumeScattering& f, const Vertex& v, float /*weight*/,
                          Pcg32& random) {
        guides_->aim(medium_, v.position, walk_);
        return Directions(walk_, f.before(), random);
    }
    /// The path, which is as it was when they were made, goes on in one of them.
    void turn(const Directions& directions, const Vec3& w) { walk_.turn(directions.directions_, w); }
    /// The probability of flying through a segment; the path goes on behind it.
    float pass(float length) { return walk_.pass(length); }
    /// The path goes on in a direction that a surface scatters to.
    void head(const Vec3& w) { walk_.head(w); }

    /// See InteriorWalk::survival.
    float survival(float throughput) { return walk_.survival(throughput); }

private:
    InteriorWalk walk_;
    const SubsurfaceGuides* guides_ = nullptr;
    MediumId medium_ = vacuum;
};

}  // namespace wend
