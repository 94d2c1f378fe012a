#include <wend/io/openvdb_layout.h>

#include <wend/io/bytes.h>

#include <blosc.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <tuple>

namespace wend {
namespace {

constexpr std::uint32_t oldest_version = 222, newest_version = 224;
constexpr std::string_view half_suffix = "_HalfFloat";
constexpr char before_number = '\x1e';  // of the grids of one name

std::string_view take_text(Bytes& bytes) {
    return bytes.take(bytes.take<std::uint32_t>());
}

void skip_metadata(Bytes& bytes) {
    for (auto count = bytes.take<std::uint32_t>(); count > 0; --count) {
        take_text(bytes);  // name
        take_text(bytes);  // type
        take_text(bytes);  // value
    }
}

template <class T>
void append(std::string& to, const T& value) {
    to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append_text(std::string& to, std::string_view text) {
    append(to, static_cast<std::uint32_t>(text.size()));
    to += text;
}

/// The kinds of values whose trees are read.
struct Scalar {
    std::string_view tree;
    std::size_t bytes;
};
constexpr std::array<Scalar, 2> scalars{{{"Tree_float_5_4_3", 4}, {"Tree_double_5_4_3", 8}}};

struct ValueSize {
    std::size_t in_memory, in_file;
};

std::optional<ValueSize> value_size(std::string_view type) {
    const bool half = type.ends_with(half_suffix);
    type.remove_suffix(half ? half_suffix.size() : 0);
    for (const Scalar& scalar : scalars) {
        if (type == scalar.tree) {
            return ValueSize{scalar.bytes, half ? 2 : scalar.bytes};
        }
    }
    return std::nullopt;
}

/// The bytes of a linear map after its name.
std::optional<std::size_t> map_bytes(std::string_view name) {
    constexpr std::size_t vector = 3 * sizeof(double), matrix = 16 * sizeof(double);
    constexpr std::array<std::pair<std::string_view, std::size_t>, 7> maps{{{"AffineMap", matrix},
                                                                            {"UnitaryMap", matrix},
                                                                            {"ScaleMap", 5 * vector},
                                                                            {"UniformScaleMap", 5 * vector},
                                                                            {"TranslationMap", vector},
                                                                            {"ScaleTranslateMap", 6 * vector},
                                                                            {"UniformScaleTranslateMap", 6 * vector}}};
    for (const auto& [known, bytes] : maps) {
        if (name == known) {
            return bytes;
        }
    }
    return std::nullopt;
}

/// Walks over the nodes and the voxels of a tree, as the library reads them.
class TreeWalk {
public:
    TreeWalk(Bytes& bytes, std::uint32_t compression, const ValueSize& value, std::size_t most_memory,
             const Place& place, const std::string& name)
        : bytes_(bytes),
          compression_(compression),
          value_(value),
          most_memory_(most_memory),
          place_(place),
          name_(name) {}

    void walk() {
        expect(bytes_.take<std::int32_t>() == 1);  // buffers
        bytes_.take(value_.in_memory);             // the background
        const auto tiles = bytes_.take<std::uint32_t>(), children = bytes_.take<std::uint32_t>();
        for (std::uint32_t i = 0; i < tiles; ++i) {
            bytes_.take(sizeof(Coordinates) + value_.in_memory);
            expect(bytes_.take<std::uint8_t>() <= 1);  // active or not
            count(tile_memory);
        }
        std::optional<Coordinates> before;
        for (std::uint32_t i = 0; i < children; ++i) {
            const auto at = bytes_.take<Coordinates>();
            // The voxels come in the order of the coordinates, whatever that of the nodes.
            expect(!before || std::tie((*before)[0], (*before)[1], (*before)[2]) < std::tie(at[0], at[1], at[2]));
            expect(std::all_of(at.begin(), at.end(), [](std::int32_t c) { return c % upper_extent == 0; }));
            before = at;
            node<upper_log2>();
        }
        for (const std::string_view mask : leaves_) {
            expect(bytes_.take(mask.size()) == mask);
            values(leaf_voxels, mask);
        }
    }

    std::size_t memory() const { return memory_; }

private:
    using Coordinates = std::array<std::int32_t, 3>;

    static constexpr int upper_log2 = 5, lower_log2 = 4, leaf_log2 = 3;
    static constexpr std::int32_t upper_extent = 1 << (upper_log2 + lower_log2 + leaf_log2);
    static constexpr std::size_t leaf_voxels = 1 << (3 * leaf_log2);
    static constexpr std::size_t tile_memory = 96;  // a node of std::map

    /// An inner node and all below it.
    template <int Log2>
    void node() {
        constexpr std::size_t entries = std::size_t{1} << (3 * Log2);
        const std::string_view children = bytes_.take(entries / 8), active = bytes_.take(entries / 8);
        count(entries * std::max(sizeof(void*), value_.in_memory) + 2 * entries / 8);
        int inner = 0;
        for (std::size_t i = 0; i < children.size(); ++i) {
            expect((children[i] & active[i]) == 0);
            inner += std::popcount(static_cast<unsigned char>(children[i]));
        }
        values(entries, active);
        for (int i = 0; i < inner; ++i) {
            if constexpr (Log2 == upper_log2) {
                node<lower_log2>();
            } else {
                leaves_.push_back(bytes_.take(leaf_voxels / 8));
                count(leaf_voxels * value_.in_memory + 2 * leaf_voxels / 8);
            }
        }
    }

    /// The values of a node, of which some may be left out.
    void values(std::size_t entries, std::string_view active) {
        enum { no_mask_and_one_value = 2, mask = 3, mask_and_one_value = 4, mask_and_two_values = 5, all_values = 6 };
        const auto kind = bytes_.take<std::uint8_t>();
        expect(kind <= all_values);
        const bool one = kind == no_mask_and_one_value || kind == mask_and_one_value || kind == mask_and_two_values;
        bytes_.take((one ? value_.in_memory : 0) + (kind == mask_and_two_values ? value_.in_memory : 0));
        if (kind == mask || kind == mask_and_one_value || kind == mask_and_two_values) {
            bytes_.take(entries / 8);
        }
        std::size_t stored = entries;
        if ((compression_ & active_alone) && kind != all_values) {
            stored = 0;
            for (const char byte : active) {
                stored += static_cast<std::size_t>(std::popcount(static_cast<unsigned char>(byte)));
            }
        }
        packed(stored * value_.in_file);
    }

    /// So many bytes, if compressed then as the file says.
    void packed(std::size_t size) {
        if ((compression_ & (zip | blosc)) == 0 || (value_.in_file != value_.in_memory && size == 0)) {
            bytes_.take(size);
            return;
        }
        const auto stored = bytes_.take<std::int64_t>();
        if (stored <= 0) {
            expect(stored == -static_cast<std::int64_t>(size));
            bytes_.take(size);
            return;
        }
        const std::string_view data = bytes_.take(static_cast<std::uint64_t>(stored));
        // The library throws at damage in the midst of a tree, and then loses what it has read.
        expect(compression_ & blosc ? unpacks_by_blosc(data, size) : unpacks_by_zlib(data, size));
    }

    bool unpacks_by_blosc(std::string_view data, std::size_t size) {
        std::size_t unpacked = 0;
        return blosc_cbuffer_validate(data.data(), data.size(), &unpacked) == 0 && unpacked == size &&
               blosc_decompress_ctx(data.data(), unpacked_.data(), size, 1) == static_cast<int>(size);
    }

    bool unpacks_by_zlib(std::string_view data, std::size_t size) {
        auto unpacked = static_cast<uLongf>(size);
        return uncompress(reinterpret_cast<Bytef*>(unpacked_.data()), &unpacked,
                          reinterpret_cast<const Bytef*>(data.data()), static_cast<uLong>(data.size())) == Z_OK &&
               unpacked == size;
    }

    void count(std::size_t memory) {
        memory_ += memory;
        if (memory_ > most_memory_) {
            throw InputError(place_, fmt::format("grid `{}`: its tree takes more memory than the {} MiB allowed", name_,
                                                 most_memory_ >> 20));
        }
    }

    void expect(bool condition) const {
        if (!condition) {
            throw InputError(place_, fmt::format("grid `{}` is damaged", name_));
        }
    }

    enum : std::uint32_t { zip = 1, active_alone = 2, blosc = 4 };

    Bytes& bytes_;
    std::uint32_t compression_;
    ValueSize value_;
    std::size_t most_memory_;
    const Place& place_;
    const std::string& name_;
    std::size_t memory_ = 0;
    std::vector<std::string_view> leaves_;  ///< their masks of active voxels
    std::vector<char> unpacked_ = std::vector<char>(sizeof(double) << (3 * upper_log2));
};

}  // namespace

OpenVdbLayout::OpenVdbLayout(std::string_view content, const Place& place) : content_(content), place_(place) {
    constexpr std::size_t library_version_bytes = 8, uuid_bytes = 36;
    Bytes bytes(content, place);
    bytes.take<std::int64_t>();  // the magic number
    const auto version = bytes.take<std::uint32_t>();
    if (version < oldest_version || version > newest_version) {
        throw InputError(place, fmt::format("its version {} is not among those that are known, {} to {}", version,
                                            oldest_version, newest_version));
    }
    bytes.take(library_version_bytes);
    start_ = content.substr(0, content.size() - bytes.left());
    const bool has_offsets = bytes.take<std::uint8_t>() != 0;
    bytes.take(uuid_bytes);
    skip_metadata(bytes);
    const auto count = bytes.take<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
        OpenVdbGrid grid;
        grid.unique_name = take_text(bytes);
        grid.name = grid.unique_name.substr(0, grid.unique_name.find(before_number));
        grid.type = take_text(bytes);
        grid.tree_of = take_text(bytes);
        if (grid.tree_of.empty()) {
            grid.tree_of = grid.unique_name;
        }
        const auto begin = bytes.take<std::uint64_t>(), voxels = bytes.take<std::uint64_t>();
        const auto end = bytes.take<std::uint64_t>();
        if (!has_offsets && count > 1) {
            throw InputError(place,
                             "holds several grids without a table of where they begin: write it to a file that "
                             "can be sought in, not to a stream");
        }
        grid.begin = has_offsets ? begin : content.size() - bytes.left();
        if (has_offsets) {
            // A grid that ended before its own description would be read for ever.
            if (content.size() - bytes.left() > begin || begin > voxels || voxels > end) {
                throw InputError(place, "the file is damaged");
            }
            bytes.seek(end);
        }
        grids_.push_back(std::move(grid));
    }
}

OpenVdbLayout::Checked OpenVdbLayout::check(const OpenVdbGrid& grid, std::size_t most_memory) const {
    const auto owner = std::find_if(grids_.begin(), grids_.end(),
                                    [&](const OpenVdbGrid& other) { return other.unique_name == grid.tree_of; });
    if (owner == grids_.end() || owner->type != grid.type || owner->tree_of != owner->unique_name) {
        throw InputError(place_, fmt::format("grid `{}`: there is no grid `{}` whose voxels it could share", grid.name,
                                             grid.tree_of));
    }
    const auto to_map = [this](const OpenVdbGrid& at) {
        Bytes bytes(content_, place_);
        bytes.seek(at.begin);
        const auto compression = bytes.take<std::uint32_t>();
        skip_metadata(bytes);
        return std::pair(bytes, compression);
    };
    const auto skip_map = [&](Bytes& bytes) {
        const std::size_t left = bytes.left();
        const std::string_view map = take_text(bytes);
        const auto size = map_bytes(map);
        if (!size) {
            throw InputError(place_, fmt::format("grid `{}`: its map to the world is not affine", grid.name));
        }
        bytes.take(*size);
        return content_.substr(content_.size() - left, left - bytes.left());
    };
    auto own = to_map(grid).first;
    const std::string_view map = skip_map(own);
    auto [bytes, compression] = to_map(*owner);
    skip_map(bytes);
    const std::size_t left = bytes.left();
    TreeWalk tree(bytes, compression, value_size(grid.type).value(), most_memory, place_, grid.name);
    tree.walk();

    Checked checked;
    checked.memory = tree.memory();
    checked.tree = content_.substr(content_.size() - left, left - bytes.left());
    std::string& header = checked.header;
    header = start_;
    header += '\0';  // no table of where grids begin
    header += "00000000-0000-0000-0000-000000000000";
    append(header, std::uint32_t{0});  // metadata of the file
    append(header, std::uint32_t{1});  // grids
    append_text(header, grid.name);
    append_text(header, grid.type);
    append_text(header, "");  // shares no voxels
    header.append(3 * sizeof(std::int64_t), '\0');
    append(header, compression);
    if (grid.type.ends_with(half_suffix)) {
        append(header, std::uint32_t{1});  // metadata of the grid
        append_text(header, "is_saved_as_half_float");
        append_text(header, "bool");
        append_text(header, "\x01");
    } else {
        append(header, std::uint32_t{0});
    }
    header += map;
    return checked;
}

bool is_scalar(const OpenVdbGrid& grid) {
    return value_size(grid.type).has_value();
}

}  // namespace wend
