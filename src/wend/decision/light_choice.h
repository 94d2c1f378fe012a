// Which light a vertex is connected to: what choices are told, and what they answer.
#pragma once

#include <wend/core/vector.h>

#include <concepts>

namespace wend {

/// A vertex that wants light.
struct LightReceiver {
    /// In scene units.
    Vec3 position;
    /// Of a surface, unit length, on the side where light arrives; zero in a medium.
    Vec3 normal{0, 0, 0};
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

}  // namespace wend
