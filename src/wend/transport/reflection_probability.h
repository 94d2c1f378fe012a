// Whether a walk is reflected or refracted by a dielectric boundary, learned by place from what either brought.
#pragma once

#include <wend/decision/learned_lights.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace wend {

/// What a walk found behind a boundary, over what the vertex was worth: an estimate of the radiance on one of the two
/// ways, without Fresnel's share of it.
struct ReflectionRecord {
    std::uint16_t cell;
    bool reflected;
    float brought;
};

/// Odds of reflection. Fresnel's equations say how much of what arrives goes either way, not what is to be found there:
/// a few per cent of a bright sky may be all that a dark glass shows, and what refracts out of a lamp-lit one is mostly
/// lost in the dark. The odds are the ratio of the mean radiance on both ways (docs/theory/reflection.md).
class ReflectionProbability {
public:
    /// Nothing is learned yet; `bounds` are those of all vertices.
    explicit ReflectionProbability(const Box3& bounds) : cells_(bounds) {}

    /// How many times more often than Fresnel's equations have it a reflection is best drawn over a refraction, at a
    /// vertex with the normal on the side that the walk came from: 1 where little is known.
    float odds(const LightReceiver& vertex) const { return odds_.empty() ? 1.0f : odds_[cells_.at(vertex)]; }

    ReflectionRecord record(const LightReceiver& vertex, bool reflected, float brought) const {
        return {static_cast<std::uint16_t>(cells_.at(vertex)), reflected, brought};
    }
    /// Adds to what is known; values that are not finite say nothing.
    void add(std::span<const ReflectionRecord> records);
    /// Makes choices to come follow all that was added.
    void learn();

    /// What is known; see ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& probability) {
        bytes(probability.tallies_, probability.odds_);
        for (const std::size_t size : {probability.tallies_.size(), probability.odds_.size()}) {
            bytes.require(size == 0 || size == VertexCells::count);
        }
    }
    /// Throws unless records can be those of vertices.
    template <class Archive>
    static void check(Archive& bytes, std::span<const ReflectionRecord> records) {
        for (const ReflectionRecord& record : records) {
            bytes.require(record.cell < VertexCells::count);
        }
    }

private:
    struct Tally {
        double count = 0;
        double sum = 0;
    };
    struct Cell {
        Tally reflected, refracted;
    };

    VertexCells cells_;
    std::vector<Cell> tallies_;  ///< none as long as nothing was added
    std::vector<float> odds_;
};

/// What a walk, split or not, found behind each boundary on its way. Of more than `most` the last ones are left out:
/// what is found behind them belongs to the boundary before.
class ReflectionLog {
public:
    static constexpr int none = -1;
    static constexpr std::size_t most = 1 << 18;

    void start() { notes_.clear(); }
    /// A boundary was passed after the one noted before (or none). `worth` is the walk's throughput had the choice
    /// followed Fresnel's equations, `record` lacks what was brought. Returns where it is noted.
    int note(int before, const ReflectionRecord& record, float worth) {
        if (notes_.size() == most) {
            return before;
        }
        notes_.push_back({record, before, worth});
        return static_cast<int>(notes_.size()) - 1;
    }
    /// Light reached the picture behind a boundary.
    void bring(int note, float light) {
        if (note != none) {
            notes_[static_cast<std::size_t>(note)].record.brought += light;
        }
    }
    /// Appends the records of the walk, which has ended.
    void finish(std::vector<ReflectionRecord>& records);

private:
    struct Note {
        ReflectionRecord record;
        int before;
        float worth;
    };
    std::vector<Note> notes_;
};

}  // namespace wend
