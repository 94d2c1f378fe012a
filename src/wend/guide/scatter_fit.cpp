#include <wend/guide/scatter_fit.h>

#include <wend/guide/field_memory.h>

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

/// What connections found of lights close to a cell.
struct NearSums {
    double found = 0;
    /// What was found times squared distance, and that times the light's place, from the cell's reference point, and
    /// the square of that.
    double intensity = 0;
    Imath::V3d place{0, 0, 0};
    double square = 0;

    NearSums() = default;
    /// What a near light stands for, of so many records and so much found by connections.
    NearSums(const NearLight& near, const Vec3& reference, double records, double connected)
        : found(static_cast<double>(near.share) * connected), intensity(static_cast<double>(near.intensity) * records) {
        const Imath::V3d from_reference = Imath::V3d(near.position) - Imath::V3d(reference);
        place = from_reference * intensity;
        square = (from_reference.length2() + static_cast<double>(near.extent_squared)) * intensity;
    }

    NearSums& operator+=(const NearSums& o) {
        found += o.found;
        intensity += o.intensity;
        place += o.place;
        square += o.square;
        return *this;
    }

    NearLight light(const Vec3& reference, double records, double connected) const {
        // What is larger would not leave room for what flights multiply it with.
        constexpr double largest = 1e20;
        if (!(intensity > 0 && connected > 0 && intensity <= largest * records)) {
            return {};
        }
        const Imath::V3d from_reference = place / intensity;
        return {Vec3(Imath::V3d(reference) + from_reference),
                static_cast<float>(std::max(0.0, square / intensity - from_reference.length2())),
                static_cast<float>(intensity / records), static_cast<float>(std::min(1.0, found / connected))};
    }
};

struct Found {
    ScatterSums sums;
    NearSums near;
};

/// The records of a cell summed up, freaks cut; lights within `reach` are near.
Found sums_of(std::span<const ScatterRecord> records, std::span<const std::uint32_t> chosen, const Vec3& reference,
              double reach) {
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
    double connected_sum = 0;
    Imath::V3d direction(0, 0, 0);
    NearSums near;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const double out = std::min(leaving[i], most_leaving), in = std::min(connected[i], most_connected);
        const ScatterRecord& record = records[chosen[i]];
        const auto side = static_cast<std::size_t>(side_of(record.normal));
        ++count[side];
        leaving_sum[side] += out;
        connected_sum += in;
        if (in > 0) {
            direction += Imath::V3d(record.to_light) * in;
        }
        if (const double distance = record.light_distance; in > 0 && distance <= reach) {
            const Imath::V3d place =
                Imath::V3d(record.position) - Imath::V3d(reference) + Imath::V3d(record.to_light) * distance;
            // Uncut: it does not grow towards the light.
            const double intensity = connected[i] * sqr(distance);
            near.found += in;
            near.intensity += intensity;
            near.place += place * intensity;
            near.square += place.length2() * intensity;
        }
    }
    ScatterSums sums;
    std::copy(count.begin(), count.end(), sums.records.begin());
    std::copy(leaving_sum.begin(), leaving_sum.end(), sums.leaving.begin());
    sums.connected = static_cast<float>(connected_sum);
    sums.connected_direction = Vec3(direction);
    return {sums, near};
}

ScatteredLight light_of(const ScatterSums& sums, const NearLight& near, const Region& region,
                        const Statistics& statistics) {
    constexpr double enough = 16;
    ScatteredLight light;
    light.near = near;
    if (statistics.fluence_square > 0) {
        const double effective = sqr(statistics.fluence) / statistics.fluence_square;  // kish1965
        light.confidence = static_cast<float>(effective / (effective + enough));
    }
    light.walked = {region.fluence(), mean_direction(region.mixture())};
    if (const float records = sums.all_records(); records > 0) {
        light.connected.fluence = sums.connected / records;
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
            Field::Memory& memory = field.memories_[cell];
            ScatterSums& sums = memory.scattered;
            sums = sums.scaled(static_cast<float>(decay));
            NearLight near = field.scattered_[cell].near;
            if (begin[cell] < begin[cell + 1]) {
                // Further away, what arrives hardly changes within the cell.
                const double reach = memory.radius;
                const Vec3& reference = field.regions_[cell].reference();
                NearSums known(near, reference, sums.all_records(), sums.connected);
                const Found found = sums_of(
                    records, std::span(order).subspan(begin[cell], begin[cell + 1] - begin[cell]), reference, reach);
                sums += found.sums;
                near = (known += found.near).light(reference, sums.all_records(), sums.connected);
            }
            field.scattered_[cell] = light_of(sums, near, field.regions_[cell], memory.statistics);
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
