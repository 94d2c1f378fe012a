#include <tests/io/errors.h>
#include <tests/support/paths.h>
#include <wend/core/error.h>
#include <wend/io/ply.h>

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <string>

namespace wend {
namespace {

namespace fs = std::filesystem;

class Ply : public testing::Test {
protected:
    Ply() : folder(fs::temp_directory_path() / ("wend-ply-" + std::to_string(std::random_device()()))) {
        fs::create_directory(folder);
    }
    ~Ply() override { fs::remove_all(folder); }

    TriangleMeshData read(const std::string& bytes) const {
        std::ofstream(folder / "m.ply", std::ios::binary) << bytes;
        return read_ply(folder / "m.ply");
    }
    std::string error_of(const std::string& bytes) const {
        return test::message_of([&] { read(bytes); });
    }
    void expect_error(const std::string& bytes, const std::string& part) const {
        const std::string message = error_of(bytes);
        EXPECT_NE(message.find(part), std::string::npos) << message;
        EXPECT_NE(message.find("m.ply"), std::string::npos) << message;
    }

    fs::path folder;
};

using Indices = std::vector<std::uint32_t>;

const std::string header_end = "end_header\n";
const std::string three_vertices =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\n";
const std::string ascii_triangle =
    "ply\nformat ascii 1.0\n" + three_vertices + header_end + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/// Appends a number in the given byte order.
template <class T>
void put(std::string& bytes, T value, bool big_endian) {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), &value, sizeof(T));
    if (big_endian != (std::endian::native == std::endian::big)) {
        std::reverse(raw.begin(), raw.end());
    }
    bytes.append(raw.data(), raw.size());
}

std::string binary_mesh(bool big_endian) {
    std::string bytes =
        std::string("ply\r\nformat binary_") + (big_endian ? "big" : "little") +
        "_endian 1.0\r\ncomment all types\r\nobj_info x\r\n"
        "element vertex 4\r\nproperty float64 x\r\nproperty float y\r\nproperty short z\r\n"
        "property list ushort char junk\r\nproperty float32 nx\r\nproperty float ny\r\nproperty float nz\r\n"
        "property uint8 red\r\nproperty uint texture_u\r\nproperty int8 texture_v\r\n"
        "element other 2\r\nproperty int32 n\r\nproperty list uint8 double d\r\n"
        "element face 2\r\nproperty ushort material\r\nproperty list uint uint16 vertex_index\r\n"
        "end_header\r\n";
    for (int i = 0; i < 4; ++i) {
        put<double>(bytes, 0.5 * i, big_endian);
        put<float>(bytes, -0.25f * i, big_endian);
        put<std::int16_t>(bytes, static_cast<std::int16_t>(-300 * i), big_endian);
        put<std::uint16_t>(bytes, static_cast<std::uint16_t>(i), big_endian);
        bytes.append(static_cast<std::size_t>(i), 'j');
        put<float>(bytes, 0, big_endian);
        put<float>(bytes, 0, big_endian);
        put<float>(bytes, 1, big_endian);
        put<std::uint8_t>(bytes, 200, big_endian);
        put<std::uint32_t>(bytes, 70000u * static_cast<unsigned>(i), big_endian);
        put<std::int8_t>(bytes, static_cast<std::int8_t>(-i), big_endian);
    }
    for (int i = 0; i < 2; ++i) {
        put<std::int32_t>(bytes, i, big_endian);
        put<std::uint8_t>(bytes, 1, big_endian);
        put<double>(bytes, 1.5, big_endian);
    }
    put<std::uint16_t>(bytes, 7, big_endian);
    put<std::uint32_t>(bytes, 4, big_endian);
    for (const std::uint16_t index : {0, 1, 2, 3}) {
        put(bytes, index, big_endian);
    }
    put<std::uint16_t>(bytes, 7, big_endian);
    put<std::uint32_t>(bytes, 3, big_endian);
    for (const std::uint16_t index : {3, 2, 1}) {
        put(bytes, index, big_endian);
    }
    return bytes;
}

void expect_binary_mesh(const TriangleMeshData& mesh) {
    ASSERT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.positions[3], Vec3(1.5f, -0.75f, -900));
    EXPECT_EQ(mesh.normals[1], Vec3(0, 0, 1));
    EXPECT_EQ(mesh.uvs[2], Vec2(140000, -2));
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2, 0, 2, 3, 3, 2, 1}));
}

TEST_F(Ply, ReadsAscii) {
    const TriangleMeshData mesh = read(ascii_triangle);
    EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2}));
    EXPECT_TRUE(mesh.normals.empty());
    EXPECT_TRUE(mesh.uvs.empty());
}

TEST_F(Ply, SplitsPolygonsIntoFans) {
    const TriangleMeshData mesh = read(
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nproperty float "
        "s\n"
        "property float t\nelement face 2\nproperty list uchar int vertex_indices\nproperty int "
        "face_indices\nend_header\n"
        "0 0 0 0 0  1 0 0 1 0  1 1 0 1 1  0 1 0 0 1  -1e0 +.5 0 0.5 1e-400\n5 0 1 2 3 4 17\n2 0 1 18\n");
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2, 0, 2, 3, 0, 3, 4}));
    EXPECT_EQ(mesh.positions[4], Vec3(-1, 0.5f, 0));
    EXPECT_EQ(mesh.uvs[2], Vec2(1, 1));
}

TEST_F(Ply, ReadsBothByteOrdersAndAllTypes) {
    expect_binary_mesh(read(binary_mesh(false)));
    expect_binary_mesh(read(binary_mesh(true)));
}

TEST_F(Ply, ReadsGzip) {
    const std::string bytes = binary_mesh(false);
    const fs::path file = folder / "m.ply.gz";
    gzFile out = gzopen(file.c_str(), "wb");
    gzwrite(out, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(out);
    expect_binary_mesh(read_ply(file));
    fs::resize_file(file, fs::file_size(file) / 2);
    EXPECT_THROW(read_ply(file), InputError);
}

TEST_F(Ply, EveryTruncationIsAnError) {
    const std::string binary = binary_mesh(true);
    for (std::size_t size = 0; size < binary.size(); ++size) {
        ASSERT_NE(error_of(binary.substr(0, size)), "no error") << size;
    }
    for (std::size_t size = 0; size + 2 < ascii_triangle.size(); ++size) {
        ASSERT_NE(error_of(ascii_triangle.substr(0, size)), "no error") << size;
    }
}

TEST_F(Ply, ErrorsNameThePlace) {
    const std::string ascii = "ply\nformat ascii 1.0\n" + three_vertices + header_end;
    expect_error("plx\n", ":1:1: error: not a PLY file");
    expect_error("ply\nformat middle_endian 1.0\n", ":2:1: error: unknown format `middle_endian`");
    expect_error("ply\nformat ascii 1.0\nelement vertex many\n", ":3:1: error: `many`");
    expect_error("ply\nformat ascii 1.0\nproperty float x\n", ":3:1: error: malformed");
    expect_error("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n", ":4:1: error: unknown type `real`");
    expect_error("ply\nelement vertex 1\nproperty float x\nend_header\n", "no format");
    expect_error("ply\nformat ascii 1.0\nelement vertex 0\nend_header\n", "`face`");
    expect_error("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nelement face 0\nend_header\n1\n",
                 "x, y and z");
    expect_error(ascii + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", ":13:1: error: face 0 refers to vertex 3");
    expect_error(ascii + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "face 0 refers to vertex -1");
    expect_error(ascii + "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n", "face 0 refers to vertex 1.5");
    expect_error(ascii + "0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n", ":11:1: error: `zero` is not a number");
    expect_error(ascii + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", ":11:1: error: vertex 1 is not finite");
    expect_error(ascii + "0 0 0\n1 0 0\n0 1 -inf\n3 0 1 2\n", "vertex 2 is not finite");
    expect_error(ascii + "0 0 0\n1 0 0\n0 1 1e300\n3 0 1 2\n", "vertex 2 is not finite");
    expect_error(ascii + "0 0 0\n1 0 0\n0 1 1e400\n3 0 1 2\n", "vertex 2 is not finite");
    expect_error(ascii + "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n", "a list cannot have -3 entries");
}

TEST_F(Ply, AbsurdCountsAreRefusedBeforeTheyAreAllocated) {
    const std::string vertex = "property float x\nproperty float y\nproperty float z\n";
    const std::string face = "property list uchar int vertex_indices\n";
    for (const std::string format : {"ascii", "binary_little_endian"}) {
        const std::string start = "ply\nformat " + format + " 1.0\n";
        expect_error(
            start + "element vertex 1000000000000\n" + vertex + "element face 0\n" + face + header_end + "0 0 0\n",
            "too short for 1000000000000");
        expect_error(
            start + "element vertex 0\n" + vertex + "element face 18446744073709551615\n" + face + header_end + "0",
            "too short");
        EXPECT_TRUE(
            read(start + "element vertex 0\n" + vertex + "element face 6666666660\n" + header_end).indices.empty())
            << "faces without properties";
        expect_error(start + "element nothing 18446744073709551615\nelement vertex 1\n" + vertex + "element face 0\n" +
                         face + header_end,
                     "too short for 1 ");
    }
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex 0\n" + vertex +
                        "element face 1\nproperty list uint int vertex_indices\n" + header_end;
    put<std::uint32_t>(bytes, 0xffffffffu, false);
    expect_error(bytes, "list of 4294967295");
}

TEST_F(Ply, ReadsWhatVerticesAndFacesHaveBesideTheirShape) {
    std::ofstream(folder / "m.ply", std::ios::binary)
        << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float blue\nproperty float y\n"
           "property float z\nproperty float green\nproperty float red\nproperty float heat_0\n"
           "property float flow_x\nproperty float flow_y\nproperty float flow_z\nproperty float pair_0\n"
           "property float pair_1\nproperty float plain\n"
           "element face 1\nproperty uchar dye_r\nproperty uchar dye_g\nproperty uchar dye_b\n"
           "property list uchar int vertex_indices\nproperty float age_1\nend_header\n"
           "0 .3 0 0 .2 .1 5 1 2 3 0 0 0\n1 .6 0 0 .5 .4 6 4 5 6 0 0 0\n"
           "1 0 1 0 0 0 7 0 0 0 0 0 0\n0 0 1 0 0 0 8 0 0 0 0 0 0\n"
           "255 51 0 4 0 1 2 3 9\n";
    EXPECT_TRUE(read_ply(folder / "m.ply").attributes.empty());
    const TriangleMeshData mesh = read_ply(folder / "m.ply", true);
    const auto values = [&](const std::string& name) {
        const auto found = std::find_if(mesh.attributes.begin(), mesh.attributes.end(),
                                        [&](const MeshAttribute& attribute) { return attribute.name == name; });
        return found == mesh.attributes.end() ? std::vector<float>() : found->values;
    };
    EXPECT_EQ(mesh.attributes.size(), 5u) << "two numbers are no attribute, nor is what ends on no letter";
    EXPECT_EQ(values("vertex_color"), (std::vector<float>{.1f, .2f, .3f, .4f, .5f, .6f, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(values("vertex_heat"), (std::vector<float>{5, 6, 7, 8}));
    EXPECT_EQ(values("vertex_flow"), (std::vector<float>{1, 2, 3, 4, 5, 6, 0, 0, 0, 0, 0, 0}));
    // Of both triangles of the square; colours of bytes are parts of 255.
    EXPECT_EQ(values("face_age"), (std::vector<float>{9, 9}));
    ASSERT_EQ(values("face_dye_color").size(), 6u);
    EXPECT_FLOAT_EQ(values("face_dye_color")[4], 0.2f);
    EXPECT_FLOAT_EQ(values("face_dye_color")[3], 1);
}

TEST_F(Ply, ReadsTheMeshesOfARealScene) {
    const fs::path models = test::shared_dir() / "scenes/veach-ajar/models";
    if (!fs::exists(models)) {
        GTEST_SKIP() << "the collection of real scenes is absent";
    }
    std::size_t triangles = 0;
    for (const auto& entry : fs::directory_iterator(models)) {
        const TriangleMeshData mesh = read_ply(entry.path());
        EXPECT_GT(mesh.indices.size(), 0u) << entry.path();
        EXPECT_TRUE(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
        triangles += mesh.indices.size() / 3;
    }
    EXPECT_GT(triangles, 1000u);
}

}  // namespace
}  // namespace wend
