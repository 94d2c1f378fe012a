#include <wend/core/parallel.h>
#include <wend/light/light_selection.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace wend {
namespace {

static_assert(VertexCells::count <= 65536, "LightRecord::cell");
constexpr std::size_t most_lights = 256;
constexpr float scene_share = 0.25f;
/// Connections in a cell that tell its lights apart.
constexpr double enough_connections = 8;
/// How many connections the scene's opinion of a light is worth.
constexpr double confidence_in_scene = 2;

}  // namespace

LightSelection::LightSelection(const Scene& scene)
    : scene_(scene),
      places_(scene.bounds()),
      learns_(scene.lights().size() > 1 && scene.lights().size() <= most_lights) {
}

float LightSelection::by_scene(const LightReceiver& receiver, int light) const {
    return std::visit([&](const auto& s) { return s.probability(receiver, light); }, scene_.light_sampler());
}

const float* LightSelection::cumulative(const LightReceiver& receiver) const {
    if (cells_.empty()) {
        return nullptr;
    }
    const std::vector<float>& learned = cells_[places_.at(receiver)].cumulative;
    return learned.empty() ? nullptr : learned.data();
}

ChosenLight LightSelection::sample(const LightReceiver& receiver, float u) const {
    const LightSampler& scene = scene_.light_sampler();
    const float* learned = cumulative(receiver);
    if (!learned) {
        return std::visit([&](const auto& s) { return s.sample(receiver, u); }, scene);
    }
    if (u < scene_share) {
        ChosenLight chosen = std::visit([&](const auto& s) { return s.sample(receiver, u / scene_share); }, scene);
        if (chosen.index >= 0) {
            chosen.probability = scene_share * chosen.probability + (1 - scene_share) * share(learned, chosen.index);
        }
        return chosen;
    }
    const int lights = static_cast<int>(scene_.lights().size());
    const float v = (u - scene_share) / (1 - scene_share);
    int light = static_cast<int>(std::upper_bound(learned, learned + lights, v) - learned);
    // Rounding may leave the end below 1.
    while (light == lights || (light > 0 && !(share(learned, light) > 0))) {
        --light;
    }
    return {light, probability(receiver, light)};
}

float LightSelection::probability(const LightReceiver& receiver, int light) const {
    const float* learned = cumulative(receiver);
    return learned ? scene_share * by_scene(receiver, light) + (1 - scene_share) * share(learned, light)
                   : by_scene(receiver, light);
}

LightRecord LightSelection::record(const LightReceiver& receiver, int light, float brought) const {
    return {static_cast<std::uint16_t>(places_.at(receiver)), static_cast<std::uint16_t>(light), brought};
}

void LightSelection::add(std::span<const LightRecord> records) {
    cells_.resize(VertexCells::count);
    for (const LightRecord& record : records) {
        if (!std::isfinite(record.brought)) {
            continue;
        }
        std::vector<Tally>& tallies = cells_[record.cell].tallies;
        tallies.resize(scene_.lights().size());
        ++tallies[record.light].count;
        tallies[record.light].sum += record.brought;
    }
}

void LightSelection::learn(int threads) {
    parallel_for(cells_.size(), threads, [this](std::size_t i) {
        if (!cells_[i].tallies.empty()) {
            learn(i);
        }
    });
}

void LightSelection::learn(std::size_t index) {
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
            cell.prior.push_back(by_scene(centre, light));
        }
    }
    // A light that was hardly tried may bring what the scene's sampler takes it for.
    std::vector<double> sums;
    double total = 0;
    for (std::size_t i = 0; i < cell.tallies.size(); ++i) {
        const auto [count, sum] = cell.tallies[i];
        total +=
            (sum + confidence_in_scene * static_cast<double>(cell.prior[i]) * mean) / (count + confidence_in_scene);
        sums.push_back(total);
    }
    cell.cumulative.clear();
    for (const double sum : sums) {
        cell.cumulative.push_back(static_cast<float>(sum / total));
    }
}

}  // namespace wend
