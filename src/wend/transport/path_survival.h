// Whether a path goes on.
#pragma once

#include <wend/decision/roulette_splitting.h>
#include <wend/sampling/sampler.h>
#include <wend/scene/scene.h>
#include <wend/transport/branching_path.h>
#include <wend/transport/vertex.h>

#include <optional>

namespace wend {

/// Counts the vertices of a path against the largest depth, and plays Russian roulette by the path's technique or else
/// by the render's decision.
template <class Decisions, class Recorders>
class PathSurvival {
public:
    /// All but the numbers are referred to. `expected` is an estimate of what all of the walk brings; 0 where there is
    /// none.
    PathSurvival(const Scene& scene, const Decisions& decisions, float expected, int max_depth, Sampler& sampler,
                 BranchingPath<Recorders>& path)
        : scene_(scene), d_(decisions), expected_(expected), max_depth_(max_depth), sampler_(sampler), path_(path) {}

    /// Counts the vertex at hand in the medium at hand; false where the walk ends.
    bool count_vertex() {
        if (scene_.counts_vertices_in(path_.now.medium.id)) {
            const bool goes_on = path_.now.counts.vertices_left(max_depth_) >= 1;
            ++path_.now.counts.vertices;
            return goes_on;
        }
        ++path_.now.counts.vertices;
        // Through a hole in its boundary, where nothing is absorbed, a walk would never end.
        constexpr int long_walk = 10000;
        constexpr float survival = 0.9999f;
        if (++path_.now.counts.uncounted <= long_walk) {
            return true;
        }
        path_.weigh(Rgb(1 / survival));
        return sampler_.random().uniform() < survival;
    }

    /// What the walk may yet bring over what all of it is expected to, if both are known.
    template <class F, class Directions>
    std::optional<float> expected_ratio(const F& f, const Directions& directions) const {
        const std::optional<Rgb> in_scattered = directions.in_scattered();
        if (!in_scattered || !(expected_ > 0)) {
            return std::nullopt;
        }
        return mean_value(path_.now.weight.throughput * f.albedo() * *in_scattered) / expected_;
    }

    /// Counts the probability of surviving that an unguided path would have, once the direction is drawn.
    void count_unguided(const Vertex& v) {
        if (technique_judges()) {
            return;
        }
        PathWeight& weight = path_.now.weight;
        const float survival =
            unguided_walks_end.after_direction({weight.throughput * weight.unguided_ratio(), 1, weight.index_scale,
                                                path_.now.counts.vertices, false, v.in_volume()});
        if (survival > 0) {
            weight.survival_ratio /= survival;
        }
    }

    /// Roulette after the direction is drawn.
    template <class F>
    bool survives(const F& f, const Vertex& v) {
        const float survival = probability(v.in_volume(), expected_ > 0 && !f.is_guidable());
        if (survival < 1) {
            if (!(sampler_.uniform() < survival)) {
                return false;
            }
            path_.weigh(Rgb(1 / survival));
            path_.now.weight.survival_ratio *= technique_judges() ? 1.0f : survival;
        }
        return true;
    }

private:
    /// Whether walks end by the technique at hand, guided or not.
    bool technique_judges() const {
        return path_.ask_technique([](auto& technique) {
            return requires {
                technique.survival(0.0f);
            };
        });
    }

    float probability(bool in_volume, bool is_judged_elsewhere) {
        const PathWeight& weight = path_.now.weight;
        return path_.ask_technique([&](auto& technique) {
            if constexpr (requires { technique.survival(0.0f); }) {
                if (!is_judged_elsewhere) {
                    return technique.survival(max_value(weight.throughput) * weight.index_scale);
                }
            }
            return d_.survival.after_direction({weight.throughput, weight.density_ratio, weight.index_scale,
                                                path_.now.counts.vertices, is_judged_elsewhere, in_volume});
        });
    }

    const Scene& scene_;
    const Decisions& d_;
    float expected_;
    int max_depth_;
    Sampler& sampler_;
    BranchingPath<Recorders>& path_;
};

}  // namespace wend
