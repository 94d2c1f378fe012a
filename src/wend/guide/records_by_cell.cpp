#include <wend/guide/records_by_cell.h>

#include <wend/core/contracts.h>
#include <wend/core/parallel.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace wend::guide {

std::vector<std::uint32_t> RecordsByCell::leaves_of(const Field& field) {
    std::vector<std::uint32_t> leaves(field.size());
    for (std::uint32_t node = 0; node < field.nodes_.size(); ++node) {
        if (field.nodes_[node].axis == Field::Node::leaf) {
            leaves[field.nodes_[node].child] = node;
        }
    }
    return leaves;
}

// A stable counting sort by leaf, in chunks that do not depend on the threads.
RecordsByCell::RecordsByCell(const Field& field, std::span<const Record> records, std::span<const std::uint32_t> cells,
                             int threads)
    : records_(records) {
    WEND_EXPECT(records.size() < std::numeric_limits<std::uint32_t>::max());
    WEND_EXPECT(cells.empty() || cells.size() == records.size());
    const std::vector<std::uint32_t> leaves = cells.empty() ? std::vector<std::uint32_t>() : leaves_of(field);
    constexpr std::uint32_t unusable = std::numeric_limits<std::uint32_t>::max();
    constexpr std::size_t chunk = 1 << 15;
    const std::size_t chunks = (records.size() + chunk - 1) / chunk;
    const auto for_chunks = [&](const auto& body) {
        parallel_for(chunks, threads,
                     [&](std::size_t c) { body(c, c * chunk, std::min((c + 1) * chunk, records.size())); });
    };
    std::vector<std::uint32_t> node_of(records.size(), unusable);
    // Of each chunk, the records by leaf; then, where the next one belongs.
    std::vector<std::vector<std::size_t>> next(chunks, std::vector<std::size_t>(field.nodes_.size(), 0));
    std::vector<std::size_t> dark(chunks, 0);
    for_chunks([&](std::size_t c, std::size_t begin, std::size_t to) {
        std::size_t without_radiance = 0;
        for (std::size_t i = begin; i < to; ++i) {
            if (is_usable(records[i])) {
                node_of[i] = cells.empty() ? field.leaf_of(records[i].position) : leaves[cells[i]];
                ++next[c][node_of[i]];
                without_radiance += records[i].radiance == 0 ? 1 : 0;
            }
        }
        dark[c] = without_radiance;
    });
    dark_ = std::accumulate(dark.begin(), dark.end(), std::size_t{0});

    std::size_t end = 0;
    for (std::uint32_t node = 0; node < field.nodes_.size(); ++node) {
        const std::size_t begin = end;
        for (std::vector<std::size_t>& of_chunk : next) {
            const std::size_t count = of_chunk[node];
            of_chunk[node] = end;
            end += count;
        }
        if (end > begin) {
            cells_.push_back({{begin, end}, node});
        }
    }
    order_.resize(end);
    for_chunks([&](std::size_t c, std::size_t begin, std::size_t to) {
        for (std::size_t i = begin; i < to; ++i) {
            if (node_of[i] != unusable) {
                order_[next[c][node_of[i]]++] = {records[i].position, static_cast<std::uint32_t>(i)};
            }
        }
    });
}

Imath::V3d RecordsByCell::mean_position(const Range& range, std::size_t stride) const {
    Imath::V3d sum(0, 0, 0);
    double count = 0;
    for (std::size_t i = range.begin; i < range.end; i += stride) {
        sum += Imath::V3d(order_[i].position);
        ++count;
    }
    return sum / count;
}

SplitPlane RecordsByCell::plane_across(const Range& range, int axis) const {
    constexpr std::size_t enough = 1024;
    const std::size_t stride = std::max<std::size_t>(range.size() / enough, 1);
    const Imath::V3d mean = mean_position(range, stride);
    Imath::V3d variance(0, 0, 0);
    Vec3 lowest = order_[range.begin].position;
    for (std::size_t i = range.begin; i < range.end; i += stride) {
        const Vec3& position = order_[i].position;
        const Imath::V3d d = Imath::V3d(position) - mean;
        variance += d * d;
        for (int a = 0; a < 3; ++a) {
            lowest[a] = std::min(lowest[a], position[a]);
        }
    }
    if (axis == SplitPlane::no_axis) {
        axis = variance.x >= variance.y ? 0 : 1;
        axis = variance[axis] >= variance.z ? axis : 2;
    }
    const float position = static_cast<float>(mean[axis]);
    // Otherwise the positions are too close for a float between them, and one side would stay empty.
    return position > lowest[axis] ? SplitPlane{axis, position} : SplitPlane{};
}

std::size_t RecordsByCell::partition(const Range& range, const SplitPlane& plane) {
    if (plane.axis == SplitPlane::no_axis) {
        return range.end;
    }
    const auto first = order_.begin() + static_cast<std::ptrdiff_t>(range.begin);
    const auto last = order_.begin() + static_cast<std::ptrdiff_t>(range.end);
    const auto middle = std::stable_partition(
        first, last, [&](const Entry& entry) { return entry.position[plane.axis] < plane.position; });
    return static_cast<std::size_t>(middle - order_.begin());
}

}  // namespace wend::guide
