// Which light a vertex is connected to, learned by place from what connections brought.
#pragma once

#include <wend/scene/scene.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace wend {

/// What connections brought, by cell and light, however often each light was chosen.
class LightMoments {
public:
    struct Tally {
        double count = 0;
        double sum = 0;
    };

    /// `brought` over the probability of choosing the light would be the estimate of all light; 0 where it was blocked.
    /// Values that are not finite say nothing.
    void add(int cell, int light, float brought);
    LightMoments& operator+=(const LightMoments& other);

    /// Calls f(cell, light, tally), in no order.
    template <class F>
    void for_each(F&& f) const {
        for (const auto& [key, tally] : tallies_) {
            f(static_cast<int>(key >> 32), static_cast<int>(key & 0xffffffff), tally);
        }
    }

private:
    std::unordered_map<std::uint64_t, Tally> tallies_;
};

/// Choices of lights: the scene's light sampler knows where lights are, how strong and which way they face, but not
/// what stands between, nor how a vertex scatters. In a grid of cells, surfaces apart by the direction they face, the
/// mean that each light brought tells that; a quarter of all choices stays with the scene's sampler.
class LightChoices {
public:
    /// Nothing is learned yet. The scene must outlive it.
    explicit LightChoices(const Scene& scene);

    /// Whether there is something to learn: several lights, and not too many to keep a value for each.
    bool learns() const { return learns_; }

    /// u in [0,1); no light where none reaches the receiver.
    ChosenLight sample(const LightReceiver& receiver, float u) const;
    /// With which sample() chooses that light.
    float probability(const LightReceiver& receiver, int light) const;

    int cell_at(const LightReceiver& receiver) const;
    /// Adds to what is known, for choices to come.
    void learn(const LightMoments& moments);

private:
    /// In the middle of a cell.
    LightReceiver centre_of(int cell) const;
    float by_scene(const LightReceiver& receiver, int light) const;
    /// Of the lights up to each, by cell; null where too little is known.
    const float* cumulative(const LightReceiver& receiver) const;
    static float share(const float* cumulative, int light) {
        return light == 0 ? cumulative[0] : cumulative[light] - cumulative[light - 1];
    }

    const Scene& scene_;
    bool learns_;
    LightMoments seen_;
    std::vector<std::vector<float>> cumulative_;  ///< empty as long as nothing is known
};

}  // namespace wend
