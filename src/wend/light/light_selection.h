// Which light a vertex is connected to, learned by place from what connections brought.
#pragma once

#include <wend/light/vertex_cells.h>
#include <wend/scene/scene.h>

#include <cstdint>
#include <span>
#include <vector>

namespace wend {

/// What one connection brought, however often its light was chosen: over the probability of that choice it would be an
/// estimate of all light. 0 where something was in the way.
struct LightRecord {
    std::uint16_t cell;
    std::uint16_t light;
    float brought;
};

/// Choices of lights. The scene's light sampler knows where lights are, how strong and which way they face, but not
/// what stands between, nor how a vertex scatters; the mean of what each light brought tells that, in a grid of cells,
/// surfaces apart by the direction they face. A quarter of all choices stays with the scene's sampler
/// (docs/theory/next_event.md).
class LightSelection {
public:
    /// Nothing is learned yet. The scene must outlive it.
    explicit LightSelection(const Scene& scene);

    /// Whether there is something to learn: several lights, and not too many to keep a value for each.
    bool learns() const { return learns_; }

    /// u in [0,1); no light where none reaches the receiver.
    ChosenLight sample(const LightReceiver& receiver, float u) const;
    /// With which sample() chooses that light.
    float probability(const LightReceiver& receiver, int light) const;

    /// For what its connection to a light brought.
    LightRecord record(const LightReceiver& receiver, int light, float brought) const;
    /// Adds to what is known; values that are not finite say nothing.
    void add(std::span<const LightRecord> records);
    /// Makes choices to come follow all that was added.
    void learn(int threads);

    /// What is known, for a selection of the same scene; see ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& selection) {
        bytes(selection.cells_);
        bytes.require(selection.cells_.empty() || selection.cells_.size() == VertexCells::count);
        const std::size_t lights = selection.lights();
        for (const Cell& cell : selection.cells_) {
            bytes.require((cell.tallies.empty() || cell.tallies.size() == lights) &&
                          (cell.cumulative.empty() || cell.cumulative.size() == lights) &&
                          (cell.prior.empty() || cell.prior.size() == lights));
        }
    }
    /// Throws unless records can be those of this selection.
    template <class Archive>
    void check(Archive& bytes, std::span<const LightRecord> records) const {
        for (const LightRecord& record : records) {
            bytes.require(record.cell < VertexCells::count && record.light < lights());
        }
    }

private:
    struct Tally {
        double count = 0;
        double sum = 0;
    };
    struct Cell {
        std::vector<Tally> tallies;     ///< by light; empty without records
        std::vector<float> prior;       ///< probabilities of the scene's sampler in the middle of the cell
        std::vector<float> cumulative;  ///< of what was learned; empty where that is too little

        template <class Archive, class Self>
        static void archive(Archive& bytes, Self& cell) {
            bytes(cell.tallies, cell.prior, cell.cumulative);
        }
    };

    std::size_t lights() const { return scene_.lights().size(); }
    float by_scene(const LightReceiver& receiver, int light) const;
    void learn(std::size_t index);
    /// Of the lights up to each; null where too little is known.
    const float* cumulative(const LightReceiver& receiver) const;
    static float share(const float* cumulative, int light) {
        return light == 0 ? cumulative[0] : cumulative[light] - cumulative[light - 1];
    }

    const Scene& scene_;
    VertexCells places_;
    bool learns_;
    std::vector<Cell> cells_;  ///< none as long as nothing was added
};

}  // namespace wend
