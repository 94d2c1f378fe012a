#include <wend/decision/caustic_map.h>

#include <algorithm>
#include <numeric>
#include <span>

namespace wend {
namespace {

/// How much brighter than the mean over all directions a lobe is, at least. What is less bright is found by chance: a
/// part of a sky, or ways of which too little is known.
constexpr float least_contrast = 10;
/// Photons that a cell has at most. More of them know more ways to lights, fewer know them more exactly.
constexpr std::size_t most_caustic_lobes = 32;

/// The group of each caustic lobe, and how many groups there are: around the one that would be missed most, then around
/// the next, so that no way to a light is left out.
struct Grouping {
    std::array<std::size_t, most_caustic_lobes> of{};
    std::array<Vec3, CausticMap::most_groups> centres;
    std::size_t count = 0;
};

Grouping grouped(std::span<const CausticLobe> caustics) {
    Grouping groups;
    std::array<float, most_caustic_lobes> apart;
    apart.fill(4);
    std::size_t next = 0;
    float all = 0;
    for (std::size_t i = 0; i < caustics.size(); ++i) {
        const float light = mean_value(caustics[i].light);
        all += light;
        next = light > mean_value(caustics[next].light) ? i : next;
    }
    // Groups that are much fainter say nothing, and would be nothing to divide by.
    constexpr float negligible = 1e-6f;
    float missed = all;
    while (groups.count < CausticMap::most_groups && missed > negligible * all) {
        const Vec3 centre = caustics[next].towards;
        groups.centres[groups.count] = centre;
        missed = 0;
        for (std::size_t i = 0; i < caustics.size(); ++i) {
            const float d = length_squared(caustics[i].towards - centre);
            if (d < apart[i]) {
                apart[i] = d;
                groups.of[i] = groups.count;
            }
            if (const float loss = apart[i] * mean_value(caustics[i].light); loss > missed) {
                missed = loss;
                next = i;
            }
        }
        ++groups.count;
    }
    return groups;
}

/// Means over the members of each group: of directions, distances, places.
void place_groups(std::span<const CausticLobe> caustics, const Grouping& grouping,
                  std::span<CausticMap::Group> groups) {
    std::array<Vec3, CausticMap::most_groups> sums;
    sums.fill({0, 0, 0});
    for (std::size_t i = 0; i < caustics.size(); ++i) {
        const CausticLobe& lobe = caustics[i];
        const float light = mean_value(lobe.light);
        sums[grouping.of[i]] += lobe.towards * light;
        CausticMap::Group& group = groups[grouping.of[i]];
        group.light += lobe.light;
        group.distance += lobe.distance * light;
        group.place += lobe.position * light;
        group.image += (lobe.position + lobe.towards * lobe.distance) * light;
    }
    for (std::size_t g = 0; g < groups.size(); ++g) {
        CausticMap::Group& group = groups[g];
        const float scale = 1 / mean_value(group.light);
        // Directions may cancel.
        const Vec3 mean = sums[g] * scale;
        group.lobe.mean = length(mean) > 1e-3f ? normalize(mean) : grouping.centres[g];
        group.distance *= scale;
        group.place *= scale;
        group.image *= scale;
    }
}

using ByGroup = std::array<float, CausticMap::most_groups>;

/// Neighbours see the same light under another angle, by a curvature that a line through all tells, and before that the
/// length of the way.
void turn_groups(std::span<const CausticLobe> caustics, const Grouping& grouping, const ByGroup& members,
                 float most_turned, std::span<CausticMap::Group> groups) {
    ByGroup turned{}, moved{};
    for (std::size_t i = 0; i < caustics.size(); ++i) {
        const std::size_t g = grouping.of[i];
        const Vec3& mean = groups[g].lobe.mean;
        const Vec3 offset = caustics[i].position - groups[g].place;
        const Vec3 across = offset - mean * dot(offset, mean);
        turned[g] -= dot(caustics[i].towards - mean, across);
        moved[g] += length_squared(across);
    }
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const float before = std::max(moved[g] / members[g], 1e-12f);
        const float turn = (turned[g] + before / groups[g].distance) / (moved[g] + before);
        groups[g].turn = std::clamp(turn, -most_turned, most_turned);
    }
}

/// A group of few is thought to spread as others do, and a cell without any spread far.
void spread_groups(std::span<const CausticLobe> caustics, const Grouping& grouping, const ByGroup& members,
                   std::span<CausticMap::Group> groups) {
    ByGroup squares{};
    float square = 0;
    for (std::size_t i = 0; i < caustics.size(); ++i) {
        const std::size_t g = grouping.of[i];
        const float d = length_squared(caustics[i].towards - groups[g].direction(caustics[i].position));
        squares[g] += d;
        square += d;
    }
    const std::size_t freedom = caustics.size() - groups.size();
    const float expected = freedom > 0 ? square / static_cast<float>(freedom) : 1.0f;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const float spread = (squares[g] + expected) / members[g];
        groups[g].lobe.kappa = std::min(2 / std::max(spread, 1e-5f), Vmf::max_kappa);
    }
}

float light_of(std::span<const CausticMap::Group> groups) {
    return std::accumulate(groups.begin(), groups.end(), 0.0f,
                           [](float sum, const CausticMap::Group& group) { return sum + mean_value(group.light); });
}

/// Of the first so many groups those become the bright ones that are.
template <class IsBright>
void leave_bright(CausticMap::Cell& cell, std::size_t count, const IsBright& is_bright) {
    const std::span groups(cell.groups.data(), count);
    const auto dim = std::partition(groups.begin(), groups.end(), is_bright);
    cell.bright = static_cast<std::size_t>(dim - groups.begin());
    cell.light = light_of(groups.first(cell.bright));
}

CausticMap::Cell cell_of(std::span<const CausticLobe> caustics, const Box3& bounds) {
    const Vec3 size = bounds.size();
    const Vec3 around = Vec3(1, 1, 1) * (2 * std::max({size.x, size.y, size.z, 1e-6f}));
    // Outermost points lie within an interval's ends by chance, or where space was divided on one of these.
    const auto n = static_cast<float>(caustics.size());
    CausticMap::Cell cell;
    cell.reach = Box3(bounds.min - around, bounds.max + around);
    cell.extent = size * ((n + 0.5f) / std::max(1.0f, n - 1));

    const Grouping grouping = grouped(caustics);
    cell.count = grouping.count;
    const std::span groups(cell.groups.data(), cell.count);
    ByGroup members{};
    for (std::size_t i = 0; i < caustics.size(); ++i) {
        ++members[grouping.of[i]];
    }
    place_groups(caustics, grouping, groups);
    turn_groups(caustics, grouping, members, 1 / std::max({size.x, size.y, size.z, 1e-6f}), groups);
    spread_groups(caustics, grouping, members, groups);
    const float all = light_of(groups);
    leave_bright(cell, cell.count, [all](const CausticMap::Group& group) {
        return vmf_peak(group.lobe.kappa) * mean_value(group.light) >= least_contrast * inv_4pi * all;
    });
    return cell;
}

}  // namespace

float CausticMap::Cell::fluence(bool in_volume) const {
    const float area = std::max({extent.x * extent.y, extent.y * extent.z, extent.z * extent.x});
    const float size = in_volume ? extent.x * extent.y * extent.z : area;
    return light / std::max(size, 1e-20f);
}

CausticMap::CausticMap(std::vector<CausticLobe> caustics) : size_(caustics.size()) {
    struct Part {
        std::span<CausticLobe> caustics;
        std::size_t node;
    };
    // What is much fainter than others says nothing, and would be nothing to divide by.
    double all = 0;
    for (const CausticLobe& lobe : caustics) {
        all += static_cast<double>(mean_value(lobe.light));
    }
    const auto negligible = static_cast<float>(1e-9 * all / static_cast<double>(std::max<std::size_t>(size_, 1)));
    std::erase_if(caustics, [&](const CausticLobe& lobe) { return mean_value(lobe.light) <= negligible; });
    std::vector<Part> parts;
    if (!caustics.empty()) {
        nodes_.emplace_back();
        parts.push_back({caustics, 0});
    }
    while (!parts.empty()) {
        const auto [here, node] = parts.back();
        parts.pop_back();
        Box3 bounds;
        for (const CausticLobe& lobe : here) {
            bounds.extendBy(lobe.position);
        }
        if (here.size() <= most_caustic_lobes) {
            nodes_[node].next = static_cast<std::uint32_t>(cells_.size());
            cells_.push_back(cell_of(here, bounds));
            continue;
        }
        const auto axis = static_cast<int>(bounds.majorAxis());
        const std::size_t half = here.size() / 2;
        std::nth_element(
            here.begin(), here.begin() + static_cast<std::ptrdiff_t>(half), here.end(),
            [axis](const CausticLobe& a, const CausticLobe& b) { return a.position[axis] < b.position[axis]; });
        const std::size_t next = nodes_.size();
        nodes_[node] = {here[half].position[axis], axis, static_cast<std::uint32_t>(next)};
        nodes_.resize(next + 2);
        parts.push_back({here.first(half), next});
        parts.push_back({here.subspan(half), next + 1});
    }
}

CausticMap CausticMap::keeping(const std::function<bool(const Cell&, const Group&)>& is_worth) const {
    CausticMap kept = *this;
    bool any = false;
    for (Cell& cell : kept.cells_) {
        const Cell before = cell;
        leave_bright(cell, cell.bright, [&](const Group& group) { return is_worth(before, group); });
        any |= cell.bright > 0;
    }
    return any ? kept : CausticMap();
}

const CausticMap::Cell* CausticMap::find(const Vec3& position) const {
    if (nodes_.empty()) {
        return nullptr;
    }
    const Node* node = nodes_.data();
    while (node->axis >= 0) {
        node = &nodes_[node->next + (position[node->axis] < node->split ? 0 : 1)];
    }
    const Cell& cell = cells_[node->next];
    return cell.reach.intersects(position) ? &cell : nullptr;
}

Vec3 CausticLobeMixture::sample(float u, const Vec2& u2) const {
    float left = u * sum_;
    std::size_t i = 0;
    while (i + 1 < count_ && left >= weights_[i]) {
        left -= weights_[i++];
    }
    return lobes_[i].sample(u2);
}

float CausticLobeMixture::density(const Vec3& direction) const {
    float sum = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        sum += weights_[i] * lobes_[i].density(direction);
    }
    return sum / sum_;
}

}  // namespace wend
