// Which light to connect to: by power, or by a hierarchy that weighs power, distance and orientation (estevez2018).
#pragma once

#include <wend/decision/learned_lights.h>
#include <wend/sampling/discrete.h>
#include <wend/scene/light.h>

#include <span>
#include <variant>
#include <vector>

namespace wend {

/// In proportion to power, wherever the receiver is.
class PowerLightSampler {
public:
    PowerLightSampler(std::span<const Light> lights, float scene_radius);

    ChosenLight sample(const LightReceiver& receiver, float u) const;
    float probability(const LightReceiver& receiver, int light) const;

private:
    AliasTable table_;
};

/// By a binary tree over the lights that have a place: at each node the branch is drawn by an estimate of what its
/// lights send to the receiver. Lights at infinity are drawn uniformly beside the tree.
class TreeLightSampler {
public:
    TreeLightSampler(std::span<const Light> lights, float scene_radius);

    ChosenLight sample(const LightReceiver& receiver, float u) const;
    float probability(const LightReceiver& receiver, int light) const;

private:
    /// Where lights are, where they shine, and how strongly. The cone of normals is `axis` with half angle theta_o;
    /// they emit up to theta_e from each normal.
    struct Bounds {
        Box3 box;
        Vec3 axis{0, 0, 1};
        float cos_o = 1;
        float cos_e = 0;
        float power = 0;
        bool two_sided = false;

        float importance(const LightReceiver& receiver) const;
    };
    struct Node {
        Bounds bounds;
        int child = -1;  ///< index of the second child (the first follows its parent), or -1 at a leaf
        int light = -1;  ///< at a leaf
        int parent = -1;
    };

    static Bounds bounds_of(const Light& light);
    static Bounds merge(const Bounds& a, const Bounds& b);
    int build(std::span<std::pair<int, Bounds>> lights, int parent);

    float infinite_probability() const;

    std::vector<Node> nodes_;
    std::vector<int> leaf_of_light_;  ///< node of each light; -1 for lights at infinity
    std::vector<int> infinite_;
};

using LightSampler = std::variant<PowerLightSampler, TreeLightSampler>;

}  // namespace wend
