// The free flights of a path.
#pragma once

#include <wend/decision/distance.h>
#include <wend/light/emitter_hit.h>
#include <wend/sampling/sampler.h>
#include <wend/scene/scene.h>
#include <wend/transport/branching_path.h>
#include <wend/transport/surface_ahead.h>
#include <wend/transport/vertex.h>

#include <optional>

namespace wend {

/// Draws flights in the medium at hand, by the path's technique or else by the render's decision.
template <class Decisions, class Recorders>
class PathFlights {
public:
    /// All are referred to.
    PathFlights(const Scene& scene, const Decisions& decisions, const EmitterHits& emitters, Sampler& sampler,
                BranchingPath<Recorders>& path)
        : scene_(scene), d_(decisions), emitters_(emitters), sampler_(sampler), path_(path) {}

    /// How far the path's technique goes if nothing is in its way: infinite where it has no flights of its own.
    float draw_distance() {
        return path_.ask_technique([&](auto& technique) -> float {
            if constexpr (requires { technique.draw_distance(sampler_); }) {
                return technique.draw_distance(sampler_);
            }
            return infinity;
        });
    }

    /// The next flight, up to the surface ahead; if it passes the segment, that is counted in.
    Flight fly(const Medium& medium, SurfaceAhead& ahead, float drawn) {
        const float length = ahead.distance();
        path_.record(walk_events::Flew{path_.now.medium.id});
        const TechniqueFlight flight = path_.ask_technique([&](auto& technique) -> TechniqueFlight {
            if constexpr (requires { technique.fly(length, drawn); }) {
                return technique.fly(length, drawn);
            }
            return {fly_by_decision(medium, ahead, length), std::nullopt};
        });
        if (!flight.flight.scatters) {
            path_.now.last.pass_probability *= flight.pass_probability
                                                   ? Rgb(*flight.pass_probability)
                                                   : d_.distance.pass_probability(medium, path_.now.ray, length);
        }
        return flight.flight;
    }

private:
    Flight fly_by_decision(const Medium& medium, SurfaceAhead& ahead, float length) {
        FlightStart start{path_.now.ray,
                          length,
                          path_.now.weight.throughput,
                          path_.now.weight_to_bound(),
                          {},
                          emitters_.in(path_.now.medium.id, path_.now.last, path_.now.interior.way)};
        if (d_.distance.looks_ahead(medium, start)) {
            start.end = end_of_segment(ahead);
        }
        return d_.distance.sample(medium, start, sampler_.uniform(), sampler_.random());
    }

    FlightEnd end_of_segment(SurfaceAhead& ahead) const {
        FlightEnd end;
        if (!ahead) {
            end.emitted = mean_value(emitters_.beyond(path_.now.last, path_.now.interior.way, path_.now.ray).radiance);
            return end;
        }
        const Hit& hit = ahead.hit();
        end.kind = scene_.is_interface(hit) ? FlightEnd::Kind::interface : FlightEnd::Kind::surface;
        end.position = hit.position;
        end.normal = Vertex::facing_normal(hit, path_.now.ray.direction);
        end.emitted =
            hit.light >= 0
                ? mean_value(emitters_.at(hit, path_.now.last, path_.now.interior.way, path_.now.ray).radiance)
                : 0.0f;
        return end;
    }

    const Scene& scene_;
    const Decisions& d_;
    const EmitterHits& emitters_;
    Sampler& sampler_;
    BranchingPath<Recorders>& path_;
};

}  // namespace wend
