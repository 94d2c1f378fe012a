#include <wend/io/nanovdb_file.h>

#include <wend/core/error.h>
#include <wend/io/bytes.h>
#include <wend/io/gzip.h>
#include <wend/io/voxel_blocks.h>

#include <blosc.h>
#include <fmt/format.h>
#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/GridChecksum.h>
#include <nanovdb/util/HostBuffer.h>
#include <nanovdb/util/IO.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <optional>
#include <unordered_map>
#include <utility>

namespace wend {
namespace {

/// A file that is read in parts, so that what is large is in memory once. One that is compressed as a whole is unpacked
/// first.
class PartsOfFile {
public:
    explicit PartsOfFile(const std::filesystem::path& file) : place_{file.string()}, stream_(file, std::ios::binary) {
        constexpr std::string_view gzip_signature = "\x1f\x8b";
        char begin[2] = {};
        if (!stream_.read(begin, sizeof begin) || std::string_view(begin, sizeof begin) == gzip_signature) {
            // Also for the messages about files that cannot be read.
            content_ = read_file(file, Grid::default_max_bytes);
            size_ = content_->size();
        } else {
            size_ = std::filesystem::file_size(file);
        }
    }

    const Place& place() const { return place_; }
    bool at_end() const { return at_ == size_; }
    std::uint64_t position() const { return at_; }
    void seek(std::uint64_t position) { at_ = position; }
    void skip(std::uint64_t count) {
        require(count);
        at_ += count;
    }
    void read(char* to, std::uint64_t count) {
        require(count);
        if (content_) {
            std::memcpy(to, content_->data() + at_, count);
        } else {
            stream_.seekg(static_cast<std::streamoff>(at_));
            if (!stream_.read(to, static_cast<std::streamsize>(count))) {
                throw InputError(place_, "cannot be read");
            }
        }
        at_ += count;
    }
    std::string read(std::uint64_t count) {
        require(count);
        std::string bytes(count, '\0');
        read(bytes.data(), count);
        return bytes;
    }
    template <class T>
    T read() {
        T value;
        read(reinterpret_cast<char*>(&value), sizeof(T));
        return value;
    }

private:
    void require(std::uint64_t count) const {
        if (count > size_ - at_) {
            throw InputError(place_, "the file is truncated");
        }
    }

    Place place_;
    std::ifstream stream_;
    std::optional<std::string> content_;
    std::uint64_t size_ = 0, at_ = 0;
};

/// A grid as it lies in the file.
struct PackedGrid {
    std::string name;
    nanovdb::GridType type;
    nanovdb::io::Codec codec;
    std::uint64_t unpacked_size;
    std::uint64_t position = 0, size = 0;  ///< in the file
};

std::vector<PackedGrid> grids_in(PartsOfFile& file) {
    std::vector<PackedGrid> grids;
    while (!file.at_end()) {
        const auto header = file.read<nanovdb::io::Header>();
        if (header.magic != NANOVDB_MAGIC_NUMBER || header.version.getMajor() != NANOVDB_MAJOR_VERSION_NUMBER) {
            throw InputError(file.place(), "not a NanoVDB file of a version that is known");
        }
        const std::size_t first = grids.size();
        for (int i = 0; i < header.gridCount; ++i) {
            const auto meta = file.read<nanovdb::io::MetaData>();
            const std::string name = file.read(meta.nameSize);  // ends with a zero
            grids.push_back({name.c_str(), meta.gridType, header.codec, meta.gridSize, 0, meta.fileSize});
        }
        for (std::size_t i = first; i < grids.size(); ++i) {
            grids[i].position = file.position();
            file.skip(grids[i].size);
        }
    }
    return grids;
}

void unzip(const PackedGrid& grid, std::string_view all, char* to, const Place& place) {
    Bytes bytes(all, place);
    const std::string_view packed = bytes.take(bytes.take<std::uint64_t>());
    uLongf size = grid.unpacked_size;
    if (uncompress(reinterpret_cast<Bytef*>(to), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size()) !=
            Z_OK ||
        size != grid.unpacked_size) {
        throw InputError(place, fmt::format("grid `{}`: the compressed data is damaged", grid.name));
    }
}

void unblosc(const PackedGrid& grid, std::string_view all, char* to, const Place& place) {
    Bytes bytes(all, place);
    for (std::uint64_t done = 0; done < grid.unpacked_size;) {
        const std::string_view packed = bytes.take(bytes.take<std::uint64_t>());
        const std::uint64_t chunk = std::min<std::uint64_t>(grid.unpacked_size - done, nanovdb::io::Internal::MAX_SIZE);
        std::size_t size = 0;
        if (blosc_cbuffer_validate(packed.data(), packed.size(), &size) != 0 || size != chunk ||
            blosc_decompress_ctx(packed.data(), to + done, chunk, 1) != static_cast<int>(chunk)) {
            throw InputError(place, fmt::format("grid `{}`: the compressed data is damaged", grid.name));
        }
        done += chunk;
    }
}

nanovdb::HostBuffer unpack(const PackedGrid& grid, PartsOfFile& file, std::size_t most_memory) {
    const Place& place = file.place();
    if (grid.unpacked_size > most_memory) {
        throw InputError(place, fmt::format("grid `{}` has an impossible size", grid.name));
    }
    file.seek(grid.position);
    if (grid.codec == nanovdb::io::Codec::NONE && grid.unpacked_size > grid.size) {
        throw InputError(place, "the file is truncated");
    }
    nanovdb::HostBuffer buffer = nanovdb::HostBuffer::create(grid.unpacked_size);
    char* to = reinterpret_cast<char*>(buffer.data());
    switch (grid.codec) {
        case nanovdb::io::Codec::NONE:
            file.read(to, grid.unpacked_size);
            break;
        case nanovdb::io::Codec::ZIP:
            unzip(grid, file.read(grid.size), to, place);
            break;
        case nanovdb::io::Codec::BLOSC:
            unblosc(grid, file.read(grid.size), to, place);
            break;
        default:
            throw InputError(place, fmt::format("grid `{}` is compressed in an unknown way", grid.name));
    }
    return buffer;
}

/// Looks at everything in a grid's memory that a look-up follows or counts by, so that damaged data is found here and
/// not by a crash. T is the grid's kind of value.
template <class T>
class GridCheck {
public:
    GridCheck(const nanovdb::HostBuffer& buffer, const std::string& name, const Place& place)
        : begin_(reinterpret_cast<const char*>(buffer.data())), size_(buffer.size()), name_(name), place_(place) {}

    const nanovdb::NanoGrid<T>& checked() {
        expect(sizeof(nanovdb::NanoGrid<T>) + sizeof(nanovdb::NanoTree<T>) <= size_);
        const auto& grid = *reinterpret_cast<const nanovdb::NanoGrid<T>*>(begin_);
        expect(grid.isValid() && grid.gridSize() <= size_ && grid.version().getMajor() == NANOVDB_MAJOR_VERSION_NUMBER);
        const auto& tree = grid.tree();
        const auto& root = *at<nanovdb::NanoRoot<T>>(&tree, static_cast<std::int64_t>(tree.data()->mNodeOffset[3]));
        const auto tiles = root.data()->mTableSize;
        expect(tiles <= bytes_behind(&root + 1) / sizeof(typename nanovdb::NanoRoot<T>::Tile));
        for (std::uint32_t i = 0; i < tiles; ++i) {
            if (const auto* tile = root.data()->tile(i); tile->isChild()) {
                check(*at<nanovdb::NanoUpper<T>>(&root, tile->child));
            }
        }
        for (int level = 0; level < 3; ++level) {
            expect(tree.data()->mNodeCount[level] == count_[level]);
        }
        const nanovdb::GridChecksum stored(grid.checksum());
        expect(nanovdb::validateChecksum(grid, stored.mode()));
        return grid;
    }

private:
    template <class Node>
    void check(const Node& node) {
        count_node(Node::LEVEL, sizeof(Node));
        for (auto child = node.data()->mChildMask.beginOn(); child; ++child) {
            check(*at<typename Node::ChildNodeType>(&node, node.data()->mTable[*child].child));
        }
    }
    void check(const nanovdb::NanoLeaf<T>& leaf) {
        count_node(0, sizeof(leaf));
        expect(static_cast<std::uint64_t>(leaf.data()->memUsage()) <= bytes_behind(&leaf));
    }

    /// Nodes that share memory could make a small file take forever.
    void count_node(int level, std::size_t bytes) { expect(++count_[level] <= size_ / bytes); }

    std::size_t bytes_behind(const void* place) const {
        return size_ - static_cast<std::size_t>(static_cast<const char*>(place) - begin_);
    }

    template <class Node>
    const Node* at(const void* from, std::int64_t offset) const {
        std::int64_t place = 0;
        expect(!__builtin_add_overflow(static_cast<const char*>(from) - begin_, offset, &place) && place >= 0 &&
               static_cast<std::size_t>(place) <= size_ && size_ - static_cast<std::size_t>(place) >= sizeof(Node) &&
               place % NANOVDB_DATA_ALIGNMENT == 0);
        return reinterpret_cast<const Node*>(begin_ + place);
    }

    void expect(bool condition) const {
        if (!condition) {
            throw InputError(place_, fmt::format("grid `{}` is damaged", name_));
        }
    }

    const char* begin_;
    std::size_t size_;
    const std::string& name_;
    const Place& place_;
    std::size_t count_[3] = {0, 0, 0};
};

VoxelBox cube(const nanovdb::Coord& first, int extent) {
    const Vec3i low(first[0], first[1], first[2]);
    return {low, low + Vec3i(extent - 1)};
}

/// The leaves below a node, and the tiles of another value than 0. Where they are follows from the way to them, as a
/// look-up has it, and not from what the nodes say.
template <class Node>
void add_filled(const Node& node, const nanovdb::Coord& first, std::vector<VoxelBox>& filled) {
    using Child = typename Node::ChildNodeType;
    for (std::uint32_t i = 0; i < Node::SIZE; ++i) {
        const nanovdb::Coord at = first + (Node::OffsetToLocalCoord(i) << Child::TOTAL);
        if (!node.data()->mChildMask.isOn(i)) {
            if (node.data()->mTable[i].value != 0) {
                filled.push_back(cube(at, Child::DIM));
            }
        } else if constexpr (Child::LEVEL == 0) {
            filled.push_back(cube(at, Child::DIM));
        } else {
            add_filled(*node.data()->getChild(i), at, filled);
        }
    }
}

template <class T>
std::vector<VoxelBox> filled_boxes(const nanovdb::NanoTree<T>& tree) {
    std::vector<VoxelBox> filled;
    const auto& root = *tree.root().data();
    for (std::uint32_t i = 0; i < root.mTableSize; ++i) {
        const auto& tile = *root.tile(i);
        if (tile.isChild()) {
            add_filled(*root.getChild(&tile), tile.origin(), filled);
        } else if (tile.value != 0) {
            filled.push_back(cube(tile.origin(), nanovdb::NanoUpper<T>::DIM));
        }
    }
    return filled;
}

/// Looks values up. The library's accessor searches through all tiles of the root for each one that lies in none of the
/// nodes, and tiles may be any number.
template <class T>
class RootTiles {
public:
    RootTiles(const nanovdb::NanoRoot<T>& root, const std::string& name, const Place& place) : root_(*root.data()) {
        for (std::uint32_t i = 0; i < root_.mTableSize; ++i) {
            const auto* tile = root_.tile(i);
            if (!tiles_.emplace(tile->key, tile).second) {
                throw InputError(place, fmt::format("grid `{}` is damaged", name));
            }
        }
    }

    float value(const nanovdb::Coord& at) const {
        const auto found = tiles_.find(root_.CoordToKey(at));
        if (found == tiles_.end()) {
            return root_.mBackground;
        }
        return found->second->isChild() ? root_.getChild(found->second)->getValue(at) : found->second->value;
    }

    /// The leaf around a voxel; null where there is none.
    const nanovdb::NanoLeaf<T>* leaf(const nanovdb::Coord& at) const {
        const auto found = tiles_.find(root_.CoordToKey(at));
        return found != tiles_.end() && found->second->isChild() ? root_.getChild(found->second)->probeLeaf(at)
                                                                 : nullptr;
    }

private:
    using Root = std::remove_cvref_t<decltype(*std::declval<const nanovdb::NanoRoot<T>>().data())>;

    const Root& root_;
    std::unordered_map<typename Root::KeyT, const typename Root::Tile*> tiles_;
};

template <class T>
Volume volume_of_type(nanovdb::HostBuffer&& unpacked, const std::string& name, const std::filesystem::path& file) {
    const Place place{file.string()};
    const auto buffer = std::make_shared<const nanovdb::HostBuffer>(std::move(unpacked));
    const nanovdb::NanoGrid<T>& grid = GridCheck<T>(*buffer, name, place).checked();
    const RootTiles<T> tiles(grid.tree().root(), name, place);
    const nanovdb::CoordBBox box = grid.tree().bbox();
    VoxelTree tree;
    tree.active = {{box.min()[0], box.min()[1], box.min()[2]}, {box.max()[0], box.max()[1], box.max()[2]}};
    tree.filled = filled_boxes(grid.tree());
    if (grid.tree().background() != 0) {
        tree.filled.push_back(tree.active);
    }
    tree.value = [&](int x, int y, int z) { return tiles.value({x, y, z}); };
    if constexpr (std::is_same_v<T, float>) {
        static_assert(Grid::brick_side == nanovdb::NanoLeaf<T>::DIM);
        tree.leaf = [&](const Vec3i& first) -> const float* {
            const auto* leaf = tiles.leaf({first.x, first.y, first.z});
            return leaf ? leaf->data()->mValues : nullptr;
        };
        tree.memory = {buffer, reinterpret_cast<const float*>(buffer->data())};
    }
    tree.to_world = [&](const Imath::V3d& p) {
        const auto q = grid.map().applyMap(nanovdb::Vec3d(p.x, p.y, p.z));
        return Imath::V3d(q[0], q[1], q[2]);
    };
    return volume_of(tree, name, file);
}

}  // namespace

std::optional<Volume> read_nanovdb(const std::filesystem::path& file, const std::string& grid_name) {
    PartsOfFile parts(file);
    const std::vector<PackedGrid> grids = grids_in(parts);
    const auto grid =
        std::find_if(grids.begin(), grids.end(), [&](const PackedGrid& g) { return g.name == grid_name; });
    if (grid == grids.end()) {
        return {};
    }
    nanovdb::HostBuffer buffer = unpack(*grid, parts, most_memory(file));
    switch (grid->type) {
        case nanovdb::GridType::Float:
            return volume_of_type<float>(std::move(buffer), grid_name, file);
        case nanovdb::GridType::Fp4:
            return volume_of_type<nanovdb::Fp4>(std::move(buffer), grid_name, file);
        case nanovdb::GridType::Fp8:
            return volume_of_type<nanovdb::Fp8>(std::move(buffer), grid_name, file);
        case nanovdb::GridType::Fp16:
            return volume_of_type<nanovdb::Fp16>(std::move(buffer), grid_name, file);
        case nanovdb::GridType::FpN:
            return volume_of_type<nanovdb::FpN>(std::move(buffer), grid_name, file);
        default:
            throw InputError(parts.place(),
                             fmt::format("grid `{}` does not hold single-precision or quantized scalars", grid_name));
    }
}

std::vector<std::string> nanovdb_names(const std::filesystem::path& file) {
    PartsOfFile parts(file);
    std::vector<std::string> names;
    for (const PackedGrid& grid : grids_in(parts)) {
        names.push_back(grid.name);
    }
    return names;
}

}  // namespace wend
