// OpenVDB files whose counts and sizes lie: they are refused, or read, in little memory, whatever the library would do.
#include <tests/support/peak_memory.h>
#include <wend/core/error.h>
#include <wend/core/random.h>
#include <wend/io/gzip.h>
#include <wend/io/volume_file.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <string>

namespace wend {
namespace {

namespace fs = std::filesystem;

class OpenVdb : public testing::Test {
protected:
    OpenVdb() : folder_(fs::temp_directory_path() / ("wend-vdb-" + std::to_string(std::random_device()()))) {
        fs::create_directory(folder_);
        openvdb::initialize();
    }
    ~OpenVdb() override { fs::remove_all(folder_); }

    fs::path store(const std::string& bytes) const {
        const fs::path file = folder_ / "a.vdb";
        std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return file;
    }
    template <class GridType>
    fs::path store(const GridType& grid, std::uint32_t compression = openvdb::io::COMPRESS_ACTIVE_MASK) const {
        const fs::path file = folder_ / "a.vdb";
        openvdb::io::File out(file.string());
        out.setCompression(compression);
        out.write({grid});
        out.close();
        return file;
    }

private:
    fs::path folder_;
};

/// The message of the error; empty where the file is read. Either way it takes little memory.
std::string error_of(const fs::path& file) {
    const test::PeakMemory memory;
    std::string message;
    try {
        read_volume(file, "density");
    } catch (const InputError& error) {
        message = error.what();
        EXPECT_NE(message.find(file.string()), std::string::npos) << message;
    }
    EXPECT_LT(memory.growth(), 256 << 20) << message;
    return message;
}

#define EXPECT_REFUSED(file, part) EXPECT_NE(error_of(file).find(part), std::string::npos) << error_of(file)

template <class T>
std::string bytes_of(T value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::string text(const std::string& text) {
    return bytes_of(static_cast<std::uint32_t>(text.size())) + text;
}

struct Parts {
    std::string metadata = bytes_of(0u);
    std::string map = text("TranslationMap") + std::string(24, '\0');
    std::string tree;
    std::uint32_t compression = 0;
};

/// A file of one grid of floats.
std::string file_of(const Parts& parts) {
    const std::string start = bytes_of(std::int64_t{0x56444220}) + bytes_of(224u) + bytes_of(10u) + bytes_of(0u) +
                              '\x01' + "01234567-0123-0123-0123-0123456789ab" + bytes_of(0u) + bytes_of(1u) +
                              text("density") + text("Tree_float_5_4_3") + text("");
    const std::string grid = bytes_of(parts.compression) + parts.metadata + parts.map + parts.tree;
    const auto begin = static_cast<std::int64_t>(start.size()) + 24;
    const auto end = begin + static_cast<std::int64_t>(grid.size());
    return start + bytes_of(begin) + bytes_of(begin) + bytes_of(end) + grid;
}

/// The root of a tree with one buffer and a background of 0, as far as its counts.
std::string root(std::uint32_t tiles, std::uint32_t children) {
    return bytes_of(1) + bytes_of(0.0f) + bytes_of(tiles) + bytes_of(children);
}

std::string tile(std::int32_t x, float value) {
    return bytes_of(x) + bytes_of(0) + bytes_of(0) + bytes_of(value) + '\x01';
}

TEST_F(OpenVdb, ATreeOfOneTileOfZerosIsEmpty) {
    const Volume volume = read_volume(store(file_of({.tree = root(1, 0) + tile(4096, 0)})), "density");
    EXPECT_EQ(volume.grid.max_value(), 0);
}

TEST_F(OpenVdb, CountsOfTheRootAreComparedWithTheFile) {
    EXPECT_REFUSED(store(file_of({.tree = root(0xffffffff, 0) + tile(0, 1)})), "truncated");
    EXPECT_REFUSED(store(file_of({.tree = root(0, 0xffffffff)})), "truncated");
}

TEST_F(OpenVdb, AGridThatEndsBeforeItsDescriptionIsNotReadForEver) {
    const std::string good = file_of({.tree = root(1, 0) + tile(4096, 0)});
    const std::string kind = text("density") + text("Tree_float_5_4_3") + text("");
    const std::size_t description = good.find(kind);
    const std::string back = bytes_of(static_cast<std::int64_t>(description));
    const std::string start = good.substr(0, description - sizeof(std::uint32_t));
    EXPECT_REFUSED(store(start + bytes_of(0xffffffffu) + kind + back + back + back), "damaged");
}

TEST_F(OpenVdb, SizesOfMetadataAreComparedWithTheFile) {
    const auto metadata = [](std::uint32_t count, const std::string& type, const std::string& value) {
        return bytes_of(count) + text("name") + text(type) + value;
    };
    const std::string tree = root(1, 0) + tile(0, 0);
    EXPECT_REFUSED(store(file_of({.metadata = metadata(1, "mine", bytes_of(0xfffffff0)), .tree = tree})), "truncated");
    EXPECT_REFUSED(store(file_of({.metadata = metadata(1, "string", bytes_of(0xfffffff0)), .tree = tree})),
                   "truncated");
    EXPECT_REFUSED(store(file_of({.metadata = metadata(0xffffffff, "int32", text("1234")), .tree = tree})),
                   "truncated");
    // Nothing is made of what metadata says of itself, so that this is no fault: a thousand million leaves in 12 bytes.
    const std::string leaves = bytes_of(0x3fffffffu) + bytes_of(0u) + bytes_of(0xffffffffu);
    EXPECT_EQ(error_of(store(file_of({.metadata = metadata(1, "__delayedload", text(leaves)), .tree = tree}))), "");
}

TEST_F(OpenVdb, MapsAreLinearAndKnown) {
    const std::string tree = root(1, 0) + tile(0, 0);
    EXPECT_REFUSED(store(file_of({.map = text("NonlinearFrustumMap") + std::string(500, '\0'), .tree = tree})),
                   "not affine");
    EXPECT_REFUSED(store(file_of({.map = bytes_of(0xfffffff0), .tree = tree})), "truncated");
}

TEST_F(OpenVdb, SizesOfPackedValuesAreThoseOfTheNode) {
    // An inner node of no children whose 32768 values would be stored as they are: the size is said as its negative.
    // The library believes it, and writes so much into the node.
    for (const std::uint32_t compression : {1u, 4u, 5u}) {
        const auto node = [&](std::int64_t size) {
            const std::string masks(2 * 4096, '\0');
            return root(0, 1) + std::string(12, '\0') + masks + '\x06' + bytes_of(size) +
                   std::string(static_cast<std::size_t>(std::abs(size)), '\0');
        };
        EXPECT_EQ(error_of(store(file_of({.tree = node(-32768 * 4), .compression = compression}))), "");
        EXPECT_REFUSED(store(file_of({.tree = node(-32768 * 8), .compression = compression})), "damaged");
        EXPECT_REFUSED(store(file_of({.tree = node(-4), .compression = compression})), "damaged");
        EXPECT_NE(error_of(store(file_of({.tree = node(100), .compression = compression}))), "");
    }
}

TEST_F(OpenVdb, TilesThatStandForTooManyVoxelsAreRefused) {
    EXPECT_REFUSED(store(file_of({.tree = root(1, 0) + tile(0, 1)})), "memory");
    EXPECT_REFUSED(store(file_of({.tree = root(2, 0) + tile(0, 1) + tile(1 << 28, 1)})), "must stay within");
}

/// Two voxels, and an active tile of 128 a side far away.
openvdb::FloatGrid::Ptr far_tile(float value) {
    const auto grid = openvdb::FloatGrid::create(0.0f);
    grid->setName("density");
    grid->tree().setValue({0, 0, 0}, 1.0f);
    grid->tree().setValue({3, 2, 1}, 2.0f);
    grid->tree().addTile(2, {3968, 3968, 3968}, value, true);
    return grid;
}

TEST_F(OpenVdb, AFarTileOfZerosIsNothing) {
    const Volume volume = read_volume(store(far_tile(0)), "density");
    EXPECT_EQ(volume.grid.interpolate({3, 2, 1}), 2.0f);
    EXPECT_EQ(volume.grid.interpolate({0.5f, 0, 0}), 0.5f);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LT(volume.grid.size()[axis], 20);
    }
    EXPECT_EQ(error_of(store(far_tile(0))), "");
}

TEST_F(OpenVdb, AFarTileTakesItsOwnMemoryOnly) {
    const fs::path file = store(far_tile(3));
    EXPECT_EQ(error_of(file), "");
    const Volume volume = read_volume(file, "density");
    EXPECT_EQ(volume.grid.interpolate({0, 0, 0}), 1.0f);
    EXPECT_EQ(volume.grid.interpolate({1000, 1000, 1000}), 0.0f);
    EXPECT_EQ(volume.grid.interpolate({4000, 3990, 3970}), 3.0f);
    EXPECT_EQ(volume.grid.interpolate({3967.5f, 3990, 3990}), 1.5f);
}

template <class GridType>
typename GridType::Ptr lumps(bool half) {
    const auto grid = GridType::create(0);
    grid->setName("density");
    grid->setSaveFloatAsHalf(half);
    Pcg32 random(1);
    for (int i = 0; i < 500; ++i) {
        const auto at = [&random] { return static_cast<int>(random.next() % 80) - 40; };
        grid->tree().setValue({at(), at(), at()}, static_cast<float>(1 + random.next() % 8) / 8);
    }
    grid->tree().addTile(2, {128, 0, 0}, 0.25f, true);
    return grid;
}

template <class GridType>
void expect_read(const typename GridType::Ptr& grid, const Volume& volume) {
    Pcg32 random(2);
    for (int i = 0; i < 2000; ++i) {
        const auto at = [&random](int size) { return static_cast<int>(random.next() % static_cast<unsigned>(size)); };
        const openvdb::Coord voxel(at(300) - 40, at(160) - 40, at(160) - 40);
        ASSERT_EQ(volume.grid.interpolate(
                      {static_cast<float>(voxel[0]), static_cast<float>(voxel[1]), static_cast<float>(voxel[2])}),
                  static_cast<float>(grid->tree().getValue(voxel)));
    }
    for (auto value = grid->cbeginValueOn(); value; ++value) {
        const openvdb::Coord voxel = value.getCoord();
        ASSERT_EQ(volume.grid.interpolate(
                      {static_cast<float>(voxel[0]), static_cast<float>(voxel[1]), static_cast<float>(voxel[2])}),
                  static_cast<float>(*value));
    }
}

TEST_F(OpenVdb, EveryKindOfFileIsRead) {
    using namespace openvdb::io;
    for (const bool half : {false, true}) {
        for (const std::uint32_t compression : {0u, 1u, 3u, 6u}) {
            const auto floats = lumps<openvdb::FloatGrid>(half);
            expect_read<openvdb::FloatGrid>(floats, read_volume(store(floats, compression), "density"));
            const auto doubles = lumps<openvdb::DoubleGrid>(half);
            expect_read<openvdb::DoubleGrid>(doubles, read_volume(store(doubles, compression), "density"));
        }
    }
}

TEST_F(OpenVdb, NoDamageIsFatal) {
    for (const std::uint32_t compression : {0u, 3u, 6u}) {
        const std::string whole = read_file(store(lumps<openvdb::FloatGrid>(false), compression));
        Pcg32 random(compression);
        for (int i = 0; i < 30; ++i) {
            std::string broken = whole;
            // The masks of an upper node are most of the file: the beginning deserves its share.
            const std::size_t range = i % 2 ? broken.size() : 700;
            broken[random.next() % range] ^= static_cast<char>(1 + random.next() % 255);
            error_of(store(broken));
            error_of(store(whole.substr(0, random.next() % whole.size())));
        }
    }
}

TEST_F(OpenVdb, ValuesThatAreNoNumbersAreNamed) {
    const auto grid = lumps<openvdb::FloatGrid>(false);
    grid->tree().setValue({1, 2, 3}, std::numeric_limits<float>::quiet_NaN());
    EXPECT_REFUSED(store(grid), "grid `density`: voxel (1, 2, 3) holds nan");
    grid->tree().setValue({1, 2, 3}, std::numeric_limits<float>::infinity());
    EXPECT_REFUSED(store(grid), "voxel (1, 2, 3) holds inf");
}

TEST_F(OpenVdb, SmallNegativesCountAsZeroWithAWarning) {
    const auto grid = lumps<openvdb::FloatGrid>(false);
    EXPECT_EQ(read_volume(store(grid), "density").warning, "");
    grid->tree().setValue({1, 2, 3}, -0.01f);
    grid->tree().setValue({3, 2, 1}, -0.02f);
    const Volume volume = read_volume(store(grid), "density");
    EXPECT_EQ(volume.grid.interpolate({1, 2, 3}), 0.0f);
    EXPECT_NE(volume.warning.find("grid `density`: voxel (3, 2, 1) holds -0.02"), std::string::npos) << volume.warning;
    grid->tree().setValue({1, 2, 3}, -0.5f);
    EXPECT_REFUSED(store(grid), "voxel (1, 2, 3) holds -0.5");
}

}  // namespace
}  // namespace wend
