// How OpenEXR files call their layers, what they keep as half floats, and what they have as numbers.
#include <tests/io/errors.h>
#include <tests/support/scratch_folder.h>
#include <wend/core/error.h>
#include <wend/io/gzip.h>
#include <wend/io/image_file.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace wend {
namespace {

constexpr int picture_width = 5, picture_height = 3;
constexpr std::size_t picture_pixels = std::size_t{picture_width} * picture_height;

/// Values that no float of fewer bits holds.
std::vector<float> values(std::size_t channels, float scale) {
    std::vector<float> list(picture_pixels * channels);
    for (std::size_t i = 0; i < list.size(); ++i) {
        list[i] = scale * (1 + static_cast<float>(i) / 7);
    }
    return list;
}

/// What a render leaves.
Picture picture() {
    Picture p;
    p.image = Image(picture_width, picture_height);
    p.full_size = {picture_width, picture_height};
    const std::vector<float> colours = values(3, 0.3f);
    for (std::size_t i = 0; i < picture_pixels; ++i) {
        p.image.pixels[i] = {colours[3 * i], colours[3 * i + 1], colours[3 * i + 2]};
    }
    p.layers = {{"albedo", {"R", "G", "B"}, values(3, 0.01f)},
                {"normal", {"X", "Y", "Z"}, values(3, -0.1f)},
                {"depth", {"Z"}, values(1, 123.4f)},
                {"alpha", {"A"}, values(1, 0.1f)},
                {"samples", {"N"}, std::vector<float>(picture_pixels, 64)},
                {"variance", {"R", "G", "B"}, values(3, 1e-5f)},
                {"scatter", {"P"}, values(1, 0.2f)}};
    p.metadata = {{"wend:version", "test"}, {"wend:spp", "64"}, {"wend:seed", "7"}};
    return p;
}

const Layer& layer(const Picture& p, const std::string& name) {
    const auto found = std::find_if(p.layers.begin(), p.layers.end(), [&](const Layer& l) { return l.name == name; });
    if (found == p.layers.end()) {
        throw std::runtime_error("no layer " + name);
    }
    return *found;
}

class ExrFormat : public testing::Test {
protected:
    std::string write(const Picture& p, const PictureFormat& format) const {
        write_picture(folder_.file("p.exr"), p, format);
        return folder_.file("p.exr");
    }
    /// The channels of a file, and what they are in.
    static std::map<std::string, Imf::PixelType> channels(const std::string& file) {
        const Imf::InputFile input(file.c_str());
        std::map<std::string, Imf::PixelType> found;
        for (auto c = input.header().channels().begin(); c != input.header().channels().end(); ++c) {
            found[c.name()] = c.channel().type;
        }
        return found;
    }

    test::ScratchFolder folder_;
};

TEST_F(ExrFormat, WhatIsWrittenUnderOtherNamesIsReadUnderOurs) {
    const Picture before = picture();
    for (const LayerNames names : {LayerNames::wend, LayerNames::pbrt, LayerNames::blender}) {
        for (const bool alpha : {false, true}) {
            const Picture after = read_picture(write(before, {names, alpha, false}));
            EXPECT_EQ(after.image.pixels, before.image.pixels) << to_string(names);
            EXPECT_EQ(after.metadata, before.metadata) << to_string(names);
            ASSERT_EQ(after.layers.size(), before.layers.size()) << to_string(names);
            for (const Layer& l : before.layers) {
                EXPECT_EQ(layer(after, l.name).channels, l.channels) << to_string(names) << ' ' << l.name;
                // 64 samples scale variances exactly.
                EXPECT_EQ(layer(after, l.name).values, l.values) << to_string(names) << ' ' << l.name;
            }
        }
    }
}

TEST_F(ExrFormat, ChannelsHaveTheNamesThatOthersKnow) {
    const auto of_wend = channels(write(picture(), {}));
    for (const char* name : {"R", "G", "B", "albedo.R", "normal.X", "depth.Z", "alpha.A", "samples.N", "variance.B"}) {
        EXPECT_EQ(of_wend.count(name), 1u) << name;
    }
    EXPECT_EQ(of_wend.count("A"), 0u) << "who reads R, G and B finds what was there";
    EXPECT_EQ(channels(write(picture(), {LayerNames::wend, true})).count("A"), 1u);

    const auto of_pbrt = channels(write(picture(), {LayerNames::pbrt}));
    for (const char* name : {"R", "Albedo.G", "Ns.Z", "Variance.R", "RelativeVariance.B", "depth.Z"}) {
        EXPECT_EQ(of_pbrt.count(name), 1u) << name;
    }
    EXPECT_EQ(of_pbrt.count("variance.R"), 0u);

    const auto of_blender = channels(write(picture(), {LayerNames::blender}));
    for (const char* name : {"Combined.R", "Combined.A", "Depth.Z", "Normal.X", "Denoising Albedo.R", "variance.R"}) {
        EXPECT_EQ(of_blender.count(std::string("ViewLayer.") + name), 1u) << name;
    }
    EXPECT_EQ(of_blender.count("R"), 0u);
}

TEST_F(ExrFormat, PbrtsVarianceIsThatOfOneSample) {
    const Picture before = picture();
    const std::string file = write(before, {LayerNames::pbrt});
    Imf::InputFile input(file.c_str());
    std::vector<float> variance(picture_pixels), relative(picture_pixels);
    Imf::FrameBuffer frame;
    const auto insert = [&](const char* name, std::vector<float>& into) {
        frame.insert(name, Imf::Slice::Make(Imf::FLOAT, into.data(), input.header().dataWindow()));
    };
    insert("Variance.G", variance);
    insert("RelativeVariance.G", relative);
    input.setFrameBuffer(frame);
    input.readPixels(0, picture_height - 1);
    for (std::size_t i = 0; i < picture_pixels; ++i) {
        const float of_mean = layer(before, "variance").values[3 * i + 1];
        EXPECT_EQ(variance[i], 64 * of_mean);
        EXPECT_FLOAT_EQ(relative[i], 64 * of_mean / before.image.pixels[i].g);
    }
}

TEST_F(ExrFormat, ColoursAreHalfFloatsWhereAskedFor) {
    const Picture before = picture();
    for (const auto& [name, type] : channels(write(before, {}))) {
        EXPECT_EQ(type, Imf::FLOAT) << name;
    }
    const std::string file = write(before, {LayerNames::wend, true, true});
    const auto types = channels(file);
    for (const char* colour : {"R", "G", "B", "A", "albedo.R"}) {
        EXPECT_EQ(types.at(colour), Imf::HALF) << colour;
    }
    for (const char* data : {"depth.Z", "normal.X", "samples.N", "variance.R", "scatter.P"}) {
        EXPECT_EQ(types.at(data), Imf::FLOAT) << data;
    }
    const Picture after = read_picture(file);
    EXPECT_NE(after.image.pixels, before.image.pixels);
    EXPECT_NEAR(after.image.pixels[4].g, before.image.pixels[4].g, before.image.pixels[4].g * 0x1p-11f);
    EXPECT_EQ(layer(after, "depth").values, layer(before, "depth").values);

    Picture bright = before;
    bright.image.pixels[2].r = 1e5f;
    bright.layers[0].values[1] = std::numeric_limits<float>::infinity();
    const std::string other = write(bright, {LayerNames::wend, true, true});
    EXPECT_EQ(channels(other).at("R"), Imf::FLOAT) << "too bright for half floats";
    EXPECT_EQ(read_picture(other).image.pixels, bright.image.pixels);
    EXPECT_EQ(channels(other).at("albedo.R"), Imf::HALF) << "these have infinities";
    EXPECT_TRUE(std::isinf(layer(read_picture(other), "albedo").values[1]));
}

TEST_F(ExrFormat, SamplesSeedAndSecondsAreNumbersToo) {
    Picture p = picture();
    p.metadata["wend:seconds"] = "1.5";
    {
        const Imf::InputFile input(write(p, {}).c_str());
        EXPECT_EQ(input.header().typedAttribute<Imf::IntAttribute>("samplesPerPixel").value(), 64);
        EXPECT_EQ(input.header().typedAttribute<Imf::IntAttribute>("seed").value(), 7);
        EXPECT_EQ(input.header().typedAttribute<Imf::FloatAttribute>("renderTimeSeconds").value(), 1.5f);
    }
    EXPECT_EQ(read_picture(folder_.file("p.exr")).metadata, p.metadata);
    // What has no such number: several seeds, a seed that no int holds, no time.
    for (const char* seed : {"1,2", "9876543210"}) {
        p.metadata["wend:seed"] = seed;
        p.metadata.erase("wend:seconds");
        const Imf::InputFile input(write(p, {}).c_str());
        EXPECT_EQ(input.header().findTypedAttribute<Imf::IntAttribute>("seed"), nullptr) << seed;
        EXPECT_EQ(input.header().findTypedAttribute<Imf::FloatAttribute>("renderTimeSeconds"), nullptr);
    }
    p.metadata = {{"seed", "mine"}};
    EXPECT_EQ(read_picture(write(p, {})).metadata, p.metadata) << "a text of that name stays";
}

/// Channels of some values each, as one part of a file.
struct Part {
    std::string name;
    std::map<std::string, float> channels;
    int width = 4;
};

void write_parts(const std::string& file, const std::vector<Part>& parts) {
    std::vector<Imf::Header> headers;
    for (const Part& part : parts) {
        Imf::Header& header =
            headers.emplace_back(Imath::Box2i({0, 0}, {3, 1}), Imath::Box2i({0, 0}, {part.width - 1, 1}));
        header.setName(part.name);
        header.setType(Imf::SCANLINEIMAGE);
        for (const auto& [name, value] : part.channels) {
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        }
    }
    Imf::MultiPartOutputFile output(file.c_str(), headers.data(), static_cast<int>(headers.size()));
    for (std::size_t i = 0; i < parts.size(); ++i) {
        Imf::OutputPart part(output, static_cast<int>(i));
        std::vector<std::vector<float>> kept;
        Imf::FrameBuffer frame;
        for (const auto& [name, value] : parts[i].channels) {
            kept.emplace_back(8, value);
            frame.insert(name, Imf::Slice::Make(Imf::FLOAT, kept.back().data(), headers[i].dataWindow()));
        }
        part.setFrameBuffer(frame);
        part.writePixels(2);
    }
}

TEST_F(ExrFormat, BlendersPartsAreLayers) {
    const std::string file = folder_.file("b.exr");
    write_parts(file, {{"ViewLayer.Combined",
                        {{"ViewLayer.Combined.R", 1.0f},
                         {"ViewLayer.Combined.G", 2.0f},
                         {"ViewLayer.Combined.B", 3.0f},
                         {"ViewLayer.Combined.A", 0.5f}}},
                       {"ViewLayer.Depth", {{"ViewLayer.Depth.Z", 7.0f}}},
                       {"ViewLayer.Diffuse Direct", {{"ViewLayer.Diffuse Direct.R", 4.0f}}},
                       {"Other.Combined", {{"Other.Combined.R", 9.0f}}}});
    const Picture p = read_picture(file);
    EXPECT_EQ(p.image.at(3, 1), Rgb(1, 2, 3));
    EXPECT_EQ(layer(p, "alpha").values, std::vector<float>(8, 0.5f));
    EXPECT_EQ(layer(p, "depth").values, std::vector<float>(8, 7.0f));
    EXPECT_EQ(layer(p, "Diffuse Direct").values, std::vector<float>(8, 4.0f));
    EXPECT_EQ(layer(p, "Other.Combined").values, std::vector<float>(8, 9.0f));
    EXPECT_EQ(p.layers.size(), 4u);
    EXPECT_EQ(read_image(file).at(0, 0), Rgb(1, 2, 3));
    EXPECT_EQ(read_image_with_opacity(file).opacity, std::vector<float>(8, 0.5f));
}

TEST_F(ExrFormat, PartsNameTheirChannels) {
    const std::string file = folder_.file("parts.exr");
    write_parts(file, {{"far", {{"Z", 5.0f}}},
                       {"rgb", {{"R", 1.0f}, {"G", 2.0f}, {"B", 3.0f}, {"A", 1.0f}}},
                       {"small", {{"Z", 6.0f}}, 3}});
    const Picture p = read_picture(file);
    EXPECT_EQ(p.image.at(0, 0), Rgb(1, 2, 3));
    EXPECT_EQ(layer(p, "far").values, std::vector<float>(8, 5.0f));
    EXPECT_EQ(layer(p, "").channels, std::vector<std::string>{"A"}) << "not Wend's";
    EXPECT_EQ(p.layers.size(), 2u) << "a part of another size is none of its layers";
}

TEST_F(ExrFormat, PbrtsOwnFilesHaveLayersOfOurNames) {
    const std::string file = folder_.file("gbuffer.exr");
    write_parts(file, {{"pbrt",
                        {{"R", 1.0f},
                         {"G", 1.0f},
                         {"B", 1.0f},
                         {"Albedo.R", 0.5f},
                         {"Albedo.G", 0.5f},
                         {"Albedo.B", 0.5f},
                         {"Ns.X", 0.0f},
                         {"Ns.Y", 0.0f},
                         {"Ns.Z", 1.0f},
                         {"Variance.R", 2.0f},
                         {"u", 0.25f},
                         {"v", 0.75f}}}});
    const Picture p = read_picture(file);
    EXPECT_EQ(layer(p, "albedo").channels, (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(layer(p, "normal").values[2], 1);
    EXPECT_EQ(layer(p, "Variance").values, std::vector<float>(8, 2.0f)) << "of a sample, whose number is not known";
    EXPECT_EQ(layer(p, "").channels, (std::vector<std::string>{"u", "v"}));
}

std::string picture_error_of(const std::string& file) {
    return test::message_of([&] { read_picture(file); });
}

/// A file of three parts, as bytes.
std::string three_parts(const std::string& file) {
    write_parts(file,
                {{"ViewLayer.Combined",
                  {{"ViewLayer.Combined.R", 1.0f}, {"ViewLayer.Combined.G", 2.0f}, {"ViewLayer.Combined.B", 3.0f}}},
                 {"ViewLayer.Depth", {{"ViewLayer.Depth.Z", 7.0f}}},
                 {"ViewLayer.Normal",
                  {{"ViewLayer.Normal.X", 0.0f}, {"ViewLayer.Normal.Y", 0.0f}, {"ViewLayer.Normal.Z", 1.0f}}}});
    return read_file(file);
}

TEST_F(ExrFormat, TruncatedPartsAreRefused) {
    const std::string file = folder_.file("parts.exr"), whole = three_parts(file);
    ASSERT_EQ(picture_error_of(file), "no error");
    for (std::size_t size = 0; size < whole.size(); size += size < 16 ? 1 : 13) {
        std::ofstream(file, std::ios::binary) << whole.substr(0, size);
        EXPECT_NE(picture_error_of(file).find("parts.exr"), std::string::npos)
            << size << " of " << whole.size() << " bytes";
    }
}

TEST_F(ExrFormat, DamagedPartsAreReadOrRefused) {
    const std::string file = folder_.file("parts.exr"), whole = three_parts(file);
    int refused = 0;
    for (std::size_t place = 0; place < whole.size(); place += 5) {
        for (const int flip : {0x01, 0xff}) {
            std::string damaged = whole;
            damaged[place] = static_cast<char>(damaged[place] ^ flip);
            std::ofstream(file, std::ios::binary) << damaged;
            const std::string error = picture_error_of(file);
            EXPECT_TRUE(error == "no error" || error.find("parts.exr") != std::string::npos) << place << ": " << error;
            refused += error == "no error" ? 0 : 1;
        }
    }
    EXPECT_GT(refused, 100) << "the magic number, types and sizes of channels, tables of offsets";
}

TEST_F(ExrFormat, UnknownNamesAreRefused) {
    EXPECT_THROW(parse_layer_names("maya"), InputError);
    EXPECT_EQ(parse_layer_names("pbrt"), LayerNames::pbrt);
    write_parts(folder_.file("none.exr"), {{"a", {{"ViewLayer.Depth.Z", 1.0f}}}});
    EXPECT_THROW(read_picture(folder_.file("none.exr")), InputError);
}

TEST_F(ExrFormat, AnOnlyChannelOfATextureIsGreyWhateverItsName) {
    Imf::Header header(2, 1);
    header.channels().insert("height", Imf::Channel(Imf::FLOAT));
    std::vector<float> heights{0.25f, 3};
    Imf::FrameBuffer frame;
    frame.insert("height", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(heights.data()), 4, 8));
    {
        Imf::OutputFile file(folder_.file("h.exr").c_str(), header);
        file.setFrameBuffer(frame);
        file.writePixels(1);
    }
    EXPECT_EQ(read_image(folder_.file("h.exr")).pixels, (std::vector<Rgb>{Rgb(0.25f), Rgb(3.0f)}));
    EXPECT_THROW(read_picture(folder_.file("h.exr")), InputError);
}

}  // namespace
}  // namespace wend
