// Which light a vertex is connected to, learned by place from what connections brought.
#pragma once

#include <wend/core/export.h>
#include <wend/core/vector.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
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

/// 12³ cells over a box, for vertices in volumes and for those on surfaces by the axis that is closest to the normal
/// and its direction.
class VertexCells {
public:
    /// Of all cells.
    static constexpr std::size_t count = 7 * 12 * 12 * 12;

    /// Over that box.
    explicit VertexCells(const Box3& box) : box_(box) {}

    /// Positions outside the box, and those that are not numbers, belong to cells at the rim.
    std::size_t at(const LightReceiver& vertex) const {
        int cell = kind_of(vertex.normal);
        for (int axis = 0; axis < 3; ++axis) {
            const float size = box_.max[axis] - box_.min[axis];
            const float u = size > 0 ? (vertex.position[axis] - box_.min[axis]) / size : 0.0f;
            // In this order a position that is not a number gives 0.
            cell = cell * side + static_cast<int>(std::min(std::max(0.0f, u * side), side - 1.0f));
        }
        return static_cast<std::size_t>(cell);
    }

    /// In the middle of a cell.
    LightReceiver centre_of(std::size_t cell) const {
        auto rest = static_cast<int>(cell);
        LightReceiver vertex{box_.min};
        for (int axis = 2; axis >= 0; --axis) {
            const float step = (box_.max[axis] - box_.min[axis]) / side;
            vertex.position[axis] += step * (static_cast<float>(rest % side) + 0.5f);
            rest /= side;
        }
        if (rest > 0) {
            vertex.normal[(rest - 1) / 2] = rest % 2 == 1 ? 1.0f : -1.0f;
        }
        return vertex;
    }

private:
    static constexpr int side = 12;

    /// 0 in a volume.
    static int kind_of(const Vec3& normal) {
        if (normal == Vec3(0, 0, 0)) {
            return 0;
        }
        int axis = 0;
        for (int i = 1; i < 3; ++i) {
            axis = std::abs(normal[i]) > std::abs(normal[axis]) ? i : axis;
        }
        return 1 + 2 * axis + (normal[axis] < 0 ? 1 : 0);
    }

    Box3 box_;
};

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
        return probability(first, cumulative(receiver), receiver, light);
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
        bytes(lights.cells_, lights.cumulative_);
        bytes.require(lights.cells_.empty() || lights.cells_.size() == VertexCells::count);
        bytes.require(lights.cumulative_.size() == lights.cells_.size() * lights.lights_);
        for (const Cell& cell : lights.cells_) {
            bytes.require((cell.tallies.empty() || cell.tallies.size() == lights.lights_) &&
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
        std::vector<Tally> tallies;  ///< by light; empty without records
        std::vector<float> prior;    ///< probabilities of the first choice in the middle of the cell

        template <class Archive, class Self>
        static void archive(Archive& bytes, Self& cell) {
            bytes(cell.tallies, cell.prior);
        }
    };

    void learn(std::size_t index, const std::function<float(const LightReceiver&, int)>& probability);
    /// Of the lights up to each; null where too little is known.
    const float* cumulative(const LightReceiver& receiver) const {
        if (cumulative_.empty()) {
            return nullptr;
        }
        const float* learned = cumulative_.data() + places_.at(receiver) * lights_;
        return learned[lights_ - 1] > 0 ? learned : nullptr;
    }
    template <LightChoice First>
    static float probability(const First& first, const float* learned, const LightReceiver& receiver, int light) {
        return learned
                   ? share_of_first * first.probability(receiver, light) + (1 - share_of_first) * share(learned, light)
                   : first.probability(receiver, light);
    }
    static float share(const float* cumulative, int light) {
        return light == 0 ? cumulative[0] : cumulative[light] - cumulative[light - 1];
    }

    VertexCells places_;
    std::size_t lights_;
    std::vector<Cell> cells_;  ///< none as long as nothing was added
    /// What is learned, cell by cell: of the lights up to each, 0 where too little is known. Apart from the rest, since
    /// it is asked at every vertex and is then in the caches.
    std::vector<float> cumulative_;
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
    return {light, probability(first, learned, receiver, light)};
}

}  // namespace wend
