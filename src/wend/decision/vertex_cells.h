// Cells for what is learned of vertices by place: a regular grid, surfaces apart by the direction they face.
#pragma once

#include <wend/core/vector.h>
#include <wend/decision/light_choice.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace wend {

/// 12³ cells over a box, for vertices in volumes and for those on surfaces by the axis that is closest to the normal
/// and its direction.
class VertexCells {
public:
    /// Of all cells.
    static constexpr std::size_t count = 7 * 12 * 12 * 12;

    /// Over that box.
    explicit VertexCells(const Box3& box) : box_(box) {}

    /// Positions outside the box, and those that are not numbers, belong to cells at the rim.
    std::size_t at(const LightReceiver& vertex) const {
        int cell = kind_of(vertex.normal);
        for (int axis = 0; axis < 3; ++axis) {
            const float size = box_.max[axis] - box_.min[axis];
            const float u = size > 0 ? (vertex.position[axis] - box_.min[axis]) / size : 0.0f;
            // In this order a position that is not a number gives 0.
            cell = cell * side + static_cast<int>(std::min(std::max(0.0f, u * side), side - 1.0f));
        }
        return static_cast<std::size_t>(cell);
    }

    /// In the middle of a cell.
    LightReceiver centre_of(std::size_t cell) const {
        auto rest = static_cast<int>(cell);
        LightReceiver vertex{box_.min};
        for (int axis = 2; axis >= 0; --axis) {
            const float step = (box_.max[axis] - box_.min[axis]) / side;
            vertex.position[axis] += step * (static_cast<float>(rest % side) + 0.5f);
            rest /= side;
        }
        if (rest > 0) {
            vertex.normal[(rest - 1) / 2] = rest % 2 == 1 ? 1.0f : -1.0f;
        }
        return vertex;
    }

private:
    static constexpr int side = 12;

    /// 0 in a volume.
    static int kind_of(const Vec3& normal) {
        if (normal == Vec3(0, 0, 0)) {
            return 0;
        }
        int axis = 0;
        for (int i = 1; i < 3; ++i) {
            axis = std::abs(normal[i]) > std::abs(normal[axis]) ? i : axis;
        }
        return 1 + 2 * axis + (normal[axis] < 0 ? 1 : 0);
    }

    Box3 box_;
};

}  // namespace wend
