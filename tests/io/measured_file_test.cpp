#include "tests/io/errors.h"
#include "tests/io/load_support.h"
#include "tests/support/measured_tables.h"

#include <wend/core/error.h>
#include <wend/io/gzip.h>
#include <wend/io/load/measured.h>
#include <wend/io/tensor_file.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace wend {
namespace {

using test::message_of;

using Tensors = std::map<std::string, Tensor>;

template <class T>
void append(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// As their authors write them, beside arrays of another type.
void write_tensors(const std::filesystem::path& file, const Tensors& tensors) {
    std::string head("tensor_file\0\1\0", 14), data;
    append(head, static_cast<std::uint32_t>(tensors.size() + 1));
    std::size_t head_size = head.size() + 2 + 11 + 2 + 1 + 8 + 8;
    for (const auto& [name, tensor] : tensors) {
        head_size += 2 + name.size() + 2 + 1 + 8 + 8 * tensor.shape.size();
    }
    const auto add = [&](const std::string& name, std::uint8_t type, const std::vector<std::size_t>& shape,
                         const void* values, std::size_t size) {
        append(head, static_cast<std::uint16_t>(name.size()));
        head += name;
        append(head, static_cast<std::uint16_t>(shape.size()));
        append(head, type);
        append(head, static_cast<std::uint64_t>(head_size + data.size()));
        for (const std::size_t n : shape) {
            append(head, static_cast<std::uint64_t>(n));
        }
        data.append(static_cast<const char*>(values), size);
    };
    add("description", 1, {4}, "test", 4);
    for (const auto& [name, tensor] : tensors) {
        add(name, 10, tensor.shape, tensor.values.data(), tensor.values.size() * sizeof(float));
    }
    std::ofstream(file, std::ios::binary) << head << data;
}

/// Whose spectra are grey, as what the data have in green.
Tensors tensors_of(const MeasuredData& data) {
    const std::size_t a = data.azimuths.size(), t = data.angles.size(), n = data.colours.width;
    const std::vector<float> wavelengths = {400, 550, 700};
    Tensors tensors = {{"phi_i", {{a}, data.azimuths}},
                       {"theta_i", {{t}, data.angles}},
                       {"wavelengths", {{3}, wavelengths}},
                       {"ndf", {{data.facets.height, data.facets.width}, data.facets.values}},
                       {"sigma", {{data.projected.height, data.projected.width}, data.projected.values}},
                       {"vndf", {{a, t, data.visible.height, data.visible.width}, data.visible.values}},
                       {"luminance", {{a, t, n, n}, data.luminance.values}}};
    Tensor& spectra = tensors["spectra"];
    spectra.shape = {a, t, wavelengths.size(), n, n};
    for (std::size_t slice = 0; slice < a * t; ++slice) {
        for (std::size_t w = 0; w < wavelengths.size(); ++w) {
            for (std::size_t i = 0; i < n * n; ++i) {
                spectra.values.push_back(data.colours.values[slice * n * n + i].g);
            }
        }
    }
    return tensors;
}

bool holds(const std::string& message, const std::string& text) {
    return message.find("wend_measured.bsdf: error: " + text) != std::string::npos;
}

class MeasuredFile : public ::testing::Test {
protected:
    MeasuredFile() : file_(std::filesystem::temp_directory_path() / "wend_measured.bsdf") {}
    ~MeasuredFile() override { std::filesystem::remove(file_); }

    std::string error_of(const std::string& name, const std::function<void(Tensor&)>& spoil) {
        Tensors tensors = tensors_of(test::uneven_reflectance(false));
        spoil(tensors[name]);
        write_tensors(file_, tensors);
        return message_of([&] { read_measured(file_); });
    }

    std::filesystem::path file_;
};

TEST_F(MeasuredFile, HoldsWhatWasWritten) {
    const MeasuredTables written(test::uneven_reflectance(false));
    write_tensors(file_, tensors_of(test::uneven_reflectance(false)));
    const auto read = read_measured(file_);
    const Vec3 wo = normalize(Vec3(0.3f, -0.2f, 0.8f)), wi = normalize(Vec3(-0.5f, 0.6f, 0.7f));
    const float value = written.value(wo, wi).g;
    EXPECT_GT(value, 0.01f);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(read->value(wo, wi)[c], value, 1e-4f * value);
    }
    EXPECT_FLOAT_EQ(read->density(wo, wi), written.density(wo, wi));
}

TEST_F(MeasuredFile, MayHoldColoursInPlaceOfSpectra) {
    const MeasuredData data = test::uneven_reflectance(false);
    const MeasuredTables written(data);
    Tensors tensors = tensors_of(data);
    const std::size_t size = data.colours.width * data.colours.height;
    Tensor rgb{{data.azimuths.size(), data.angles.size(), 3, data.colours.height, data.colours.width}, {}};
    for (std::size_t slice = 0; slice < data.azimuths.size() * data.angles.size(); ++slice) {
        for (int c = 0; c < 3; ++c) {
            for (std::size_t i = 0; i < size; ++i) {
                rgb.values.push_back(data.colours.values[slice * size + i][c]);
            }
        }
    }
    tensors.erase("spectra");
    tensors.erase("wavelengths");
    tensors["rgb"] = rgb;
    write_tensors(file_, tensors);
    const auto read = read_measured(file_);
    const Vec3 wo = normalize(Vec3(0.3f, -0.2f, 0.8f)), wi = normalize(Vec3(-0.5f, 0.6f, 0.7f));
    EXPECT_EQ(read->value(wo, wi), written.value(wo, wi));
    EXPECT_GT(read->value(wo, wi).b, read->value(wo, wi).r);
    tensors["rgb"].shape[2] = 2;
    tensors["rgb"].values.resize(2 * rgb.values.size() / 3);
    write_tensors(file_, tensors);
    EXPECT_PRED2(holds, message_of([&] { read_measured(file_); }), "the array \"rgb\" has the sizes [4, 5, 2");
}

TEST_F(MeasuredFile, IsAMaterial) {
    write_tensors(file_, tensors_of(test::even_reflectance(Rgb(0.5f), true)));
    const LoadedScene loaded = test::load_text(
        "Material \"measured\" \"string filename\" \"wend_measured.bsdf\" Shape \"sphere\" Shape \"disk\"");
    EXPECT_TRUE(loaded.warnings.empty());
    const auto& material =
        std::get<MeasuredMaterial>(loaded.scene.materials[static_cast<std::size_t>(loaded.scene.surfaces[0].material)]);
    const Vec3 wi = normalize(Vec3(0.2f, 0.3f, 0.9f));
    EXPECT_NEAR(material.tables->value({0, 0, 1}, wi).r, 0.5f * wi.z / pi, 0.004f);
}

TEST_F(MeasuredFile, FaultsAreNamed) {
    EXPECT_PRED2(holds, error_of("ndf", [](Tensor& t) { t.values[1] = NAN; }), "the array \"ndf\" has a value");
    EXPECT_PRED2(holds, error_of("phi_i", [](Tensor& t) { std::swap(t.values[0], t.values[1]); }), "the values of");
    EXPECT_PRED2(holds,
                 error_of("phi_i",
                          [](Tensor& t) {
                              for (float& value : t.values) {
                                  value /= 4;
                              }
                          }),
                 "only measured reflections with azimuths of a whole turn");
    EXPECT_PRED2(holds, error_of("vndf", [](Tensor& t) { std::swap(t.shape[0], t.shape[2]); }), "the array \"vndf\"");
    EXPECT_PRED2(holds, error_of("spectra", [](Tensor& t) { t.shape.pop_back(); }), "the array \"spectra\" has 4");
    EXPECT_PRED2(holds, error_of("luminance", [](Tensor& t) { t.shape[3] = std::size_t{1} << 62; }),
                 "the array \"luminance\" is too large");
    EXPECT_PRED2(holds, error_of("luminance", [](Tensor& t) { t.shape[3] = std::size_t{1} << 40; }),
                 "the file is truncated");
    Tensors tensors = tensors_of(test::uneven_reflectance(true));
    tensors.erase("sigma");
    write_tensors(file_, tensors);
    EXPECT_PRED2(holds, message_of([&] { read_measured(file_); }), "the measured reflection has no array \"sigma\"");
    std::ofstream(file_) << "tensor";
    EXPECT_PRED2(holds, message_of([&] { read_measured(file_); }), "this is no tensor file");
}

TEST_F(MeasuredFile, ArraysThatShareTheirBytesAreRefused) {
    constexpr std::size_t count = 512;
    const Tensor tensor{{count}, std::vector<float>(count)};
    write_tensors(file_, {{"zz0", tensor}, {"zz1", tensor}, {"zz2", tensor}});
    std::string bytes = read_file(file_);
    // Behind a name there are the number of dimensions and the type.
    const auto offset_of = [&](const char* name) { return bytes.data() + bytes.find(name) + 3 + 2 + 1; };
    for (const char* name : {"zz1", "zz2"}) {
        std::memcpy(offset_of(name), offset_of("zz0"), sizeof(std::uint64_t));
    }
    bytes.resize(bytes.size() - 2 * count * sizeof(float));
    std::ofstream(file_, std::ios::binary) << bytes;
    EXPECT_NE(message_of([&] { read_tensors(file_); }).find("the array \"zz1\" lies where others do"),
              std::string::npos);
}

}  // namespace
}  // namespace wend
