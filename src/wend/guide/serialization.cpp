#include <wend/core/error.h>
#include <wend/guide/field.h>
#include <wend/guide/field_bytes.h>
#include <wend/guide/field_memory.h>
#include <wend/guide/scatter_fit.h>
#include <wend/guide/sealed_bytes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace wend::guide {
namespace {

constexpr SealedKind sealed_field{"guiding field", "a field", "WENDFLD\x1a", 5};

[[noreturn]] void refuse(const std::string& reason) {
    throw InputError(std::string(sealed_field.title) + ": " + reason);
}

template <class T>
void put(std::string& out, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    out.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

}  // namespace

/// Takes numbers from the front, and refuses those that a field cannot hold.
class FieldBytesReader {
public:
    explicit FieldBytesReader(std::string_view bytes) : rest_(bytes) {}

    template <class T>
    T take() {
        if (rest_.size() < sizeof(T)) {
            refuse("the bytes are truncated");
        }
        T value;
        std::memcpy(static_cast<void*>(&value), rest_.data(), sizeof(T));
        rest_.remove_prefix(sizeof(T));
        return value;
    }
    template <class T>
    T take_finite() {
        const T value = take<T>();
        require(std::isfinite(value));
        return value;
    }
    Vec3 take_vector() {
        const float x = take_finite<float>();
        const float y = take_finite<float>();
        return {x, y, take_finite<float>()};
    }
    /// A count of things that need `size` bytes each at least.
    std::uint64_t take_count(std::size_t size) {
        const auto count = take<std::uint64_t>();
        if (count > rest_.size() / size) {
            refuse("the bytes are truncated");
        }
        return count;
    }
    static void require(bool holds) {
        if (!holds) {
            refuse("a number is out of range");
        }
    }
    bool empty() const { return rest_.empty(); }

private:
    std::string_view rest_;
};

namespace {

using Reader = FieldBytesReader;

void put(std::string& out, const Vec3& v) {
    put(out, v.x);
    put(out, v.y);
    put(out, v.z);
}

void put_region(std::string& out, const Region& region) {
    put(out, region.reference());
    put(out, region.fluence());
    put(out, region.defensive_fraction());
    put(out, region.mixture().size());
    for (int i = 0; i < region.mixture().size(); ++i) {
        const auto [weight, vmf] = region.mixture().lobe(i);
        put(out, weight);
        put(out, vmf.mean);
        put(out, vmf.kappa);
        put(out, region.inverse_distance()[i]);
        put(out, region.colours()[i].r);
        put(out, region.colours()[i].b);
    }
}

Region take_region(Reader& in) {
    const Vec3 reference = in.take_vector();
    const auto fluence = in.take_finite<float>();
    const auto defensive_fraction = in.take_finite<float>();
    const int size = in.take<int>();
    Reader::require(size >= 1 && size <= max_lobes && fluence >= 0 && defensive_fraction > 0 &&
                    defensive_fraction <= 1);
    std::array<WeightedVmf, max_lobes> lobes{};
    Lanes inverse_distance;
    LobeColours colours;
    float total = 0;
    for (int i = 0; i < size; ++i) {
        WeightedVmf& lobe = lobes[static_cast<std::size_t>(i)];
        lobe.weight = in.take_finite<float>();
        lobe.vmf.mean = in.take_vector();
        lobe.vmf.kappa = in.take_finite<float>();
        inverse_distance[i] = in.take_finite<float>();
        constexpr float rounding = 1e-3f, brief_rounding = 1e-2f;
        Reader::require(lobe.weight >= 0 && lobe.vmf.kappa >= 0 && lobe.vmf.kappa <= Vmf::max_kappa &&
                        std::abs(length(lobe.vmf.mean) - 1) < rounding && inverse_distance[i] >= 0);
        total += lobe.weight;
        const auto red = in.take_finite<float>(), blue = in.take_finite<float>();
        Reader::require(red >= 0 && blue >= 0 && red + blue <= 3 * (1 + brief_rounding));
        colours.set(i, red, blue);
    }
    Reader::require(total > 0);
    return {reference,        VmfMixture(std::span(lobes.data(), static_cast<std::size_t>(size))),
            inverse_distance, fluence,
            colours,          defensive_fraction};
}

void put_statistics(std::string& out, const Statistics& statistics) {
    for (const double sum : {statistics.count, statistics.fluence, statistics.fluence_square, statistics.unit}) {
        put(out, sum);
    }
    for (const KeptLobeSums& lobe : statistics.lobes) {
        put(out, lobe.weight);
        put(out, lobe.weight_square);
        put(out, lobe.direction);
        put(out, lobe.per_weight);
    }
    put(out, statistics.share_sums.moment);
    put(out, statistics.share_sums.square);
}

void put_scattered(std::string& out, const ScatterSums& sums) {
    put(out, sums.records);
    put(out, sums.leaving);
    put(out, sums.connected);
    put(out, sums.connected_direction);
}

void put_near(std::string& out, const NearLight& near) {
    put(out, near.position);
    put(out, near.extent_squared);
    put(out, near.intensity);
    put(out, near.share);
}

NearLight take_near(Reader& in) {
    NearLight near;
    near.position = in.take_vector();
    near.extent_squared = in.take_finite<float>();
    near.intensity = in.take_finite<float>();
    near.share = in.take_finite<float>();
    Reader::require(near.extent_squared >= 0 && near.intensity >= 0 && near.share >= 0 && near.share <= 1);
    return near;
}

ScatterSums take_scattered(Reader& in) {
    ScatterSums sums;
    const auto take = [&in](float& sum) {
        sum = in.take_finite<float>();
        Reader::require(sum >= 0);
    };
    std::for_each(sums.records.begin(), sums.records.end(), take);
    std::for_each(sums.leaving.begin(), sums.leaving.end(), take);
    take(sums.connected);
    sums.connected_direction = in.take_vector();
    return sums;
}

Statistics take_statistics(Reader& in) {
    Statistics statistics;
    for (double* sum : {&statistics.count, &statistics.fluence, &statistics.fluence_square, &statistics.unit}) {
        *sum = in.take_finite<double>();
        Reader::require(*sum >= 0);
    }
    for (KeptLobeSums& lobe : statistics.lobes) {
        lobe.weight = in.take_finite<float>();
        lobe.weight_square = in.take_finite<float>();
        lobe.direction = in.take_vector();
        for (BriefFloat& value : lobe.per_weight) {
            value = in.take<BriefFloat>();
            Reader::require(std::isfinite(static_cast<float>(value)));
        }
        Reader::require(lobe.weight >= 0 && lobe.weight_square >= 0);
    }
    for (double& moment : statistics.share_sums.moment) {
        moment = in.take_finite<double>();
        Reader::require(moment >= 0);
    }
    statistics.share_sums.square = in.take_finite<double>();
    Reader::require(statistics.share_sums.square >= 0);
    return statistics;
}

}  // namespace

std::string FieldBytes::body(const Field& field) {
    std::string out;
    put(out, field.bounds_.min);
    put(out, field.bounds_.max);
    put(out, static_cast<std::uint8_t>(field.trained_));
    put(out, static_cast<std::uint64_t>(field.nodes_.size()));
    for (const Field::Node& node : field.nodes_) {
        put(out, node.plane);
        put(out, static_cast<std::uint8_t>(node.axis));
        put(out, static_cast<std::uint32_t>(node.child));
    }
    put(out, static_cast<std::uint64_t>(field.regions_.size()));
    for (std::size_t i = 0; i < field.regions_.size(); ++i) {
        const Field::Memory& memory = field.memories_[i];
        put_region(out, field.regions_[i]);
        put(out, memory.depth);
        put(out, memory.radius);
        put(out, static_cast<std::uint8_t>(memory.anchored));
        put(out, memory.located);
        put(out, memory.offset);
        put(out, memory.offset_square);
        put_statistics(out, memory.statistics);
        put_scattered(out, memory.scattered);
        put_near(out, field.scattered_[i].near);
    }
    return out;
}

Field FieldBytes::field(Reader& in) {
    Box3 bounds;
    bounds.min = in.take_vector();
    bounds.max = in.take_vector();
    Reader::require(!bounds.isEmpty());
    Field field = Field::empty(bounds);
    field.trained_ = in.take<std::uint8_t>() != 0;
    field.nodes_.resize(in.take_count(sizeof(float) + 1 + sizeof(std::uint32_t)));
    for (Field::Node& node : field.nodes_) {
        node.plane = in.take_finite<float>();
        node.axis = in.take<std::uint8_t>() & 3u;
        node.child = in.take<std::uint32_t>() & Field::largest_child;
    }
    constexpr std::size_t least_region = 9 * sizeof(float);
    const std::uint64_t cells = in.take_count(least_region);
    field.regions_.clear();
    field.memories_.clear();
    field.scattered_.clear();
    for (std::uint64_t i = 0; i < cells; ++i) {
        field.regions_.push_back(take_region(in));
        Field::Memory& memory = field.memories_.emplace_back();
        memory.depth = in.take<std::uint32_t>();
        memory.radius = in.take_finite<float>();
        memory.anchored = in.take<std::uint8_t>() != 0;
        memory.located = in.take_finite<float>();
        memory.offset = in.take_vector();
        memory.offset_square = in.take_vector();
        memory.statistics = take_statistics(in);
        memory.scattered = take_scattered(in);
        field.scattered_.emplace_back().near = take_near(in);
    }
    require_tree(field);
    return field;
}

/// Children lie behind their parents, so that every look-up ends; each cell has one leaf.
void FieldBytes::require_tree(const Field& field) {
    Reader::require(field.nodes_.size() + 1 == 2 * field.regions_.size());
    std::vector<std::uint8_t> has_parent(field.nodes_.size(), 0), has_leaf(field.regions_.size(), 0);
    for (std::size_t i = 0; i < field.nodes_.size(); ++i) {
        const Field::Node& node = field.nodes_[i];
        if (node.axis == Field::Node::leaf) {
            Reader::require(node.child < has_leaf.size() && has_leaf[node.child]++ == 0);
        } else {
            Reader::require(node.child > i && node.child + 1u < has_parent.size() && has_parent[node.child]++ == 0 &&
                            has_parent[node.child + 1]++ == 0);
        }
    }
}

std::string to_bytes(const Field& field) {
    return seal(sealed_field, FieldBytes::body(field));
}

Field field_from_bytes(std::string_view bytes) {
    Reader in(unseal(sealed_field, bytes));
    // What rays are told follows from the sums.
    Field field = FieldBytes::field(in);
    field = fit_scattered(std::move(field), {}, 1);
    if (!in.empty()) {
        refuse("there are more bytes than a field has");
    }
    return field;
}

}  // namespace wend::guide
