#include <tests/io/errors.h>
#include <tests/support/paths.h>
#include <wend/core/error.h>
#include <wend/io/atomic_file.h>
#include <wend/io/colour_encoding.h>
#include <wend/io/gzip.h>
#include <wend/io/image_file.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>

namespace wend {
namespace {

using test::message_of;

namespace fs = std::filesystem;

/// A folder of the test's own that disappears with it.
class ImageFile : public testing::Test {
protected:
    ImageFile() : folder(fs::temp_directory_path() / ("wend-image-" + std::to_string(std::random_device()()))) {
        fs::create_directory(folder);
    }
    ~ImageFile() override { fs::remove_all(folder); }

    void store(const fs::path& name, const std::string& bytes) const {
        std::ofstream(folder / name, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }
    int files() const { return static_cast<int>(std::distance(fs::directory_iterator(folder), {})); }

    fs::path folder;
};

Image gradient(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float u = (x + 0.5f) / width, v = (y + 0.5f) / height;
            image.at(x, y) = {u, v, 0.5f * (u + v)};
        }
    }
    return image;
}

void expect_near(const Image& a, const Image& b, float tolerance) {
    ASSERT_EQ(a.width, b.width);
    ASSERT_EQ(a.height, b.height);
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            ASSERT_NEAR(a.pixels[i][c], b.pixels[i][c], tolerance) << "pixel " << i;
        }
    }
}

TEST_F(ImageFile, ColoursAloneAreHalfFloats) {
    Picture picture;
    picture.image = gradient(64, 48);
    picture.image.at(3, 4) = {65000, 1e-3f, -2.5f};
    picture.offset = {5, 7};
    picture.full_size = {100, 80};
    picture.metadata = {{"seed", "17"}};
    picture.layers = {{"depth", {"Z"}, std::vector<float>(64 * 48, 2.0f)}};
    write_picture(folder / "all.exr", picture);
    write_colours(folder / "colours.exr", picture);
    EXPECT_LT(2 * fs::file_size(folder / "colours.exr"), fs::file_size(folder / "all.exr"));
    const Picture read = read_picture(folder / "colours.exr");
    EXPECT_TRUE(read.layers.empty());
    EXPECT_EQ(read.offset, picture.offset);
    EXPECT_EQ(read.full_size, picture.full_size);
    EXPECT_EQ(read.metadata.at("seed"), "17");
    bool rounded = false;
    for (std::size_t i = 0; i < read.image.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const float before = picture.image.pixels[i][c], after = read.image.pixels[i][c];
            ASSERT_NEAR(after, before, std::abs(before) * 0x1p-11f) << "pixel " << i;
            rounded = rounded || after != before;
        }
    }
    EXPECT_TRUE(rounded) << "these are no half floats";
}

TEST_F(ImageFile, ColoursTooLargeForHalfFloatsAreKeptAsTheyAre) {
    Picture picture;
    picture.image = gradient(9, 5);
    picture.image.at(3, 4).g = 1e6f;
    write_colours(folder / "bright.exr", picture);
    EXPECT_EQ(read_image(folder / "bright.exr").pixels, picture.image.pixels);
    EXPECT_THROW(write_colours(folder / "bright.png", picture), InputError);
    EXPECT_EQ(files(), 1);
}

TEST_F(ImageFile, ExrKeepsEverything) {
    Picture picture;
    picture.image = gradient(17, 9);
    picture.image.at(3, 4) = {1e6f, 1e-30f, -2.5f};
    picture.offset = {5, 7};
    picture.full_size = {40, 30};
    picture.metadata = {{"scene", "cloud.pbrt"}, {"seed", "17"}, {"note", "two\nlines"}};
    picture.view.emplace().camera_from_world[3] = 4;
    picture.view->ndc_from_world[12] = -0.5f;
    Layer albedo{"albedo", {"R", "G", "B"}, std::vector<float>(17 * 9 * 3)};
    Layer depth{"depth", {"Z"}, std::vector<float>(17 * 9)};
    for (std::size_t i = 0; i < albedo.values.size(); ++i) {
        albedo.values[i] = static_cast<float>(i) / 3;
    }
    for (std::size_t i = 0; i < depth.values.size(); ++i) {
        depth.values[i] = static_cast<float>(i) * 7;
    }
    depth.values[3] = std::numeric_limits<float>::infinity();
    picture.layers = {albedo, depth};
    write_picture(folder / "a.exr", picture);

    const Picture read = read_picture(folder / "a.exr");
    EXPECT_EQ(read.image.pixels, picture.image.pixels);
    EXPECT_EQ(read.offset, picture.offset);
    EXPECT_EQ(read.full_size, picture.full_size);
    EXPECT_EQ(read.metadata, picture.metadata);
    ASSERT_TRUE(read.view);
    EXPECT_EQ(read.view->camera_from_world, picture.view->camera_from_world);
    EXPECT_EQ(read.view->ndc_from_world, picture.view->ndc_from_world);
    ASSERT_EQ(read.layers.size(), 2u);
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(read.layers[i].name, picture.layers[i].name);
        EXPECT_EQ(read.layers[i].channels, picture.layers[i].channels);
        EXPECT_EQ(read.layers[i].values, picture.layers[i].values);
    }
    EXPECT_EQ(read_image(folder / "a.exr").pixels, picture.image.pixels);
    EXPECT_EQ(files(), 1);
}

TEST_F(ImageFile, PngHoldsSrgbAndReadsBack) {
    Picture picture;
    picture.image = Image(4, 1);
    picture.image.pixels = {Rgb(0.2140411f), {0.0f, 1.0f, 7.0f}, {-1.0f, std::nanf(""), 0.002f}, Rgb(0.5f)};
    write_picture(folder / "a.png", picture);
    const Image raw = read_image(folder / "a.png", ColourEncoding::linear);
    EXPECT_NEAR(raw.at(0, 0).r, 0.5f, 0.5f / 255);
    EXPECT_EQ(raw.at(1, 0), Rgb(0, 1, 1));
    EXPECT_EQ(raw.at(2, 0).r, 0);
    EXPECT_EQ(raw.at(2, 0).g, 0);
    EXPECT_NEAR(raw.at(2, 0).b, 0.002f * 12.92f, 0.5f / 255);
    EXPECT_NEAR(raw.at(3, 0).g, 0.7354f, 0.5f / 255);
    const Image linear = read_image(folder / "a.png");
    EXPECT_NEAR(linear.at(3, 0).g, 0.5f, 0.005f);
}

TEST_F(ImageFile, JpegIsCloseToThePicture) {
    Picture picture;
    picture.image = gradient(64, 48);
    write_picture(folder / "a.JPG", picture);
    expect_near(read_image(folder / "a.JPG"), picture.image, 0.03f);
}

// One row of two grey pixels of 16 bits, 0x8000 and 0xffff.
const unsigned char png_16[] = {0x89, 'P',  'N',  'G', 0x0d, 0x0a, 0x1a, 0x0a, 0,    0,    0,    13,   'I',  'H',  'D',
                                'R',  0,    0,    0,   2,    0,    0,    0,    1,    16,   0,    0,    0,    0,    0x06,
                                0x9d, 0x19, 0xa2, 0,   0,    0,    16,   'I',  'D',  'A',  'T',  0x78, 0x01, 0x01, 5,
                                0,    0xfa, 0xff, 0,   0x80, 0,    0xff, 0xff, 0x08, 0x7d, 0x02, 0x7f, 0,    0,    0,
                                0,    0,    0,    0,   0,    'I',  'E',  'N',  'D',  0xae, 0x42, 0x60, 0x82};

TEST_F(ImageFile, Png16KeepsItsDepthAndGreyFillsAllChannels) {
    store("a.png", std::string(reinterpret_cast<const char*>(png_16), sizeof png_16));
    const Image image = read_image(folder / "a.png", ColourEncoding::linear);
    ASSERT_EQ(image.width, 2);
    EXPECT_EQ(image.at(0, 0), Rgb(32768.0f / 65535));
    EXPECT_EQ(image.at(1, 0), Rgb(1));
}

TEST_F(ImageFile, ReadsTgaAndHdr) {
    store("a.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\1\0\x18\x20", 18) + std::string("\0\x7f\xff\xff\0\0", 6));
    // Of these, the encoding is sRGB whatever is asked for.
    const Image tga = read_image(folder / "a.tga", ColourEncoding::linear);
    EXPECT_EQ(tga.at(0, 0), Rgb(1, srgb_to_linear(127 / 255.0f), 0));
    EXPECT_EQ(tga.at(1, 0), Rgb(0, 0, 1));
    store("a.hdr",
          "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + std::string("\x80\x40\x20\x82\x80\x80\x80\x81", 8));
    const Image hdr = read_image(folder / "a.hdr");
    EXPECT_EQ(hdr.at(0, 0), Rgb(2, 1, 0.5f));
    EXPECT_EQ(hdr.at(1, 0), Rgb(1));
}

std::string pfm(const char* head, const std::vector<float>& values, bool swapped) {
    std::string bytes = head;
    for (const float value : values) {
        std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
        bytes += swapped ? std::string(raw.rbegin(), raw.rend()) : raw;
    }
    return bytes;
}

TEST_F(ImageFile, ReadsFloatMapsFromTheBottom) {
    for (const bool swapped : {false, true}) {
        // The first row of the file is the lowest.
        store("a.pfm", pfm(swapped ? "PF\n1 2\n2.0\n" : "PF\n1 2\n-2.0\n", {1, 2, 3, 4, 5, 0.5f}, swapped));
        const Image image = read_image(folder / "a.pfm");
        EXPECT_EQ(image.at(0, 0), Rgb(8, 10, 1));
        EXPECT_EQ(image.at(0, 1), Rgb(2, 4, 6));
        store("a.pfm", pfm(swapped ? "Pf 2 1 1\n" : "Pf 2 1 -1\n", {0.25f, 7}, swapped));
        const Image grey = read_image(folder / "a.pfm");
        EXPECT_EQ(grey.at(0, 0), Rgb(0.25f));
        EXPECT_EQ(grey.at(1, 0), Rgb(7));
    }
}

TEST_F(ImageFile, ReadsPixelMapsOfAllKinds) {
    const Rgb expected(1, 0, srgb_to_linear(51 / 255.0f));
    const std::string texts[] = {"P3\n# made by hand\n1 1 # one pixel\n255\n255 0 51\n",
                                 "P6 1 1 255\n\xff" + std::string("\0\x33", 2),
                                 "P6\n1 1\n65535\n\xff\xff" + std::string("\0\0\x33\x33", 4), "P3 1 1 5 5 0 1"};
    for (const std::string& text : texts) {
        store("a.ppm", text);
        const Rgb pixel = read_image(folder / "a.ppm").at(0, 0);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(pixel[c], expected[c], 1e-6f) << text;
        }
    }
    for (const char* text : {"P2 2 1 255 51 300", "P5 2 1 255\n\x33\xff"}) {
        store("a.pgm", text);
        const Image image = read_image(folder / "a.pgm");
        EXPECT_FLOAT_EQ(image.at(0, 0).g, srgb_to_linear(51 / 255.0f));
        EXPECT_EQ(image.at(1, 0), Rgb(1));
    }
}

TEST_F(ImageFile, ReadsTheFirstPictureOfAGif) {
    // A screen of 3 x 2 with the colours black, red, green and white and the background green; an extension that makes
    // white transparent; and a picture of 2 x 2 at (1, 0): red, white, white, red.
    const std::string gif = std::string("GIF89a\3\0\2\0\x81\2\0", 13) +
                            std::string("\0\0\0\xff\0\0\0\xff\0\xff\xff\xff", 12) +
                            std::string("\x21\xf9\4\1\0\0\3\0", 8) + std::string("\x2c\1\0\0\0\2\0\2\0\0\2", 11) +
                            // Codes of three bits, and of four from the fourth on: clear, 1, 3, 3, 1, end.
                            std::string("\3\xcc\x16\x05\0\x3b", 6);
    store("a.gif", gif);
    const Image image = read_image(folder / "a.gif");
    const Rgb red(1, 0, 0), green(0, 1, 0);
    const std::vector<Rgb> expected{green, red, green, green, green, red};
    EXPECT_EQ(image.pixels, expected);
    EXPECT_TRUE(read_image_with_opacity(folder / "a.gif").opacity.empty());
    // With the first colour as the background, what is not drawn is transparent.
    std::string clear = gif;
    clear[11] = 0;
    store("b.gif", clear);
    EXPECT_EQ(read_image_with_opacity(folder / "b.gif").opacity, (std::vector<float>{0, 1, 0, 0, 0, 1}));
    EXPECT_EQ(read_image(folder / "b.gif").at(0, 0), Rgb(0.0f));
}

TEST_F(ImageFile, TgaAndBmpHaveOpacity) {
    // Two pixels, blue first: one opaque, one by 188, which is a half decoded.
    const std::string pixels("\0\0\xff\xff\0\xff\0\xbc", 8);
    store("a.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\1\0\x20\x28", 18) + pixels);
    const std::string masks("\0\0\xff\0\0\xff\0\0\xff\0\0\0\0\0\0\xff", 16);
    store("a.bmp", std::string("BM\x82\0\0\0\0\0\0\0\x7a\0\0\0", 14) +
                       std::string("\x6c\0\0\0\2\0\0\0\1\0\0\0\1\0\x20\0\3\0\0\0", 20) + std::string(20, '\0') + masks +
                       std::string(52, '\0') + pixels);
    for (const char* name : {"a.tga", "a.bmp"}) {
        const ImageWithOpacity picture = read_image_with_opacity(folder / name);
        EXPECT_EQ(picture.image.pixels, (std::vector<Rgb>{{1, 0, 0}, {0, 1, 0}})) << name;
        ASSERT_EQ(picture.opacity.size(), 2u) << name;
        EXPECT_EQ(picture.opacity[0], 1) << name;
        EXPECT_NEAR(picture.opacity[1], 0.5f, 5e-3f) << name;
    }
}

TEST_F(ImageFile, ReadsQoi) {
    const std::string head("qoif\0\0\0\4\0\0\0\2\4", 13);
    // Red and half opaque; a little less red; a run of two; by luma; red again by its slot; run of two.
    const std::string pixels("\xff\xff\0\0\x80\x5a\xc1\xa0\x88\x3d\xc1", 11);
    store("a.qoi", head + std::string("\1", 1) + pixels + std::string("\0\0\0\0\0\0\0\1", 8));
    const ImageWithOpacity picture = read_image_with_opacity(folder / "a.qoi");
    ASSERT_EQ(picture.opacity.size(), 8u);
    EXPECT_EQ(picture.image.at(0, 0), Rgb(1, 0, 0));
    EXPECT_FLOAT_EQ(picture.opacity[0], 128 / 255.0f);
    EXPECT_EQ(picture.image.at(1, 0), Rgb(254 / 255.0f, 0, 0));
    EXPECT_EQ(picture.image.at(3, 0), picture.image.at(1, 0));
}

TEST_F(ImageFile, OpacityIsKeptUnlessItIsOne) {
    Picture picture;
    picture.image = gradient(4, 3);
    picture.layers = {{"", {"A"}, std::vector<float>(12, 1.0f)}};
    write_picture(folder / "a.exr", picture);
    EXPECT_TRUE(read_image_with_opacity(folder / "a.exr").opacity.empty());
    picture.layers[0].values[5] = 0.5f;
    write_picture(folder / "a.exr", picture);
    const ImageWithOpacity read = read_image_with_opacity(folder / "a.exr");
    EXPECT_EQ(read.opacity, picture.layers[0].values);
    EXPECT_EQ(read.image.pixels, picture.image.pixels);
}

TEST_F(ImageFile, OwnReadersRefuseWhatIsBroken) {
    const std::string qoi = std::string("qoif\0\0\0\4\0\0\0\2\3\0", 14) + std::string(8, '\x5a');
    const std::string gif = std::string("GIF89a\2\0\2\0\x81\0\0", 13) + std::string(12, 'x') +
                            std::string("\x2c\0\0\0\0\2\0\2\0\0\2\3\xcc\x16\x05\0", 16);
    const std::string files[] = {pfm("PF 2 2 -1\n", std::vector<float>(12, 1.0f), false),
                                 "P6 2 2 255\n" + std::string(12, 'x'), "P3 2 2 9 1 2 3 4 5 6 7 8 9 1 2 3", qoi, gif};
    for (const std::string& whole : files) {
        store("a", whole);
        EXPECT_NO_THROW(read_image(folder / "a")) << whole;
        for (std::size_t size = 0; size < whole.size(); ++size) {
            store("a", whole.substr(0, size));
            const std::string message = message_of([&] { read_image(folder / "a"); });
            EXPECT_NE(message.find("a: error"), std::string::npos) << whole << " " << size << ": " << message;
        }
        std::uint64_t state = 1;
        for (int i = 0; i < 300; ++i) {
            std::string broken = whole;
            state = state * 6364136223846793005ull + 1442695040888963407ull;
            broken[(state >> 33) % broken.size()] ^= static_cast<char>(state >> 24 | 1);
            store("a", broken);
            message_of([&] { read_image(folder / "a"); });
        }
    }
    for (const char* text : {"PF 100000 100000 -1\n", "P6 100000 100000 255\n", "P6 0 1 255\n", "P6 -1 1 255\n",
                             "P6 1 1 0\n\1\1\1", "P3 1 1 99999 1 1 1", "P3 x 1 9 1 1 1", "PF 1 1 nan\n123456789012"}) {
        store("a", text);
        EXPECT_NE(message_of([&] { read_image(folder / "a"); }), "no error") << text;
    }
}

TEST_F(ImageFile, ManyPixelsOfAFewBytesAreRefusedBeforeTheyTakeMemory) {
    // 5000 x 5000, which pictures of other kinds may have in so few bytes.
    store("a", std::string("qoif\0\0\x13\x88\0\0\x13\x88\3\0", 14) + std::string(22, '\xfd'));
    EXPECT_NE(message_of([&] { read_image(folder / "a"); }).find("36 bytes cannot hold 5000 x 5000"),
              std::string::npos);
}

TEST_F(ImageFile, TruncatedFilesAreRefused) {
    Picture picture;
    picture.image = gradient(40, 30);
    for (const char* name : {"a.exr", "a.png", "a.jpg"}) {
        write_picture(folder / name, picture);
    }
    std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\x28\0\x1e\0\x18\x20", 18);
    store("a.tga", tga + std::string(40 * 30 * 3, 'x'));
    store("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 30 +X 4\n" + std::string(480, 'x'));
    for (const char* name : {"a.exr", "a.png", "a.jpg", "a.tga", "a.hdr"}) {
        EXPECT_NO_THROW(read_image(folder / name)) << name;
        const std::string whole = read_file(folder / name);
        for (const double fraction : {0.0, 0.001, 0.01, 0.1, 0.5, 0.9, 0.99}) {
            store(name, whole.substr(0, static_cast<std::size_t>(fraction * static_cast<double>(whole.size()))));
            const std::string message = message_of([&] { read_image(folder / name); });
            EXPECT_NE(message.find(name), std::string::npos) << name << " " << fraction << ": " << message;
        }
    }
}

TEST_F(ImageFile, DamagedFilesDoNotCrash) {
    Picture picture;
    picture.image = gradient(40, 30);
    for (const char* name : {"a.exr", "a.png", "a.jpg"}) {
        write_picture(folder / name, picture);
        const std::string whole = read_file(folder / name);
        std::uint64_t state = 1;
        for (int i = 0; i < 100; ++i) {
            std::string broken = whole;
            for (int k = 0; k < 3; ++k) {
                state = state * 6364136223846793005ull + 1442695040888963407ull;
                broken[(state >> 33) % std::min<std::size_t>(broken.size(), i % 2 ? 400 : broken.size())] ^=
                    static_cast<char>(state >> 24 | 1);
            }
            store(name, broken);
            try {
                read_image(folder / name);
            } catch (const InputError&) {
            }
        }
    }
}

TEST_F(ImageFile, JpegWithATooLargeHuffmanTableIsRefused) {
    Picture picture;
    picture.image = gradient(40, 30);
    write_picture(folder / "a.jpg", picture);
    std::string bytes = read_file(folder / "a.jpg");
    const std::size_t first_count = bytes.find("\xff\xc4") + 5;
    bytes[first_count + 15] = '\xff';
    bytes[first_count + 14] = '\xff';
    store("a.jpg", bytes);
    EXPECT_NE(message_of([&] { read_image(folder / "a.jpg"); }).find("Huffman"), std::string::npos);
    // A table that reaches beyond its segment, and beyond the file.
    store("a.jpg", std::string("\xff\xd8\xff\xc4\0\x05\0", 7) + "\xff\xff");
    EXPECT_NE(message_of([&] { read_image(folder / "a.jpg"); }).find("Huffman"), std::string::npos);
    // Beyond the file the reader sees line breaks, which count as well.
    store("a.jpg", std::string("\xff\xd8\xff\xc4\0\x05\0", 7) + "\xdf");
    EXPECT_NE(message_of([&] { read_image(folder / "a.jpg"); }).find("Huffman"), std::string::npos);
    // Any number of these bytes may stand before a marker, the first one too.
    store("a.jpg", "\xff\xff\xff" + bytes);
    EXPECT_NE(message_of([&] { read_image(folder / "a.jpg"); }).find("Huffman"), std::string::npos);
}

TEST_F(ImageFile, ABmpHoldsAllOfItsPixels) {
    const std::string header("BM\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x02\0\0\0\0\0\xdc\0\x01\0\x18\0", 30);
    store("a.bmp", header + std::string(24 + 12, '\0'));  // of 14 million rows one or two
    EXPECT_NE(message_of([&] { read_image(folder / "a.bmp"); }).find("truncated"), std::string::npos);
}

TEST_F(ImageFile, LinesThatAreUnpackedAtOnceAreBounded) {
    Picture picture;
    picture.image = gradient(4, 1);
    write_picture(folder / "a.exr", picture);
    std::string bytes = read_file(folder / "a.exr");
    const std::size_t box = bytes.find("dataWindow") + sizeof "dataWindow" + sizeof "box2i" + sizeof(std::int32_t);
    bytes[box + 11] = '\x01';  // 16 million pixels wide, one high, 16 lines at once
    store("a.exr", bytes);
    EXPECT_NE(message_of([&] { read_image(folder / "a.exr"); }).find("too large: 16777220 x 1"), std::string::npos);
}

TEST_F(ImageFile, AbsurdSizesAreRefusedBeforeTheyAreAllocated) {
    Picture picture;
    picture.image = gradient(4, 3);
    write_picture(folder / "a.exr", picture);
    std::string exr = read_file(folder / "a.exr");
    const std::size_t window = exr.find("dataWindow") + std::string("dataWindow\0box2i\0", 17).size() + 4;
    exr.replace(window, 16, std::string("\0\0\0\0\0\0\0\0\xff\xff\xff\x0f\xff\xff\xff\x0f", 16));
    store("a.exr", exr);
    EXPECT_NE(message_of([&] { read_image(folder / "a.exr"); }).find("too large: 268435456 x 268435456"),
              std::string::npos);
    std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\xff\xff\xff\xff\x18\x20", 18);
    store("a.tga", tga);
    EXPECT_NE(message_of([&] { read_image(folder / "a.tga"); }).find("too large: 65535 x 65535"), std::string::npos);
    tga.replace(12, 4, "\x20\x4e\x10\x27");
    store("a.tga", tga);
    EXPECT_NE(message_of([&] { read_image(folder / "a.tga"); }).find("cannot hold 20000 x 10000"), std::string::npos);
}

TEST_F(ImageFile, MissingUnknownAndForeignFilesAreNamed) {
    EXPECT_NE(message_of([&] { read_image(folder / "none.png"); }).find("none.png"), std::string::npos);
    EXPECT_NE(message_of([&] { read_image(folder); }).find("folder"), std::string::npos);
    store("text.png", "this is not a picture, whatever its name says");
    EXPECT_NE(message_of([&] { read_image(folder / "text.png"); }).find("text.png"), std::string::npos);
    EXPECT_NE(message_of([&] { read_picture(folder / "text.png"); }).find("OpenEXR"), std::string::npos);
}

TEST_F(ImageFile, FailedWritesLeaveNothingBehind) {
    Picture picture;
    picture.image = gradient(4, 3);
    EXPECT_THROW(write_picture(folder / "a.gif", picture), InputError);
    EXPECT_THROW(write_picture(folder / "absent" / "a.exr", picture), std::runtime_error);
    EXPECT_THROW(write_picture(folder / "absent" / "a.png", picture), std::runtime_error);
    // The rename fails at the very end: a folder with something in it has the name.
    fs::create_directories(folder / "taken.exr" / "inside");
    EXPECT_THROW(write_picture(folder / "taken.exr", picture), std::runtime_error);
    EXPECT_EQ(files(), 1);
}

TEST_F(ImageFile, FailingWriterKeepsTheOldFile) {
    write_atomically(folder / "a.txt", "old");
    EXPECT_THROW(write_atomically(folder / "a.txt",
                                  [](const fs::path& temporary) {
                                      std::ofstream(temporary) << "half";
                                      throw std::runtime_error("disk");
                                  }),
                 std::runtime_error);
    EXPECT_EQ(read_file(folder / "a.txt"), "old");
    write_atomically(folder / "a.txt", "new");
    EXPECT_EQ(read_file(folder / "a.txt"), "new");
    EXPECT_EQ(files(), 1);
}

TEST_F(ImageFile, ReadsTheTextureOfARealScene) {
    const fs::path file = test::shared_dir() / "scenes/veach-ajar/textures/cherry-wood-texture.tga";
    if (!fs::exists(file)) {
        GTEST_SKIP() << "no collection of scenes beside the checkout: " << file;
    }
    const Image image = read_image(file);
    EXPECT_GT(image.width, 100);
    Rgb sum;
    for (const Rgb& pixel : image.pixels) {
        sum += pixel;
    }
    EXPECT_GT(sum.r, sum.g);  // wood is brown
    EXPECT_GT(sum.g, sum.b);
}

TEST_F(ImageFile, ReadsHalfFloatReferences) {
    const Image image = read_image(test::source_dir() / "tests/references/fog-box-1.exr");
    EXPECT_EQ(image.width, 96);
    EXPECT_EQ(image.height, 96);
    double sum = 0;
    for (const Rgb& pixel : image.pixels) {
        ASSERT_TRUE(is_finite(pixel));
        sum += luminance(pixel);
    }
    EXPECT_GT(sum / (96 * 96), 0.01);
}

}  // namespace
}  // namespace wend
