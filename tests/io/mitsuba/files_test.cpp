// Mitsuba's meshes and volumes, whole and broken.
#include "mitsuba_support.h"

#include <wend/io/mitsuba/obj_file.h>
#include <wend/io/mitsuba/serialized_file.h>
#include <wend/io/mitsuba/vol_file.h>

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace wend::mitsuba {
namespace {

template <class... Numbers>
std::string bytes_of(const Numbers&... numbers) {
    std::string bytes;
    (bytes.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
    return bytes;
}

class ObjFile : public testing::Test {
protected:
    TriangleMeshData read(const std::string& text) const {
        files_.write("m.obj", text);
        return read_obj(files_.path("m.obj"));
    }
    std::string error_of(const std::string& text) const {
        return message_of([&] { read(text); });
    }
    MitsubaFiles files_;
};

TEST_F(ObjFile, CornersThatAreAlikeAreOneVertex) {
    const auto mesh = read(
        "# a square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\n"
        "g part\nusemtl red\nf 1/1/1 2/1/1 3/1/1 4/1/1\nf -4/2/-1 -2/1/1 -1//1\n");
    EXPECT_EQ(mesh.positions.size(), 6u);
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 4, 2, 5}));
    ASSERT_EQ(mesh.uvs.size(), 6u);
    EXPECT_EQ(mesh.uvs[4], Vec2(1, 1));
    EXPECT_EQ(mesh.uvs[5], Vec2(0, 0));
    EXPECT_EQ(mesh.normals[5], Vec3(0, 0, 1));
}

TEST_F(ObjFile, WhatIsWrongIsNamedWithItsLine) {
    EXPECT_PRED2(contains, error_of("v 0 0\n"), "m.obj:1: error: \"\" is no number");
    EXPECT_PRED2(contains, error_of("v 0 0 0\n\nv 1 x 0\n"), "m.obj:3: error: \"x\" is no number");
    EXPECT_PRED2(contains, error_of("v 0 nan 0\n"), "not finite");
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_PRED2(contains, error_of(vertices + "f 1 2 4\n"), "m.obj:4: error: the index 4 is out of range");
    EXPECT_PRED2(contains, error_of(vertices + "f 1 2 0\n"), "out of range");
    EXPECT_PRED2(contains, error_of(vertices + "f 1 2 -4\n"), "out of range");
    EXPECT_PRED2(contains, error_of(vertices + "f 1 2 99999999999999999999\n"), "out of range");
    EXPECT_PRED2(contains, error_of(vertices + "f 1/1 2 3\n"), "out of range");
    EXPECT_PRED2(contains, error_of(vertices + "f 1 2\n"), "three corners or more");
    EXPECT_PRED2(contains, error_of(vertices + "f 1/// 2 3\n"), "is no corner");
    EXPECT_TRUE(read("").indices.empty());
}

class VolFile : public testing::Test {
protected:
    VoxelData read(const std::string& bytes) const {
        files_.write("v.vol", bytes);
        return read_vol(files_.path("v.vol"));
    }
    std::string error_of(const std::string& bytes) const {
        return message_of([&] { read(bytes); });
    }
    static std::string head(std::int32_t type, std::int32_t x, std::int32_t y, std::int32_t z, std::int32_t channels) {
        return "VOL\3" + bytes_of(type, x, y, z, channels, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f, 1.0f);
    }
    MitsubaFiles files_;
};

TEST_F(VolFile, IsLinearBetweenTheMiddlesOfVoxels) {
    const VoxelData data = read(head(1, 2, 1, 1, 1) + bytes_of(1.0f, 3.0f));
    EXPECT_EQ(data.size, Vec3i(2, 1, 1));
    EXPECT_FLOAT_EQ(data.at(Vec3(0, 0.5f, 0.5f), 0), 1);
    EXPECT_FLOAT_EQ(data.at(Vec3(0.25f, 0, 1), 0), 1);
    EXPECT_FLOAT_EQ(data.at(Vec3(0.5f, 0.5f, 0.5f), 0), 2);
    EXPECT_FLOAT_EQ(data.at(Vec3(0.9f, 0.5f, 0.5f), 0), 3);
}

TEST_F(VolFile, TakesNoMemoryThatTheFileHasNot) {
    EXPECT_PRED2(contains, error_of("VO"), "no volume file");
    EXPECT_PRED2(contains, error_of(std::string("VOL\2").append(100, '\0')), "no volume file of version 3");
    EXPECT_PRED2(contains, error_of(head(2, 1, 1, 1, 1)), "not of type 2");
    EXPECT_PRED2(contains, error_of(head(1, 1 << 20, 1 << 20, 1 << 20, 3)), "truncated");
    EXPECT_PRED2(contains, error_of(head(1, -1, 1, 1, 1)), "out of range");
    EXPECT_PRED2(contains, error_of(head(1, 1, 1, 1, 7)), "1 or 3 channels");
    EXPECT_PRED2(contains, error_of(head(1, 2, 1, 1, 1) + bytes_of(1.0f)), "truncated");
    EXPECT_PRED2(contains, error_of(head(1, 1, 1, 1, 1) + bytes_of(std::uint32_t{0x7fc00000})), "no finite number");
    EXPECT_PRED2(contains, error_of(head(1, 1, 1, 1, 1).substr(0, 30)), "truncated");
}

class SerializedFile : public testing::Test {
protected:
    static std::string packed(const std::string& body) {
        std::string result(compressBound(static_cast<uLong>(body.size())), '\0');
        uLongf size = static_cast<uLongf>(result.size());
        compress(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(body.data()),
                 static_cast<uLong>(body.size()));
        return result.substr(0, size);
    }
    /// A file of version 3 with one mesh.
    SerializedMesh read(const std::string& body, int index = 0) const {
        return read_bytes(bytes_of(std::uint16_t{0x041c}, std::uint16_t{3}) + packed(body) +
                              bytes_of(std::uint32_t{0}, std::uint32_t{1}),
                          index);
    }
    SerializedMesh read_bytes(const std::string& bytes, int index = 0) const {
        files_.write("m.serialized", bytes);
        return read_serialized(files_.path("m.serialized"), index);
    }
    static std::string triangle(std::uint32_t flags, std::uint64_t vertices, std::uint64_t triangles,
                                std::uint32_t last_index) {
        return bytes_of(flags, vertices, triangles) + bytes_of(0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f) +
               bytes_of(std::uint32_t{0}, std::uint32_t{1}, last_index);
    }
    MitsubaFiles files_;
};

TEST_F(SerializedFile, OfVersion3) {
    const SerializedMesh read_back = read(triangle(0x1010, 3, 1, 2));
    EXPECT_TRUE(read_back.has_face_normals);
    EXPECT_EQ(read_back.mesh.positions[1], Vec3(1, 0, 0));
    EXPECT_EQ(read_back.mesh.indices, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST_F(SerializedFile, WhatIsWrongIsSaid) {
    const auto error = [&](const std::string& body, int index = 0) { return message_of([&] { read(body, index); }); };
    EXPECT_PRED2(contains, error(triangle(0x1000, 3, 1, 3)), "the index 3 is out of range");
    EXPECT_PRED2(contains, error(triangle(0x1000, 3, 2, 2)), "truncated");
    EXPECT_PRED2(contains, error(triangle(0x1000, std::uint64_t{1} << 31, 1, 2)), "truncated");
    EXPECT_PRED2(contains, error(triangle(0x1000, std::uint64_t{1} << 60, 1, 2)), "broken");
    EXPECT_PRED2(contains, error(triangle(0x1000, 3, ~std::uint64_t{0}, 2)), "truncated");
    EXPECT_PRED2(contains, error(triangle(0, 3, 1, 2)), "broken");
    EXPECT_PRED2(contains, error(triangle(0x1000, 3, 1, 2), 1), "there is no mesh 1: the file has 1");
    const auto error_of_bytes = [&](const std::string& bytes) { return message_of([&] { read_bytes(bytes); }); };
    EXPECT_PRED2(contains, error_of_bytes(""), "truncated");
    EXPECT_PRED2(contains, error_of_bytes("serialized"), "no file of serialized meshes");
    EXPECT_PRED2(contains, error_of_bytes(bytes_of(std::uint16_t{0x041c}, std::uint16_t{9}, std::uint32_t{1})),
                 "not 9");
    EXPECT_PRED2(contains, error_of_bytes(bytes_of(std::uint16_t{0x041c}, std::uint16_t{4}, ~std::uint32_t{0})),
                 "broken or truncated");
    EXPECT_PRED2(contains,
                 error_of_bytes(bytes_of(std::uint16_t{0x041c}, std::uint16_t{3}) + "no zlib at all" +
                                bytes_of(std::uint32_t{0}, std::uint32_t{1})),
                 "broken or truncated");
}

}  // namespace
}  // namespace wend::mitsuba
