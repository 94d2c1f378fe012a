#include <tests/io/errors.h>
#include <tests/support/paths.h>
#include <wend/core/error.h>
#include <wend/core/random.h>
#include <wend/io/gzip.h>
#include <wend/io/volume_file.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#define NANOVDB_USE_ZIP
#define NANOVDB_USE_BLOSC
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

namespace wend {
namespace {

using test::message_of;

namespace fs = std::filesystem;

class VolumeFile : public testing::Test {
protected:
    VolumeFile() : folder(fs::temp_directory_path() / ("wend-volume-" + std::to_string(std::random_device()()))) {
        fs::create_directory(folder);
    }
    ~VolumeFile() override { fs::remove_all(folder); }

    fs::path store(const fs::path& name, const std::string& bytes) const {
        std::ofstream(folder / name, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return folder / name;
    }

    fs::path folder;
};

/// A smooth ball of radius 15 around (20, -10, 5).
float ball(int x, int y, int z) {
    return std::max(0.0f, 1 - std::hypot(x - 20.0f, y + 10.0f, z - 5.0f) / 15);
}

template <class Grid>
void fill(Grid&& set) {
    for (int z = -11; z <= 20; ++z) {
        for (int y = -26; y <= 5; ++y) {
            for (int x = 4; x <= 35; ++x) {
                if (const float v = ball(x, y, z); v > 0) {
                    set(x, y, z, v);
                }
            }
        }
    }
}

template <class BuildT>
nanovdb::GridHandle<> nano_ball(const std::string& name) {
    nanovdb::GridBuilder<float, BuildT> builder(0.0f, nanovdb::GridClass::FogVolume);
    auto accessor = builder.getAccessor();
    fill([&](int x, int y, int z, float v) { accessor.setValue(nanovdb::Coord(x, y, z), v); });
    return builder.getHandle(0.5, nanovdb::Vec3d(1, 2, 3), name);
}

openvdb::FloatGrid::Ptr open_ball(const std::string& name) {
    openvdb::initialize();
    const auto grid = openvdb::FloatGrid::create(0.0f);
    grid->setName(name);
    auto accessor = grid->getAccessor();
    fill([&](int x, int y, int z, float v) { accessor.setValue({x, y, z}, v); });
    return grid;
}

void expect_ball(const Volume& volume, float tolerance) {
    for (int z = -12; z <= 22; ++z) {
        for (int y = -27; y <= 7; ++y) {
            for (int x = 3; x <= 37; ++x) {
                ASSERT_NEAR(volume.grid.interpolate(Vec3(x, y, z)), ball(x, y, z), tolerance);
            }
        }
    }
    EXPECT_EQ(volume.grid.first(), Vec3i(6, -24, -9));
    EXPECT_EQ(volume.grid.size(), Vec3i(29, 29, 29));
}

TEST_F(VolumeFile, ReadsNanoVdbInEveryPrecisionAndCompression) {
    const fs::path file = folder / "a.nvdb";
    for (const auto codec : {nanovdb::io::Codec::NONE, nanovdb::io::Codec::ZIP, nanovdb::io::Codec::BLOSC}) {
        std::vector<nanovdb::GridHandle<>> handles;
        handles.push_back(nano_ball<float>("density"));
        handles.push_back(nano_ball<nanovdb::Fp8>("eight"));
        handles.push_back(nano_ball<nanovdb::Fp16>("sixteen"));
        handles.push_back(nano_ball<nanovdb::FpN>("some"));
        nanovdb::io::writeGrids(file.string(), handles, codec);
        expect_ball(read_volume(file, "density"), 0);
        expect_ball(read_volume(file, "eight"), 1.0f / 255);
        expect_ball(read_volume(file, "sixteen"), 1.0f / 65535);
        expect_ball(read_volume(file, "some"), 0.05f);
    }
    EXPECT_EQ(read_volume(file, "density").world_from_index.point({20, -10, 5}), Vec3(11, -3, 5.5f));
}

TEST_F(VolumeFile, LeavesOfSinglePrecisionStayWhereTheyAre) {
    const fs::path file = folder / "ball.nvdb";
    std::vector<nanovdb::GridHandle<>> handles;
    handles.push_back(nano_ball<float>("full"));
    handles.push_back(nano_ball<nanovdb::Fp16>("sixteen"));
    nanovdb::io::writeGrids(file.string(), handles, nanovdb::io::Codec::NONE);
    const Grid full = read_volume(file, "full").grid, sixteen = read_volume(file, "sixteen").grid;
    EXPECT_EQ(full.stored_voxels(), sixteen.stored_voxels());
    EXPECT_LT(full.bytes(), sizeof(float) * full.stored_voxels() / 10);
    EXPECT_GT(sixteen.bytes(), sizeof(float) * full.stored_voxels());
    for (int z = -12; z <= 21; ++z) {
        for (int y = -27; y <= 6; ++y) {
            for (int x = 3; x <= 36; ++x) {
                ASSERT_EQ(full.interpolate(Vec3(x, y, z)), ball(x, y, z));
            }
        }
    }
}

TEST_F(VolumeFile, ReadsOpenVdb) {
    const auto floats = open_ball("density"), halves = open_ball("half");
    floats->setTransform(openvdb::math::Transform::createLinearTransform(openvdb::Mat4d(
        0., 2., 0., 0., -2., 0., 0., 0., 0., 0., 0.5, 0., 7., 8., 9., 1.)));  // row vectors: rotates, scales, moves
    halves->setSaveFloatAsHalf(true);
    openvdb::io::File(folder.string() + "/a.vdb").write({floats, halves});
    const Volume volume = read_volume(folder / "a.vdb", "density");
    expect_ball(volume, 0);
    EXPECT_EQ(volume.name, "density");
    EXPECT_EQ(volume.world_from_index.point({1, 10, 2}), Vec3(-13, 10, 10));
    expect_ball(read_volume(folder / "a.vdb", "half"), 1e-3f);
}

TEST_F(VolumeFile, MissingGridListsThoseThatAreThere) {
    openvdb::io::File(folder.string() + "/a.vdb").write({open_ball("density"), open_ball("heat")});
    nanovdb::io::writeGrid((folder / "a.nvdb").string(), nano_ball<float>("density"));
    EXPECT_NE(message_of([&] { read_volume(folder / "a.vdb", "smoke"); }).find("no grid `smoke`, but: density, heat"),
              std::string::npos);
    EXPECT_NE(message_of([&] { read_volume(folder / "a.nvdb", "smoke"); }).find("no grid `smoke`, but: density"),
              std::string::npos);
    EXPECT_FALSE(try_read_volume(folder / "a.vdb", "smoke"));
    EXPECT_FALSE(try_read_volume(folder / "a.nvdb", "smoke"));
    EXPECT_TRUE(try_read_volume(folder / "a.nvdb", "density"));
}

TEST_F(VolumeFile, RefusesWhatIsNoDensity) {
    const auto negative = open_ball("density");
    negative->getAccessor().setValue({20, -10, 5}, -0.5f);
    const auto vectors = openvdb::Vec3SGrid::create();
    vectors->setName("velocity");
    const auto empty = openvdb::FloatGrid::create();
    empty->setName("empty");
    openvdb::io::File(folder.string() + "/a.vdb").write({negative, vectors, empty});
    EXPECT_NE(message_of([&] { read_volume(folder / "a.vdb", "density"); }).find("voxel (20, -10, 5) holds -0.5"),
              std::string::npos);
    EXPECT_NE(message_of([&] { read_volume(folder / "a.vdb", "velocity"); }).find("scalars"), std::string::npos);
    EXPECT_EQ(read_volume(folder / "a.vdb", "empty").grid.max_value(), 0);

    const auto huge = openvdb::FloatGrid::create();
    huge->setName("huge");
    huge->getAccessor().setValue({-900000, -900000, -900000}, 1);
    huge->getAccessor().setValue({900000, 900000, 900000}, 1);
    const auto outside = openvdb::FloatGrid::create();
    outside->setName("outside");
    outside->getAccessor().setValue({2000000000, 0, 0}, 1);
    openvdb::io::File(folder.string() + "/b.vdb").write({huge, outside});
    EXPECT_NE(message_of([&] { read_volume(folder / "b.vdb", "huge"); }).find("memory"), std::string::npos);
    EXPECT_NE(message_of([&] { read_volume(folder / "b.vdb", "outside"); }).find("coordinates"), std::string::npos);
}

TEST_F(VolumeFile, MissingAndForeignFilesAreNamed) {
    EXPECT_NE(message_of([&] { read_volume(folder / "none.nvdb", "density"); }).find("none.nvdb"), std::string::npos);
    EXPECT_NE(message_of([&] { read_volume(folder, "density"); }).find(folder.string()), std::string::npos);
    store("text.vdb", "a text");
    EXPECT_NE(message_of([&] { read_volume(folder / "text.vdb", "density"); }).find("neither"), std::string::npos);
}

TEST_F(VolumeFile, EveryTruncationIsAnError) {
    openvdb::io::File(folder.string() + "/a.vdb").write({open_ball("density")});
    nanovdb::io::writeGrid((folder / "a.nvdb").string(), nano_ball<float>("density"));
    for (const char* name : {"a.vdb", "a.nvdb"}) {
        const std::string whole = read_file(folder / name);
        for (std::size_t size = 0; size < whole.size(); size += 1 + size / 10) {
            const fs::path part = store("part", whole.substr(0, size));
            ASSERT_NE(message_of([&] { read_volume(part, "density"); }), "no error") << name << " " << size;
        }
    }
}

TEST_F(VolumeFile, DamagedNanoVdbIsNoCrash) {
    for (const auto codec : {nanovdb::io::Codec::NONE, nanovdb::io::Codec::BLOSC}) {
        const fs::path file = folder / "a.nvdb";
        nanovdb::io::writeGrid(file.string(), nano_ball<nanovdb::FpN>("density"), codec);
        const std::string whole = read_file(file);
        Pcg32 rng(1);
        for (int i = 0; i < 150; ++i) {
            std::string broken = whole;
            for (int k = 0; k < 8; ++k) {
                // Most of the file is one node's table of children: the beginning deserves its share.
                const std::size_t range = k % 2 ? broken.size() : std::min<std::size_t>(broken.size(), 1200);
                broken[rng.next() % range] ^= static_cast<char>(1 + rng.next() % 255);
            }
            store("a.nvdb", broken);
            message_of([&] { try_read_volume(file, "density"); });
        }
    }
}

TEST_F(VolumeFile, ChildrenOutsideTheFileAreFound) {
    // Without a checksum the tree itself must be checked: every offset to a child is sent astray in turn.
    auto handle = nano_ball<float>("density");
    auto* grid = handle.grid<float>();
    const_cast<nanovdb::GridData*>(reinterpret_cast<const nanovdb::GridData*>(grid))->mChecksum = ~std::uint64_t{0};
    const fs::path file = folder / "a.nvdb";
    const auto& root = grid->tree().root();
    const auto upper_child = root.data()->tile(0)->child;
    for (const std::int64_t wrong : {std::int64_t{32} << 40, -(std::int64_t{32} << 40), upper_child + 8,
                                     upper_child - 32, std::numeric_limits<std::int64_t>::max() - 31}) {
        const_cast<std::int64_t&>(root.data()->tile(0)->child) = wrong;
        nanovdb::io::writeGrid(file.string(), handle);
        EXPECT_NE(message_of([&] { read_volume(file, "density"); }).find("is damaged"), std::string::npos) << wrong;
    }
    const_cast<std::int64_t&>(root.data()->tile(0)->child) = upper_child;
    nanovdb::io::writeGrid(file.string(), handle);
    expect_ball(read_volume(file, "density"), 0);
}

TEST_F(VolumeFile, BothFormatsOfARealCloudAgree) {
    for (const char* stem : {"cloud/wdas_cloud_sixteenth", "smoke/smoke"}) {
        const fs::path base = test::shared_dir() / "scenes" / stem;
        if (!fs::exists(base.string() + ".nvdb")) {
            GTEST_SKIP() << "the collection of real scenes is absent";
        }
        const Volume nano = read_volume(base.string() + ".nvdb", "density");
        const Volume open = read_volume(base.string() + ".vdb", "density");
        EXPECT_EQ(nano.grid.first(), open.grid.first());
        EXPECT_EQ(nano.grid.size(), open.grid.size());
        EXPECT_GT(nano.grid.max_value(), 0);
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 4; ++column) {
                EXPECT_NEAR(nano.world_from_index.element(row, column), open.world_from_index.element(row, column),
                            1e-6);
            }
        }
        Pcg32 rng(3);
        const Box3 bounds = nano.grid.bounds();
        const Vec3 extent = bounds.size();
        double largest = 0;
        for (int i = 0; i < 20000; ++i) {
            const Vec3 p =
                bounds.min + Vec3(rng.uniform() * extent.x, rng.uniform() * extent.y, rng.uniform() * extent.z);
            const float v = nano.grid.interpolate(p);
            ASSERT_NEAR(v, open.grid.interpolate(p), 1e-3f * nano.grid.max_value()) << stem << p;
            largest = std::max<double>(largest, v);
        }
        EXPECT_GT(largest, 0.1 * nano.grid.max_value());
        EXPECT_FALSE(try_read_volume(base.string() + ".nvdb", "temperature"));
    }
}

}  // namespace
}  // namespace wend
