// How an OpenVDB file is laid out. The library trusts the counts and sizes in it; this looks at all of them before.
#pragma once

#include <wend/core/error.h>

#include <string>
#include <string_view>
#include <vector>

namespace wend {

/// A grid of an OpenVDB file, by the file's table.
struct OpenVdbGrid {
    std::string name;
    /// As the file has it, such as "Tree_float_5_4_3_HalfFloat".
    std::string type;
    /// The name of the grid whose voxels it shares, and its own otherwise: unique in the file.
    std::string tree_of;
    std::string unique_name;
    std::size_t begin = 0;
};

/// The structure of a file of the versions 222 to 224, whose content is referred to. Nothing takes memory by a number
/// in it that was not compared with what is there. All throw InputError naming the file.
class OpenVdbLayout {
public:
    OpenVdbLayout(std::string_view content, const Place& place);

    const std::vector<OpenVdbGrid>& grids() const { return grids_; }

    /// Two parts that together are a file with this grid alone and no metadata, every count in it checked: a header
    /// made anew, and what of the content follows it. The grid has to be of scalars (is_scalar()) on an affine map.
    /// `memory` is what its tree takes when it is read, which is below `most_memory`.
    struct Checked {
        std::string header;
        std::string_view tree;
        std::size_t memory = 0;
    };
    Checked check(const OpenVdbGrid& grid, std::size_t most_memory) const;

private:
    std::string_view content_;
    Place place_;
    std::string_view start_;  ///< magic number and versions
    std::vector<OpenVdbGrid> grids_;
};

/// Whether the type is one of trees of float or double in the usual sizes, in full or half precision.
bool is_scalar(const OpenVdbGrid& grid);

}  // namespace wend
