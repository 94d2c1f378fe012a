#include <wend/decision/learned_lights.h>

#include <wend/core/parallel.h>

#include <cmath>

namespace wend {
namespace {

static_assert(VertexCells::count <= 65536, "LightRecord::cell");
/// Connections in a cell that tell its lights apart.
constexpr double enough_connections = 8;
/// How many connections the first choice's opinion of a light is worth.
constexpr double confidence_in_first = 2;

}  // namespace

void LearnedLights::add(std::span<const LightRecord> records) {
    if (records.empty()) {
        return;
    }
    cells_.resize(VertexCells::count);
    cumulative_.resize(VertexCells::count * lights_);
    for (const LightRecord& record : records) {
        if (!std::isfinite(record.brought)) {
            continue;
        }
        std::vector<Tally>& tallies = cells_[record.cell].tallies;
        tallies.resize(lights_);
        ++tallies[record.light].count;
        tallies[record.light].sum += record.brought;
    }
}

void LearnedLights::learn(const std::function<float(const LightReceiver&, int)>& probability, int threads) {
    parallel_for(cells_.size(), threads, [&](std::size_t i) {
        if (!cells_[i].tallies.empty()) {
            learn(i, probability);
        }
    });
}

void LearnedLights::learn(std::size_t index, const std::function<float(const LightReceiver&, int)>& probability) {
    Cell& cell = cells_[index];
    double connections = 0, mean = 0;
    for (const Tally& tally : cell.tallies) {
        connections += tally.count;
        mean += tally.count > 0 ? tally.sum / tally.count : 0.0;
    }
    if (connections < enough_connections || !(mean > 0)) {
        return;
    }
    if (cell.prior.empty()) {
        const LightReceiver centre = places_.centre_of(index);
        for (int light = 0; light < static_cast<int>(cell.tallies.size()); ++light) {
            cell.prior.push_back(probability(centre, light));
        }
    }
    // A light that was hardly tried may bring what the first choice takes it for.
    std::vector<double> sums;
    double total = 0;
    for (std::size_t i = 0; i < cell.tallies.size(); ++i) {
        const auto [count, sum] = cell.tallies[i];
        total +=
            (sum + confidence_in_first * static_cast<double>(cell.prior[i]) * mean) / (count + confidence_in_first);
        sums.push_back(total);
    }
    float* const cumulative = cumulative_.data() + index * lights_;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        cumulative[i] = static_cast<float>(sums[i] / total);
    }
}

}  // namespace wend
