// Which light a vertex is connected to: what choices are given, and what they answer.
#pragma once

#include <wend/core/vector.h>

#include <concepts>
#include <cstddef>
#include <utility>
#include <vector>

namespace wend {

/// A vertex that wants light.
struct LightReceiver {
    /// In scene units.
    Vec3 position;
    /// Of a surface, unit length, on the side where light arrives; zero in a medium.
    Vec3 normal{0, 0, 0};

    /// Whether it is in a medium.
    bool in_volume() const { return normal == Vec3(0, 0, 0); }
};

/// A light that was chosen.
struct ChosenLight {
    /// Which one; negative: none reaches the receiver.
    int index = -1;
    /// That it is chosen.
    float probability = 0;
};

/// Chooses lights by what is known of them before anything is learned: their power, and perhaps where they are and
/// which way they face.
template <class S>
concept LightChoice = requires(const S& choice, const LightReceiver& receiver, float u, int light) {
    /// From a number of [0,1).
    { choice.sample(receiver, u) } -> std::same_as<ChosenLight>;
    /// With which sample() chooses that light.
    { choice.probability(receiver, light) } -> std::same_as<float>;
};

/// Everywhere in proportion to given weights, such as the lights' power.
class WeightedLights {
public:
    /// One a light: finite, none of them negative, and one at least positive.
    explicit WeightedLights(std::vector<float> weights) : probabilities_(std::move(weights)) {
        float total = 0;
        for (const float weight : probabilities_) {
            total += weight;
        }
        for (float& probability : probabilities_) {
            probability /= total;
        }
    }

    /// LightChoice; linear in the number of lights.
    ChosenLight sample(const LightReceiver& /*receiver*/, float u) const {
        int last = 0;
        float sum = 0;
        for (int light = 0; light < static_cast<int>(probabilities_.size()); ++light) {
            const float probability = probabilities_[static_cast<std::size_t>(light)];
            sum += probability;
            // Rounding may leave the end below u.
            last = probability > 0 ? light : last;
            if (u < sum) {
                break;
            }
        }
        return {last, probabilities_[static_cast<std::size_t>(last)]};
    }
    /// LightChoice.
    float probability(const LightReceiver& /*receiver*/, int light) const {
        return probabilities_[static_cast<std::size_t>(light)];
    }

private:
    std::vector<float> probabilities_;
};

static_assert(LightChoice<WeightedLights>);

}  // namespace wend
