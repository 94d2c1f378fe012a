// Which light of a scene a vertex is connected to: as its light sampler has it, and as was learned.
#pragma once

#include <wend/decision/learned_lights.h>
#include <wend/scene/scene.h>

#include <span>

namespace wend {

/// LearnedLights of a scene.
class LightSelection {
public:
    /// Nothing is learned yet. The scene must outlive it.
    explicit LightSelection(const Scene& scene) : scene_(scene), learned_(scene.bounds(), scene.lights().size()) {}

    /// Whether there is something to learn.
    bool learns() const { return learned_.learns(); }

    /// u in [0,1); no light where none reaches the receiver.
    ChosenLight sample(const LightReceiver& receiver, float u) const {
        return std::visit([&](const auto& s) { return learned_.sample(s, receiver, u); }, scene_.light_sampler());
    }
    /// With which sample() chooses that light.
    float probability(const LightReceiver& receiver, int light) const {
        return std::visit([&](const auto& s) { return learned_.probability(s, receiver, light); },
                          scene_.light_sampler());
    }

    /// For what its connection to a light brought.
    LightRecord record(const LightReceiver& receiver, int light, float brought) const {
        return learned_.record(receiver, light, brought);
    }
    void add(std::span<const LightRecord> records) { learned_.add(records); }
    /// Makes choices to come follow all that was added.
    void learn(int threads) {
        std::visit(
            [&](const auto& s) {
                learned_.learn([&](const LightReceiver& r, int light) { return s.probability(r, light); }, threads);
            },
            scene_.light_sampler());
    }

    /// What is known, for a selection of the same scene; see ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& selection) {
        bytes(selection.learned_);
    }
    template <class Archive>
    void check(Archive& bytes, std::span<const LightRecord> records) const {
        learned_.check(bytes, records);
    }

private:
    const Scene& scene_;
    LearnedLights learned_;
};

}  // namespace wend
