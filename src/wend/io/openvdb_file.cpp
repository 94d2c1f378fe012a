#include <wend/io/openvdb_file.h>

#include <wend/core/error.h>
#include <wend/io/gzip.h>
#include <wend/io/openvdb_layout.h>
#include <wend/io/voxel_blocks.h>

#include <fmt/format.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <array>
#include <istream>
#include <streambuf>

namespace wend {
namespace {

/// Two texts, one after the other, as a stream.
class TwoTexts : public std::streambuf {
public:
    TwoTexts(std::string_view first, std::string_view second) : texts_{first, second} {}

protected:
    int_type underflow() override {
        while (next_ < texts_.size()) {
            const std::string_view text = texts_[next_++];
            char* const begin = const_cast<char*>(text.data());  // is only read from
            setg(begin, begin, begin + text.size());
            if (!text.empty()) {
                return traits_type::to_int_type(text.front());
            }
        }
        return traits_type::eof();
    }

private:
    std::array<std::string_view, 2> texts_;
    std::size_t next_ = 0;
};

Vec3i to_vec3i(const openvdb::Coord& c) {
    return {c[0], c[1], c[2]};
}

VoxelBox to_box(const openvdb::CoordBBox& box) {
    return {to_vec3i(box.min()), to_vec3i(box.max())};
}

/// The leaves, and the tiles of another value than 0.
template <class Tree>
std::vector<VoxelBox> filled_boxes(const Tree& tree) {
    std::vector<VoxelBox> filled;
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
        filled.push_back(to_box(leaf->getNodeBoundingBox()));
    }
    auto tile = tree.cbeginValueAll();
    tile.setMaxDepth(Tree::ValueAllCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        if (*tile != 0) {
            filled.push_back(to_box(tile.getBoundingBox()));
        }
    }
    return filled;
}

template <class GridType>
Volume volume_of_type(const GridType& grid, const std::string& name, const std::filesystem::path& file) {
    const auto accessor = grid.getConstAccessor();
    VoxelTree tree;
    tree.active = to_box(grid.evalActiveVoxelBoundingBox());
    tree.filled = filled_boxes(grid.tree());
    if (grid.background() != 0) {
        tree.filled.push_back(tree.active);
    }
    tree.value = [&](int x, int y, int z) { return static_cast<float>(accessor.getValue({x, y, z})); };
    tree.to_world = [&](const Imath::V3d& p) {
        const openvdb::Vec3d q = grid.indexToWorld(openvdb::Vec3d(p.x, p.y, p.z));
        return Imath::V3d(q[0], q[1], q[2]);
    };
    return volume_of(tree, name, file);
}

/// What the library makes of a grid that was found to be whole.
openvdb::GridBase::ConstPtr read_checked(const OpenVdbLayout::Checked& checked) {
    openvdb::initialize();
    TwoTexts buffer(checked.header, checked.tree);
    std::istream stream(&buffer);
    constexpr bool delay_load = false;
    const openvdb::GridPtrVecPtr grids = openvdb::io::Stream(stream, delay_load).getGrids();
    return grids->at(0);
}

}  // namespace

std::optional<Volume> read_openvdb(const std::filesystem::path& file, const std::string& grid_name) {
    const Place place{file.string()};
    const std::string content = read_file(file, Grid::default_max_bytes);
    const OpenVdbLayout layout(content, place);
    const auto found = std::find_if(layout.grids().begin(), layout.grids().end(),
                                    [&](const OpenVdbGrid& grid) { return grid.name == grid_name; });
    if (found == layout.grids().end()) {
        return {};
    }
    if (!is_scalar(*found)) {
        throw InputError(place, fmt::format("grid `{}` does not hold scalars, but is a {}", grid_name, found->type));
    }
    const openvdb::GridBase::ConstPtr grid = read_checked(layout.check(*found, most_memory(file)));
    if (const auto floats = openvdb::gridConstPtrCast<openvdb::FloatGrid>(grid)) {
        return volume_of_type(*floats, grid_name, file);
    }
    return volume_of_type(*openvdb::gridConstPtrCast<openvdb::DoubleGrid>(grid), grid_name, file);
}

std::vector<std::string> openvdb_names(const std::filesystem::path& file) {
    const std::string content = read_file(file, Grid::default_max_bytes);
    const OpenVdbLayout layout(content, Place{file.string()});
    std::vector<std::string> names;
    for (const OpenVdbGrid& grid : layout.grids()) {
        names.push_back(grid.name);
    }
    return names;
}

}  // namespace wend
