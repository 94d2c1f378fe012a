#include <wend/guide/field.h>

#include <wend/core/contracts.h>

namespace wend::guide {

Field::Field(const Box3& bounds) : bounds_(bounds), nodes_(1), regions_(1), memories_(1) {
}

Field Field::empty(const Box3& bounds) {
    WEND_EXPECT(!bounds.isEmpty() && is_finite(bounds.min) && is_finite(bounds.max));
    return Field(bounds);
}

const Region* Field::find(const Vec3& position) const {
    return trained_ ? &regions_[nodes_[leaf_of(position)].child] : nullptr;
}

std::size_t Field::bytes() const {
    return regions_.size() * sizeof(Region) + memories_.size() * sizeof(Memory) + nodes_.size() * sizeof(Node);
}

}  // namespace wend::guide
