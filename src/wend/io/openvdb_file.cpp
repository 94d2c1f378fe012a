#include <wend/core/error.h>
#include <wend/io/bytes.h>
#include <wend/io/gzip.h>
#include <wend/io/openvdb_file.h>
#include <wend/io/voxel_blocks.h>

#include <fmt/format.h>
#include <openvdb/openvdb.h>

namespace wend {
namespace {

/// Walks over the layout of a file. The library does not notice the end of a truncated one, but goes on with numbers of
/// no meaning, for minutes and gigabytes; this finds out before.
void check_whole(const std::filesystem::path& file) {
    constexpr std::uint32_t oldest_version = openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION;
    constexpr std::size_t library_version_bytes = 8, has_offsets_bytes = 1, uuid_bytes = 36;
    const Place place{file.string()};
    const std::string content = read_file(file, Grid::default_max_bytes);
    Bytes bytes(content, place);
    const auto take_text = [&bytes] { return bytes.take(bytes.take<std::uint32_t>()); };

    bytes.take<std::int64_t>();  // the magic number
    const auto version = bytes.take<std::uint32_t>();
    if (version < oldest_version || version > openvdb::OPENVDB_FILE_VERSION) {
        throw InputError(place, fmt::format("its version {} is not among those that are known, {} to {}", version,
                                            oldest_version, openvdb::OPENVDB_FILE_VERSION));
    }
    bytes.take(library_version_bytes + has_offsets_bytes + uuid_bytes);
    const auto metadata = bytes.take<std::uint32_t>();
    for (std::uint32_t i = 0; i < metadata; ++i) {
        take_text();  // name
        take_text();  // type
        take_text();  // value
    }
    const auto grids = bytes.take<std::uint32_t>();
    for (std::uint32_t i = 0; i < grids; ++i) {
        take_text();  // name
        take_text();  // type
        take_text();  // the grid it is an instance of
        const auto begin = bytes.take<std::uint64_t>(), values = bytes.take<std::uint64_t>();
        const auto end = bytes.take<std::uint64_t>();
        if (begin > values || values > end) {
            throw InputError(place, "the file is damaged");
        }
        bytes.seek(end);
    }
}

/// The file, open. Values are read at once: the library would otherwise map the file and meet its damage later.
std::unique_ptr<openvdb::io::File> open(const std::filesystem::path& file) {
    check_whole(file);
    openvdb::initialize();
    auto opened = std::make_unique<openvdb::io::File>(file.string());
    constexpr bool delay_load = false;
    opened->open(delay_load);
    return opened;
}

template <class GridType>
Volume volume_of_type(const GridType& grid, const std::string& name, const std::filesystem::path& file) {
    const auto accessor = grid.getConstAccessor();
    const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
    VoxelTree tree;
    tree.first = {box.min()[0], box.min()[1], box.min()[2]};
    tree.last = {box.max()[0], box.max()[1], box.max()[2]};
    tree.value = [&](int x, int y, int z) { return static_cast<float>(accessor.getValue({x, y, z})); };
    tree.block_occupied = [&](const Vec3i& voxel) {
        const openvdb::Coord at(voxel.x, voxel.y, voxel.z);
        return accessor.probeConstLeaf(at) || accessor.getValue(at) != 0;
    };
    tree.to_world = [&](const Imath::V3d& p) {
        const openvdb::Vec3d q = grid.indexToWorld(openvdb::Vec3d(p.x, p.y, p.z));
        return Imath::V3d(q[0], q[1], q[2]);
    };
    return volume_of(tree, name, file);
}

}  // namespace

std::optional<Volume> read_openvdb(const std::filesystem::path& file, const std::string& grid_name) {
    const auto opened = open(file);
    if (!opened->hasGrid(grid_name)) {
        return {};
    }
    const openvdb::GridBase::ConstPtr grid = opened->readGrid(grid_name);
    if (!grid->transform().isLinear()) {
        throw InputError(Place{file.string()}, fmt::format("grid `{}`: its map to the world is not affine", grid_name));
    }
    if (const auto floats = openvdb::gridConstPtrCast<openvdb::FloatGrid>(grid)) {
        return volume_of_type(*floats, grid_name, file);
    }
    if (const auto doubles = openvdb::gridConstPtrCast<openvdb::DoubleGrid>(grid)) {
        return volume_of_type(*doubles, grid_name, file);
    }
    throw InputError(Place{file.string()},
                     fmt::format("grid `{}` does not hold scalars but {}", grid_name, grid->valueType()));
}

std::vector<std::string> openvdb_names(const std::filesystem::path& file) {
    const auto opened = open(file);
    std::vector<std::string> names;
    for (auto name = opened->beginName(); name != opened->endName(); ++name) {
        names.push_back(name.gridName());
    }
    return names;
}

}  // namespace wend
