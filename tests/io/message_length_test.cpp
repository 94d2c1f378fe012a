#include "load_support.h"

#include <wend/io/load/message_length.h>
#include <wend/io/load/parse_scene.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

constexpr std::size_t longest = 1600;

std::string message_of_line_2(const std::string& world) {
    try {
        load_scene(parse_scene("WorldBegin\n" + world, std::filesystem::temp_directory_path(), "test.pbrt"));
    } catch (const InputError& error) {
        EXPECT_EQ(error.place().line, 2);
        return error.what();
    }
    return "";
}

TEST(MessageLength, ShortMessagesStay) {
    const std::string text = "the material \"fog \xc3\xa9\" is not defined\n\tat all";
    EXPECT_EQ(readable_message(text), text);
}

TEST(MessageLength, LongMessagesKeepBothEnds) {
    const std::string text =
        readable_message("Shape \"" + std::string(5'000'000, 'x') + "\" is unknown; known are sphere");
    EXPECT_LT(text.size(), longest);
    EXPECT_TRUE(text.starts_with("Shape \"xxx"));
    EXPECT_TRUE(text.ends_with("xxx\" is unknown; known are sphere"));
    EXPECT_NE(text.find("[... 4998537 characters ...]"), std::string::npos) << text;
}

TEST(MessageLength, CutsBetweenCharacters) {
    for (std::size_t shift = 0; shift < 3; ++shift) {
        std::string text(shift, 'a');
        while (text.size() < 6000) {
            text += "\xe2\x82\xac";
        }
        const std::string cut = readable_message(text);
        const std::size_t gap = cut.find("[...");
        ASSERT_NE(gap, std::string::npos);
        EXPECT_EQ((gap - shift) % 3, 0u);
        EXPECT_EQ(cut.substr(cut.find("...]") + 4, 3), "\xe2\x82\xac");
    }
}

TEST(MessageLength, ControlCharactersAreNotPrinted) {
    EXPECT_EQ(readable_message("red \x1b[31m"), "red ?[31m");
}

/// Whatever takes the name: each message names its place, and begins with what is wrong.
TEST(MessageLength, NamesOfAnyLengthGetReadableErrors) {
    const std::string name(100'000, 'x');
    for (const std::string& world :
         {"Shape \"" + name + "\"", "Material \"" + name + "\"", "NamedMaterial \"" + name + "\" Shape \"sphere\"",
          "LightSource \"" + name + "\"", "Include \"" + name + "\"", "ObjectInstance \"" + name + "\"",
          "Texture \"a\" \"spectrum\" \"" + name + "\"", "MakeNamedMedium \"a\" \"string type\" \"" + name + "\"",
          "LightSource \"infinite\" \"spectrum L\" \"" + name + "\"",
          "Shape \"plymesh\" \"string filename\" \"" + name + "\""}) {
        const std::string message = message_of_line_2(world);
        EXPECT_TRUE(message.starts_with("test.pbrt:2:")) << world.substr(0, 60);
        EXPECT_LT(message.size(), longest) << world.substr(0, 60);
    }
}

TEST(MessageLength, NamesOfAnyLengthGetReadableWarnings) {
    const std::string name(100'000, 'x');
    const LoadedScene loaded = test::load_text("Shape \"sphere\" \"float " + name + "\" 1 ColorSpace \"" + name +
                                               "\" CoordSysTransform \"" + name + "\"");
    ASSERT_EQ(test::warnings_with(loaded, "is not used"), 1);
    ASSERT_EQ(loaded.warnings.size(), 3u);
    for (const std::string& warning : loaded.warnings) {
        EXPECT_LT(warning.size(), longest);
    }
}

}  // namespace
}  // namespace wend
