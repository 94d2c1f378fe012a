#include <wend/integrator/light_choices.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace wend {
namespace {

constexpr int side = 12;
/// In a volume, or the direction of an axis that is closest to a surface's normal.
constexpr int kinds = 7;
constexpr std::size_t most_lights = 256;
constexpr float scene_share = 0.25f;
/// Connections in a cell that tell its lights apart.
constexpr double enough_connections = 8;
/// How many connections the scene's opinion of a light is worth.
constexpr double trust_in_scene = 2;

int kind_of(const Vec3& normal) {
    if (normal == Vec3(0, 0, 0)) {
        return 0;
    }
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
        axis = std::abs(normal[i]) > std::abs(normal[axis]) ? i : axis;
    }
    return 1 + 2 * axis + (normal[axis] < 0 ? 1 : 0);
}

}  // namespace

void LightMoments::add(int cell, int light, float brought) {
    if (!std::isfinite(brought)) {
        return;
    }
    Tally& tally = tallies_[static_cast<std::uint64_t>(cell) << 32 | static_cast<std::uint64_t>(light)];
    ++tally.count;
    tally.sum += brought;
}

LightMoments& LightMoments::operator+=(const LightMoments& other) {
    for (const auto& [key, tally] : other.tallies_) {
        Tally& mine = tallies_[key];
        mine.count += tally.count;
        mine.sum += tally.sum;
    }
    return *this;
}

LightChoices::LightChoices(const Scene& scene)
    : scene_(scene), learns_(scene.lights().size() > 1 && scene.lights().size() <= most_lights) {
}

int LightChoices::cell_at(const LightReceiver& receiver) const {
    const Box3& box = scene_.bounds();
    int cell = kind_of(receiver.normal);
    for (int axis = 0; axis < 3; ++axis) {
        const float size = box.max[axis] - box.min[axis];
        const float u = size > 0 ? (receiver.position[axis] - box.min[axis]) / size : 0.0f;
        cell = cell * side + std::clamp(static_cast<int>(u * side), 0, side - 1);
    }
    return cell;
}

LightReceiver LightChoices::centre_of(int cell) const {
    const Box3& box = scene_.bounds();
    LightReceiver receiver{box.min};
    for (int axis = 2; axis >= 0; --axis) {
        const float step = (box.max[axis] - box.min[axis]) / side;
        receiver.position[axis] += step * (static_cast<float>(cell % side) + 0.5f);
        cell /= side;
    }
    if (cell > 0) {
        receiver.normal[(cell - 1) / 2] = cell % 2 == 1 ? 1.0f : -1.0f;
    }
    return receiver;
}

float LightChoices::by_scene(const LightReceiver& receiver, int light) const {
    return std::visit([&](const auto& s) { return s.probability(receiver, light); }, scene_.light_sampler());
}

const float* LightChoices::cumulative(const LightReceiver& receiver) const {
    if (cumulative_.empty()) {
        return nullptr;
    }
    const std::vector<float>& cell = cumulative_[static_cast<std::size_t>(cell_at(receiver))];
    return cell.empty() ? nullptr : cell.data();
}

ChosenLight LightChoices::sample(const LightReceiver& receiver, float u) const {
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

float LightChoices::probability(const LightReceiver& receiver, int light) const {
    const float* learned = cumulative(receiver);
    return learned ? scene_share * by_scene(receiver, light) + (1 - scene_share) * share(learned, light)
                   : by_scene(receiver, light);
}

void LightChoices::learn(const LightMoments& moments) {
    seen_ += moments;
    const std::size_t lights = scene_.lights().size();
    struct Cell {
        double connections = 0;
        double mean = 0;  ///< of all light
        std::vector<LightMoments::Tally> tallies;
    };
    std::unordered_map<int, Cell> cells;
    seen_.for_each([&](int cell, int light, const LightMoments::Tally& tally) {
        Cell& c = cells[cell];
        c.tallies.resize(lights);
        c.connections += tally.count;
        c.mean += tally.sum / tally.count;
        c.tallies[static_cast<std::size_t>(light)] = tally;
    });
    cumulative_.assign(static_cast<std::size_t>(kinds) * side * side * side, {});
    for (const auto& [index, cell] : cells) {
        if (cell.connections < enough_connections || !(cell.mean > 0)) {
            continue;
        }
        // A light that was hardly tried may bring what the scene's sampler takes it for.
        const LightReceiver centre = centre_of(index);
        std::vector<double> sums;
        double total = 0;
        for (std::size_t i = 0; i < lights; ++i) {
            const auto [count, sum] = cell.tallies[i];
            const auto prior = static_cast<double>(by_scene(centre, static_cast<int>(i))) * cell.mean;
            total += (sum + trust_in_scene * prior) / (count + trust_in_scene);
            sums.push_back(total);
        }
        std::vector<float>& cumulative = cumulative_[static_cast<std::size_t>(index)];
        cumulative.reserve(lights);
        for (const double sum : sums) {
            cumulative.push_back(static_cast<float>(sum / total));
        }
    }
}

}  // namespace wend
