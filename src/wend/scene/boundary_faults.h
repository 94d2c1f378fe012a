// Objects that do not hold their medium: open meshes, badly oriented ones.
#pragma once

#include <wend/scene/scene.h>

#include <cstddef>
#include <vector>

namespace wend {

/// What is wrong with a surface around a homogeneous medium.
struct BoundaryFault {
    enum class Kind {
        open,        ///< it ends at edges, and nothing else goes on from there
        contrary,    ///< its triangles face against their neighbours
        inside_out,  ///< the medium is not within the boundary but everywhere else
    };
    Kind kind;
    MediumId medium;
    int surface;             ///< index in SceneDescription::surfaces
    std::size_t edges = 0;   ///< that are at fault
    Vec3 position{0, 0, 0};  ///< the middle of one of them; world, or space of the object definition
};

/// The faults of all homogeneous media that are the interior of a surface which lets light in: one at most for a
/// surface and kind, and the first few of a medium. All surfaces around a medium are judged together. Nothing is said
/// where that takes more than matching edges: boundaries with cut spheres or disks, with parts in several objects, or
/// with holes that opaque surfaces may close. Linear in the number of triangles.
std::vector<BoundaryFault> boundary_faults(const SceneDescription& scene);

}  // namespace wend
