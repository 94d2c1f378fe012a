// wend render --save-field, --load-field and wend field.
#include "program_support.h"

#include <wend/io/image_file.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace wend {
namespace {

using test::run_wend;

class FieldCommand : public testing::Test {
protected:
    FieldCommand() : scene_(folder_.write("room.pbrt", test::small_scene())) {}

    test::ProgramResult render(std::vector<std::string> more) const {
        more.insert(more.begin(), {"render", scene_, "--quiet", "-o", folder_.file("room.exr")});
        return run_wend(more);
    }
    void save_field() const {
        ASSERT_EQ(render({"--spp", "31", "--sampling", "direction", "--save-field", folder_.file("room.field")}).status,
                  0);
    }

    test::ScratchFolder folder_;
    std::string scene_;
};

TEST_F(FieldCommand, SummarizesWhatWasLearned) {
    save_field();
    const auto json = run_wend({"field", folder_.file("room.field"), "--json", "-"}).json();
    for (const char* key : {"cells", "lobes", "samples", "bytes", "bounds"}) {
        EXPECT_TRUE(json.contains(key)) << key;
        EXPECT_TRUE(json["fields"]["surface"].contains(key)) << key;
        EXPECT_TRUE(json["fields"]["volume"].contains(key)) << key;
    }
    EXPECT_GT(json["samples"], 100);
    EXPECT_GE(json["lobes"], json["cells"]);
}

TEST_F(FieldCommand, ShowsAPlaceAsLobesAndAsAPicture) {
    save_field();
    const std::string picture = folder_.file("at.exr"), cells = folder_.file("cells.vtk");
    const auto json =
        run_wend({"field", folder_.file("room.field"), "--at", "0,0.5,0", "-o", picture, "--vtk", cells, "--json", "-"})
            .json();
    double total = 0;
    for (const auto& lobe : json["at"]["lobes"]) {
        total += lobe["weight"].get<double>();
    }
    EXPECT_NEAR(total, 1, 1e-5);
    EXPECT_TRUE(std::filesystem::exists(picture));
    const std::string vtk = test::read_text(cells);
    EXPECT_TRUE(vtk.starts_with("# vtk DataFile Version 3.0\n"));
    EXPECT_NE(vtk.find("CELL_DATA " + std::to_string(json["cells"].get<int>())), std::string::npos);
}

TEST_F(FieldCommand, PaintsTheRecordsBelowTheLobes) {
    ASSERT_EQ(render({"--spp", "31", "--sampling", "direction", "--save-field", folder_.file("room.field"),
                      "--save-records", folder_.file("room.records")})
                  .status,
              0);
    const auto show = [&](const std::string& picture, std::vector<std::string> more) {
        more.insert(more.begin(), {"field", folder_.file("room.field"), "--at", "0,0.5,0", "-o", folder_.file(picture),
                                   "--json", "-"});
        return run_wend(more).json()["at"];
    };
    EXPECT_TRUE(show("alone.png", {})["records"].is_null());
    const auto at = show("both.png", {"--records", folder_.file("room.records")});
    EXPECT_GT(at["records"], 100);
    EXPECT_EQ(read_image(folder_.file("both.png")).height, 2 * read_image(folder_.file("alone.png")).height);
    show("both.exr", {"--records", folder_.file("room.records")});
    const Picture numbers = read_picture(folder_.file("both.exr"));
    ASSERT_EQ(numbers.layers.size(), 1u);
    EXPECT_EQ(numbers.layers[0].name, "records");
    EXPECT_GT(*std::max_element(numbers.layers[0].values.begin(), numbers.layers[0].values.end()), 0);
}

TEST_F(FieldCommand, RefusesWhatAreNoRecords) {
    save_field();
    const auto result =
        run_wend({"field", folder_.file("room.field"), "--at", "0,0,0", "--records", folder_.file("room.field")});
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.err.find("is no file of records"), std::string::npos) << result.err;
    EXPECT_EQ(run_wend({"field", folder_.file("room.field"), "--records", folder_.file("room.field")}).status, 2)
        << "records are for a place";
    EXPECT_EQ(render({"--spp", "1", "--sampling", "classical", "--save-records", folder_.file("x.records")}).status, 2);
}

TEST_F(FieldCommand, ALoadedFieldGuidesFromTheFirstSample) {
    save_field();
    const auto begin = render({"--spp", "1", "--sampling", "direction"});
    const std::string untrained = test::read_text(folder_.file("room.exr"));
    const auto again = render({"--spp", "1", "--sampling", "direction", "--load-field", folder_.file("room.field")});
    ASSERT_EQ(begin.status, 0);
    ASSERT_EQ(again.status, 0);
    EXPECT_NE(test::read_text(folder_.file("room.exr")), untrained);
}

TEST_F(FieldCommand, RefusesWhatIsNoFieldAndNamesIt) {
    save_field();
    const std::string bytes = test::read_text(folder_.file("room.field"));
    folder_.write("short.field", std::string_view(bytes).substr(0, bytes.size() / 2));
    std::string changed = bytes;
    changed[bytes.size() / 2] = static_cast<char>(changed[bytes.size() / 2] ^ 1);
    folder_.write("changed.field", changed);
    std::string older = bytes;
    // The version follows the signature of the first field.
    older[older.find("WENDFLD\x1a") + 8] = 2;
    folder_.write("older.field", older);
    EXPECT_NE(run_wend({"field", folder_.file("older.field")}).err.find("version 2 is not known"), std::string::npos);
    for (const std::string name : {"short.field", "changed.field", "older.field", "room.pbrt", "none.field"}) {
        const auto result = run_wend({"field", folder_.file(name)});
        EXPECT_EQ(result.status, 2) << name;
        EXPECT_NE(result.err.find(name), std::string::npos) << result.err;
    }
    EXPECT_EQ(run_wend({"field", folder_.file("room.field"), "--at", "1,2"}).status, 2);
    EXPECT_EQ(render({"--spp", "1", "--sampling", "classical", "--save-field", folder_.file("x.field")}).status, 2);
}

}  // namespace
}  // namespace wend
