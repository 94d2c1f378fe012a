// Which light a vertex is connected to, learned by place from what connections brought.
#pragma once

#include <wend/core/export.h>
#include <wend/decision/light_choice.h>
#include <wend/decision/vertex_cells.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace wend {

/// What one connection brought, however often its light was chosen: over the probability of that choice it would be an
/// estimate of all light. 0 where something was in the way.
struct LightRecord {
    /// LearnedLights::record() fills this in.
    std::uint16_t cell;
    /// Which was chosen.
    std::uint16_t light;
    /// As a scalar, for instance the mean of the colour channels.
    float brought;
};

/// Choices of lights that learn. Who chooses lights first knows where they are, how strong and which way they face, but
/// not what stands between, nor how a vertex scatters; the mean of what each light brought tells that, in a grid of
/// cells, surfaces apart by the direction they face. A quarter of all choices stays with the first one
/// (docs/theory/next_event.md), which every call is given and must be the same.
class WEND_API LearnedLights {
public:
    /// More than so many lights are not learned: each cell keeps a value for each.
    static constexpr std::size_t most_lights = 256;

    /// Nothing is learned yet, of so many lights in a scene of these bounds.
    LearnedLights(const Box3& bounds, std::size_t lights) : places_(bounds), lights_(lights) {}

    /// Whether there is something to learn: several lights, and not too many.
    bool learns() const { return lights_ > 1 && lights_ <= most_lights; }

    /// u in [0,1); no light where none reaches the receiver.
    template <LightChoice First>
    ChosenLight sample(const First& first, const LightReceiver& receiver, float u) const;
    /// With which sample() chooses that light.
    template <LightChoice First>
    float probability(const First& first, const LightReceiver& receiver, int light) const {
        const float* learned = cumulative(receiver);
        return learned
                   ? share_of_first * first.probability(receiver, light) + (1 - share_of_first) * share(learned, light)
                   : first.probability(receiver, light);
    }

    /// For what its connection to a light brought.
    LightRecord record(const LightReceiver& receiver, int light, float brought) const {
        return {static_cast<std::uint16_t>(places_.at(receiver)), static_cast<std::uint16_t>(light), brought};
    }
    /// Adds to what is known, in an order that is always the same: sums depend on it. Values that are not finite say
    /// nothing.
    void add(std::span<const LightRecord> records);
    /// Makes choices to come follow all that was added; `probability` is that of the first choice. At most `threads`
    /// threads (0: all), on which nothing depends.
    void learn(const std::function<float(const LightReceiver&, int)>& probability, int threads);
    /// The same for a first choice.
    template <LightChoice First>
    void learn(const First& first, int threads) {
        learn([&](const LightReceiver& receiver, int light) { return first.probability(receiver, light); }, threads);
    }

    /// What is known, for lights of the same number; see ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& lights) {
        bytes(lights.cells_);
        bytes.require(lights.cells_.empty() || lights.cells_.size() == VertexCells::count);
        for (const Cell& cell : lights.cells_) {
            bytes.require((cell.tallies.empty() || cell.tallies.size() == lights.lights_) &&
                          (cell.cumulative.empty() || cell.cumulative.size() == lights.lights_) &&
                          (cell.prior.empty() || cell.prior.size() == lights.lights_));
        }
    }
    /// Throws unless records can be those of this one.
    template <class Archive>
    void check(Archive& bytes, std::span<const LightRecord> records) const {
        for (const LightRecord& record : records) {
            bytes.require(record.cell < VertexCells::count && record.light < lights_);
        }
    }

private:
    static constexpr float share_of_first = 0.25f;

    struct Tally {
        double count = 0;
        double sum = 0;
    };
    struct Cell {
        std::vector<Tally> tallies;     ///< by light; empty without records
        std::vector<float> prior;       ///< probabilities of the first choice in the middle of the cell
        std::vector<float> cumulative;  ///< of what was learned; empty where that is too little

        template <class Archive, class Self>
        static void archive(Archive& bytes, Self& cell) {
            bytes(cell.tallies, cell.prior, cell.cumulative);
        }
    };

    void learn(std::size_t index, const std::function<float(const LightReceiver&, int)>& probability);
    /// Of the lights up to each; null where too little is known.
    const float* cumulative(const LightReceiver& receiver) const {
        if (cells_.empty()) {
            return nullptr;
        }
        const std::vector<float>& learned = cells_[places_.at(receiver)].cumulative;
        return learned.empty() ? nullptr : learned.data();
    }
    static float share(const float* cumulative, int light) {
        return light == 0 ? cumulative[0] : cumulative[light] - cumulative[light - 1];
    }

    VertexCells places_;
    std::size_t lights_;
    std::vector<Cell> cells_;  ///< none as long as nothing was added
};

template <LightChoice First>
ChosenLight LearnedLights::sample(const First& first, const LightReceiver& receiver, float u) const {
    const float* learned = cumulative(receiver);
    if (!learned) {
        return first.sample(receiver, u);
    }
    if (u < share_of_first) {
        ChosenLight chosen = first.sample(receiver, u / share_of_first);
        if (chosen.index >= 0) {
            chosen.probability =
                share_of_first * chosen.probability + (1 - share_of_first) * share(learned, chosen.index);
        }
        return chosen;
    }
    const int lights = static_cast<int>(lights_);
    const float v = (u - share_of_first) / (1 - share_of_first);
    int light = static_cast<int>(std::upper_bound(learned, learned + lights, v) - learned);
    // Rounding may leave the end below 1.
    while (light == lights || (light > 0 && !(share(learned, light) > 0))) {
        --light;
    }
    return {light, probability(first, receiver, light)};
}

}  // namespace wend
