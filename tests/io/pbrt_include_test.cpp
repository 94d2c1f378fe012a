#include <tests/io/pbrt_support.h>
#include <wend/io/pbrt/parser.h>
#include <wend/io/pbrt/token_stream.h>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace wend::pbrt {
namespace {

class PbrtInclude : public testing::Test {
protected:
    PbrtInclude() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        directory_ = std::filesystem::path(testing::TempDir()) / ("wend_pbrt_" + std::string(test->name()));
        std::filesystem::remove_all(directory_);
        std::filesystem::create_directories(directory_ / "parts");
    }
    ~PbrtInclude() override { std::filesystem::remove_all(directory_); }

    void write(const std::string& name, const std::string& text) { std::ofstream(directory_ / name) << text; }
    void write_gzip(const std::string& name, const std::string& text) {
        gzFile file = gzopen((directory_ / name).c_str(), "wb");
        gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
        gzclose(file);
    }
    std::string path(const std::string& name) const { return (directory_ / name).string(); }
    Description parse(const std::string& text) {
        write("main.pbrt", text);
        return parse_file(directory_ / "main.pbrt");
    }
    std::string error_of(const std::string& text) {
        return message_of([&] { parse(text); });
    }

    std::filesystem::path directory_;
};

TEST_F(PbrtInclude, ContinuesInTheOtherFile) {
    write("a.pbrt", "Translate 1 0 0\nShape \"a\"");
    const Description d = parse("WorldBegin Include \"a.pbrt\" Shape \"b\"");
    ASSERT_EQ(d.shapes.size(), 2u);
    EXPECT_EQ(Place(d.shapes[0].place).file, path("a.pbrt"));
    EXPECT_EQ(d.shapes[0].place.line, 2);
    EXPECT_EQ(d.shapes[1].world_from_object, Transform::translate(1, 0, 0));
}

TEST_F(PbrtInclude, MayCarryParametersOfAnOpenDirective) {
    write("params.pbrt", "\"float scale\" 4\n\"float g\" .5");
    const Description d = parse(
        "WorldBegin MakeNamedMedium \"x\" \"string type\" \"cloud\" Include \"params.pbrt\" \"float density\" 2 Shape "
        "\"a\"");
    EXPECT_EQ(d.media[0].parameters.get_float("scale", 0), 4);
    EXPECT_EQ(d.media[0].parameters.get_float("g", 0), .5f);
    EXPECT_EQ(d.media[0].parameters.get_float("density", 0), 2);
    EXPECT_EQ(d.shapes.size(), 1u);
}

TEST_F(PbrtInclude, AfterADirectiveWithParametersStartsAFreshOne) {
    write("a.pbrt", "Shape \"a\" \"float radius\" 3");
    const Description d = parse("WorldBegin Shape \"b\" \"float radius\" 2 Include \"a.pbrt\"");
    EXPECT_EQ(d.shapes[0].parameters.get_float("radius", 0), 2);
    EXPECT_EQ(d.shapes[1].parameters.get_float("radius", 0), 3);
}

TEST_F(PbrtInclude, IsRelativeToTheMainFileAndThenToTheIncludingOne) {
    write("parts/a.pbrt", "Include \"b.pbrt\" Include \"parts/c.pbrt\"");
    write("parts/b.pbrt", "Shape \"b\"");
    write("parts/c.pbrt", "Shape \"c\" \"string filename\" \"m.ply\"");
    write("m.ply", "");
    const Description d = parse("WorldBegin Include \"parts/a.pbrt\"");
    ASSERT_EQ(d.shapes.size(), 2u);
    const Location& place = d.shapes[1].parameters.place_of("filename");
    EXPECT_EQ(find_file("m.ply", place, d.base_directory), directory_ / "m.ply");
    EXPECT_EQ(find_file("b.pbrt", place, d.base_directory), directory_ / "parts/b.pbrt");
}

TEST_F(PbrtInclude, TheFileBesideTheMainOneCountsWhereThereAreTwo) {
    write("parts/a.pbrt", "Include \"b.pbrt\"");
    write("parts/b.pbrt", "Shape \"of the part\"");
    write("b.pbrt", "Shape \"of the whole\" \"string filename\" \"m.ply\"");
    write("m.ply", "");
    write("parts/m.ply", "");
    const Description d = parse("WorldBegin Include \"parts/a.pbrt\"");
    ASSERT_EQ(d.shapes.size(), 1u);
    EXPECT_EQ(d.shapes[0].type, "of the whole");
    EXPECT_EQ(find_file("m.ply", d.shapes[0].parameters.place_of("filename"), d.base_directory), directory_ / "m.ply");
}

TEST_F(PbrtInclude, ReadsGzipWhateverTheName) {
    write_gzip("a.pbrt", "Shape \"a\"");
    EXPECT_EQ(parse("WorldBegin Include \"a.pbrt\"").shapes.size(), 1u);
}

TEST_F(PbrtInclude, BrokenGzipIsAnError) {
    write_gzip("a.pbrt", std::string(100'000, ' ') + "Shape \"a\"");
    std::filesystem::resize_file(directory_ / "a.pbrt", 60);
    EXPECT_PRED2(contains, error_of("WorldBegin\nInclude \"a.pbrt\""), "main.pbrt:2:1: error: cannot read");
}

TEST_F(PbrtInclude, ImportKeepsTheStateOutside) {
    write("a.pbrt",
          "Translate 1 0 0 Material \"conductor\" CoordinateSystem \"inside\" Shape \"a\" "
          "MakeNamedMaterial \"shared\" \"string type\" \"diffuse\"");
    const Description d =
        parse("WorldBegin Translate 0 1 0 Import \"a.pbrt\" Shape \"b\" NamedMaterial \"shared\" Shape \"c\"");
    EXPECT_EQ(d.shapes[0].world_from_object, Transform::translate(1, 1, 0));
    EXPECT_EQ(d.shapes[1].world_from_object, Transform::translate(0, 1, 0));
    EXPECT_EQ(d.shapes[1].material, 0u);
    EXPECT_EQ(d.materials[d.shapes[2].material].name, "shared");
    const Description outside = parse("WorldBegin Import \"a.pbrt\" CoordSysTransform \"inside\" Shape \"b\"");
    EXPECT_EQ(outside.shapes[1].world_from_object, Transform());
    ASSERT_EQ(outside.warnings.size(), 1u);
    EXPECT_PRED2(contains, outside.warnings[0], "\"inside\" is not defined");
}

TEST_F(PbrtInclude, ImportedBlocksStayWithinTheirFile) {
    write("open.pbrt", "AttributeBegin");
    write("close.pbrt", "AttributeEnd");
    EXPECT_PRED2(contains, error_of("WorldBegin Import \"open.pbrt\""), "the end of the imported file, but");
    const Description closed =
        parse("WorldBegin AttributeBegin Translate 1 0 0 Import \"close.pbrt\" Shape \"a\" AttributeEnd Shape \"b\"");
    EXPECT_EQ(closed.shapes[0].world_from_object, Transform::translate(1, 0, 0));
    EXPECT_EQ(closed.shapes[1].world_from_object, Transform());
    ASSERT_EQ(closed.warnings.size(), 1u);
    EXPECT_PRED2(contains, closed.warnings[0], "AttributeEnd without AttributeBegin");
    EXPECT_EQ(parse("WorldBegin Include \"open.pbrt\" Include \"close.pbrt\" Shape \"a\"").shapes.size(), 1u);
}

TEST_F(PbrtInclude, MissingFilesAreErrors) {
    EXPECT_EQ(error_of("WorldBegin\n  Include \"none.pbrt\""),
              path("main.pbrt") + ":2:3: error: cannot read \"" + path("none.pbrt") + "\": No such file or directory");
    EXPECT_THROW(parse_file(directory_ / "none.pbrt"), InputError);
    EXPECT_THROW(parse_file(directory_), InputError);
}

TEST_F(PbrtInclude, PipesAreRefused) {
    // Reading one that nobody writes to would wait for ever.
    ASSERT_EQ(mkfifo(path("pipe.pbrt").c_str(), 0600), 0);
    EXPECT_EQ(error_of("WorldBegin\n  Include \"pipe.pbrt\""),
              path("main.pbrt") + ":2:3: error: \"" + path("pipe.pbrt") + "\" is a pipe, which may never end");
}

TEST_F(PbrtInclude, CyclesAreErrorsNamingBothPlaces) {
    write("a.pbrt", "\nInclude \"b.pbrt\"");
    write("b.pbrt", "Import \"../" + directory_.filename().string() + "/a.pbrt\"");
    const std::string message = error_of("WorldBegin\nInclude \"a.pbrt\"");
    EXPECT_PRED2(contains, message, path("b.pbrt") + ":1:1: error: ");
    EXPECT_PRED2(contains, message, "includes itself: it was opened at " + path("main.pbrt") + ":2:1");
    EXPECT_PRED2(contains, error_of("Include \"main.pbrt\""), "includes itself: it is the main file");
}

TEST_F(PbrtInclude, DeepNestingIsAnError) {
    for (int i = 0; i < 100; ++i) {
        write(std::to_string(i) + ".pbrt", "Include \"" + std::to_string(i + 1) + ".pbrt\"");
    }
    EXPECT_PRED2(contains, error_of("Include \"0.pbrt\""), "included more than 64 deep");
}

TEST_F(PbrtInclude, AFileMayNotEndWithinADirective) {
    write("a.pbrt", "Shape \"a\" \"float x\" [ 1");
    EXPECT_PRED2(contains, error_of("WorldBegin Include \"a.pbrt\" 2 ]"),
                 "a.pbrt:1:24: error: expected a number, found the end of the file");
}

TEST_F(PbrtInclude, CanBeForbidden) {
    write("a.pbrt", "");
    EXPECT_THROW(parse_string("WorldBegin Include \"a.pbrt\"", directory_, "t.pbrt", {.allow_includes = false}),
                 InputError);
    EXPECT_NO_THROW(parse_string("WorldBegin Include \"a.pbrt\"", directory_, "t.pbrt"));
}

}  // namespace
}  // namespace wend::pbrt
