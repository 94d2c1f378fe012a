#include <tests/io/errors.h>
#include <wend/io/png_check.h>

#include <gtest/gtest.h>

#include <cstdint>

namespace wend {
namespace {

std::string big_endian(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) {
        bytes += static_cast<char>(value >> shift & 0xff);
    }
    return bytes;
}

std::string chunk(const std::string& type, const std::string& data) {
    return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(0);
}

/// A file without pixels: its header comes first.
std::string png(std::uint32_t width, std::uint32_t height, char depth, char kind) {
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR", big_endian(width) + big_endian(height) + depth + kind + std::string(3, '\0')) +
           chunk("IEND", "");
}

std::string header_message_of(std::string file) {
    return test::message_of([&] { prepare_png(file, Place{"a.png"}); });
}

TEST(PngHeader, WrongOnesAreNamed) {
    EXPECT_EQ(header_message_of(png(2, 1, 8, 2)), "no error");
    EXPECT_EQ(header_message_of(png(2, 1, 16, 6)), "no error");
    EXPECT_NE(header_message_of(png(0, 1, 8, 2)).find("0 x 1"), std::string::npos);
    EXPECT_NE(header_message_of(png(0x7fffffff, 0x7fffffff, 8, 2)).find("too large"), std::string::npos);
    EXPECT_NE(header_message_of(png(2, 1, 7, 2)).find("7 bits"), std::string::npos);
    EXPECT_NE(header_message_of(png(2, 1, 8, 5)).find("kind 5"), std::string::npos);
}

}  // namespace
}  // namespace wend
