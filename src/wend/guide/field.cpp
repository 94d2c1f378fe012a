#include <wend/guide/field.h>

#include <wend/guide/field_memory.h>

#include <wend/core/contracts.h>

#include <algorithm>
#include <numeric>

namespace wend::guide {

Field::Field(const Box3& bounds) : bounds_(bounds), nodes_(1), regions_(1), scattered_(1), memories_(1) {
}

Field Field::empty(const Box3& bounds) {
    WEND_EXPECT(!bounds.isEmpty() && is_finite(bounds.min) && is_finite(bounds.max));
    return Field(bounds);
}

const Region* Field::find(const Vec3& position) const {
    return trained_ ? &regions_[nodes_[leaf_of(position)].child] : nullptr;
}

Field::Field(const Field& other) = default;
Field::Field(Field&& other) noexcept = default;
Field& Field::operator=(const Field& other) = default;
Field& Field::operator=(Field&& other) noexcept = default;
Field::~Field() = default;

float Field::leaving(const Vec3& position, const Vec3& normal) const {
    return trained_ ? memories_[nodes_[leaf_of(position)].child].scattered.leaving_to(normal) : 0.0f;
}

std::array<LobeSums, max_lobes> Field::lobe_sums(const Vec3& position) const {
    return memories_[nodes_[leaf_of(position)].child].statistics.lobe_sums();
}

std::size_t Field::bytes_per_cell() {
    return sizeof(Region) + sizeof(ScatteredLight) + sizeof(Memory) + 2 * sizeof(Node);
}

std::size_t Field::bytes() const {
    return regions_.size() * (sizeof(Region) + sizeof(ScatteredLight)) + memories_.size() * sizeof(Memory) +
           nodes_.size() * sizeof(Node);
}

void Field::for_each_cell(const std::function<void(const Box3&, const Region&, double)>& visit) const {
    struct Part {
        std::uint32_t node;
        Box3 box;
    };
    std::vector<Part> open = {{0, bounds_}};
    while (!open.empty()) {
        const Part part = open.back();
        open.pop_back();
        const Node& node = nodes_[part.node];
        if (node.axis == Node::leaf) {
            visit(part.box, regions_[node.child], memories_[node.child].statistics.count);
            continue;
        }
        const int axis = static_cast<int>(node.axis);
        const std::uint32_t child = node.child;
        Part below{child, part.box}, above{child + 1, part.box};
        const float plane = std::clamp(node.plane, part.box.min[axis], part.box.max[axis]);
        below.box.max[axis] = plane;
        above.box.min[axis] = plane;
        open.push_back(above);
        open.push_back(below);
    }
}

}  // namespace wend::guide
