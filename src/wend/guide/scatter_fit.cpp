#include <wend/guide/scatter_fit.h>

#include <wend/core/error.h>
#include <wend/core/parallel.h>
#include <wend/guide/weight_limit.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace wend::guide {
namespace {

/// What a mixture looks like as a mean direction.
Vec3 mean_direction(const VmfMixture& mixture) {
    Vec3 sum(0, 0, 0);
    for (int i = 0; i < mixture.size(); ++i) {
        const auto [weight, vmf] = mixture.lobe(i);
        sum += vmf.mean * (weight * vmf_mean_cosine(vmf.kappa));
    }
    return sum;
}

/// The records of a cell summed up, freaks cut.
ScatterSums sums_of(std::span<const ScatterRecord> records, std::span<const std::uint32_t> chosen) {
    std::vector<double> leaving, connected;
    leaving.reserve(chosen.size());
    connected.reserve(chosen.size());
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        // The records of a cell lie far apart.
        constexpr std::size_t ahead = 16;
        if (k + ahead < chosen.size()) {
            __builtin_prefetch(&records[chosen[k + ahead]].leaving);
        }
        leaving.push_back(records[chosen[k]].leaving);
        connected.push_back(records[chosen[k]].connected);
    }
    const double most_leaving = weight_limit(leaving), most_connected = weight_limit(connected);
    std::array<double, sides> count{}, leaving_sum{};
    double connected_sum = 0, extinction = 0, cost = 0;
    Imath::V3d direction(0, 0, 0);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const double out = std::min(leaving[i], most_leaving), in = std::min(connected[i], most_connected);
        const auto side = static_cast<std::size_t>(side_of(records[chosen[i]].normal));
        ++count[side];
        leaving_sum[side] += out;
        extinction += static_cast<double>(records[chosen[i]].extinction);
        cost += static_cast<double>(records[chosen[i]].cost);
        connected_sum += in;
        if (in > 0) {
            direction += Imath::V3d(records[chosen[i]].to_light) * in;
        }
    }
    ScatterSums sums;
    std::copy(count.begin(), count.end(), sums.records.begin());
    std::copy(leaving_sum.begin(), leaving_sum.end(), sums.leaving.begin());
    sums.connected = static_cast<float>(connected_sum);
    sums.connected_direction = Vec3(direction);
    sums.extinction = static_cast<float>(extinction);
    sums.cost = static_cast<float>(cost);
    return sums;
}

ScatteredLight light_of(const ScatterSums& sums, const Region& region, const Statistics& statistics) {
    constexpr double enough = 16;
    ScatteredLight light;
    if (statistics.fluence_square > 0) {
        const double effective = sqr(statistics.fluence) / statistics.fluence_square;  // kish1965
        light.trust = static_cast<float>(effective / (effective + enough));
    }
    light.walked = {region.fluence(), mean_direction(region.mixture())};
    const float records = std::accumulate(sums.records.begin(), sums.records.end(), 0.0f);
    const float leaving = std::accumulate(sums.leaving.begin(), sums.leaving.end(), 0.0f);
    if (records > 0) {
        light.connected.fluence = sums.connected / records;
        // What is known of a side that few saw is little: it is drawn to the mean.
        constexpr float prior = 4;
        for (std::size_t side = 0; side < sides; ++side) {
            light.leaving[side] = (sums.leaving[side] + prior * leaving / records) / (sums.records[side] + prior);
        }
    }
    if (sums.connected > 0) {
        light.connected.mean = sums.connected_direction / sums.connected;
    }
    return light;
}

}  // namespace

/// Sees a field's inside.
class ScatterFitting {
public:
    static Field fit(Field field, std::span<const ScatterRecord> records, double decay, int threads) {
        // A counting sort of the usable records by cell.
        std::vector<std::uint32_t> begin(field.size() + 1, 0), cell_of(records.size());
        constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
        constexpr std::size_t chunk = 1 << 15;
        parallel_for((records.size() + chunk - 1) / chunk, threads, [&](std::size_t c) {
            for (std::size_t i = c * chunk; i < std::min((c + 1) * chunk, records.size()); ++i) {
                cell_of[i] = is_usable(records[i]) ? field.nodes_[field.leaf_of(records[i].position)].child : none;
            }
        });
        for (const std::uint32_t cell : cell_of) {
            if (cell != none) {
                ++begin[cell + 1];
            }
        }
        for (std::size_t cell = 0; cell < field.size(); ++cell) {
            begin[cell + 1] += begin[cell];
        }
        std::vector<std::uint32_t> order(begin.back()), next = begin;
        for (std::size_t i = 0; i < records.size(); ++i) {
            if (cell_of[i] != none) {
                order[next[cell_of[i]]++] = static_cast<std::uint32_t>(i);
            }
        }
        parallel_for(field.size(), threads, [&](std::size_t cell) {
            ScatterSums& sums = field.memories_[cell].scattered;
            sums = sums.scaled(static_cast<float>(decay));
            sums += sums_of(records, std::span(order).subspan(begin[cell], begin[cell + 1] - begin[cell]));
            field.scattered_[cell] = light_of(sums, field.regions_[cell], field.memories_[cell].statistics);
        });
        return field;
    }
};

Field fit_scattered(Field field, std::span<const ScatterRecord> records, double decay, int threads) {
    if (!(decay >= 0 && decay <= 1)) {
        throw InputError("guiding field: the decay must be 0 to 1");
    }
    return ScatterFitting::fit(std::move(field), records, decay, threads);
}

}  // namespace wend::guide
