// wend render --save-field, --load-field and wend field.
#include "program_support.h"

#include <wend/io/image_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

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

TEST_F(FieldCommand, OfAChangedSceneTheFieldsAreTakenAndTheNotesAreNot) {
    const std::string field = folder_.file("room.field");
    ASSERT_EQ(render({"--spp", "31", "--save-field", field}).status, 0);
    const auto go_on = [&](const std::string& from) {
        const auto result = run_wend(
            {"render", scene_, "-o", folder_.file("on.exr"), "--spp", "3", "--seed", "5", "--load-field", from});
        EXPECT_EQ(result.status, 0) << result.err;
        return result.err;
    };
    const auto pixels = [&] {
        const std::vector<Rgb> all = read_picture(folder_.file("on.exr")).image.pixels;
        return std::string(reinterpret_cast<const char*>(all.data()), all.size() * sizeof(Rgb));
    };
    const std::string sentence = "room.field: was learned in another scene, or before this one changed";
    EXPECT_EQ(go_on(field).find(sentence), std::string::npos);
    const std::string taught = pixels();
    // Another text, and nothing else that the notes could be told by.
    folder_.write("room.pbrt", test::small_scene() + "\n# A word more.\n");
    EXPECT_NE(go_on(field).find(sentence), std::string::npos);
    const std::string changed = pixels();

    // Files without the scene's digest, and without notes: as earlier versions wrote them.
    const std::string bytes = test::read_text(field);
    const std::size_t notes = bytes.find("WENDNOTE\x1a") - sizeof(std::uint64_t),
                      scene = bytes.find("WENDSCENE\x1a") - sizeof(std::uint64_t);
    const std::string unplaced = folder_.write("unplaced.field", std::string_view(bytes).substr(0, scene));
    const std::string oldest = folder_.write("oldest.field", std::string_view(bytes).substr(0, notes));
    go_on(oldest);
    EXPECT_TRUE(pixels() == changed) << "the same fields, and no notes";
    folder_.write("room.pbrt", test::small_scene());
    go_on(unplaced);
    EXPECT_TRUE(pixels() == taught) << "notes of a scene that is not known are taken";
    EXPECT_FALSE(changed == taught);
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

TEST_F(FieldCommand, FollowsAPixelToItsSurface) {
    ASSERT_EQ(
        render({"--spp", "31", "--sampling", "distance+direction", "--save-field", folder_.file("room.field")}).status,
        0);
    const auto result = run_wend({"field", folder_.file("room.field"), "--scene", scene_, "--pixel", "8,9", "--page",
                                  folder_.file("lobes.html"), "-o", folder_.file("lobes.exr"), "--json", "-"});
    ASSERT_EQ(result.status, 0) << result.err;
    const auto pixel = result.json()["pixel"];
    const double length = pixel["length"];
    // The fog's extinction is 0.56, 0.46 and 0.36.
    const double passes = (std::exp(-0.56 * length) + std::exp(-0.46 * length) + std::exp(-0.36 * length)) / 3;
    EXPECT_NEAR(pixel["scatters"].get<double>(), 1 - passes, 1e-4);
    double collides = 0;
    for (const auto& piece : pixel["pieces"]) {
        collides += piece["collides"].get<double>();
    }
    EXPECT_NEAR(collides, 1 - passes, 1e-4);
    EXPECT_GT(pixel["guided_scatters"], 0);
    EXPECT_LT(pixel["guided_scatters"], 1);
    double distance = 0;
    for (const auto& stop : pixel["stops"]) {
        EXPECT_GT(stop["distance"], distance);
        distance = stop["distance"];
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(stop["position"][axis].get<double>(),
                        pixel["origin"][axis].get<double>() + distance * pixel["direction"][axis].get<double>(), 1e-4);
        }
    }
    EXPECT_EQ(distance, length);
    EXPECT_EQ(pixel["stops"].back()["part"], "surface");
    EXPECT_EQ(pixel["stops"][0]["part"], "volume");
    EXPECT_EQ(read_picture(folder_.file("lobes.exr")).layers.size(), pixel["stops"].size() - 1);
}

TEST_F(FieldCommand, ThePageHoldsEveryPlaceAndNeedsNothingElse) {
    save_field();
    ASSERT_EQ(
        run_wend({"field", folder_.file("room.field"), "--at", "0,0.5,0", "--page", folder_.file("at.html")}).status,
        0);
    const std::string page = test::read_text(folder_.file("at.html"));
    EXPECT_EQ(page.find("http"), std::string::npos);
    EXPECT_NE(page.find("data-section=\"0\""), std::string::npos);
    const std::size_t begin = page.find("id=\"data\">") + 10;
    const auto data = nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
    ASSERT_EQ(data["places"].size(), 1u);
    const auto& lobes = data["places"][0]["lobes"];
    ASSERT_FALSE(lobes.empty());
    EXPECT_NE(page.find("data-lobe=\"" + std::to_string(lobes.size() - 1) + "\""), std::string::npos);
    EXPECT_LT(data["low"], data["high"]);
    EXPECT_FALSE(std::filesystem::exists("field.png")) << "a page alone was asked for";
}

TEST_F(FieldCommand, SaysThatAPlaceIsOutsideOfTheField) {
    save_field();
    const auto show = [&](const std::string& at) {
        return run_wend({"field", folder_.file("room.field"), "--at", at, "-o", folder_.file("at.png")});
    };
    EXPECT_EQ(show("0,0.5,0").out.find("outside"), std::string::npos);
    const auto far = show("0,0.5,1000");
    EXPECT_EQ(far.status, 0);
    EXPECT_NE(far.out.find(" outside of the volume field, which reaches from "), std::string::npos) << far.out;
    const auto json = run_wend({"field", folder_.file("room.field"), "--at", "0,0.5,1000", "-o", folder_.file("at.png"),
                                "--json", "-"})
                          .json();
    EXPECT_NEAR(json["at"]["outside"].get<double>(), 1000 - json["fields"]["volume"]["bounds"][1][2].get<double>(),
                1e-3);
}

TEST_F(FieldCommand, ReplacesNoPictureThatNobodyNamed) {
    save_field();
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder_.path());
    folder_.write("field.png", "mine");
    const auto refused = run_wend({"field", "room.field", "--at", "0,0.5,0"});
    const std::string kept = test::read_text("field.png");
    const auto forced = run_wend({"field", "room.field", "--at", "0,0.5,0", "--force"});
    const std::string replaced = test::read_text("field.png");
    std::filesystem::current_path(before);
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("field.png: error: is there already"), std::string::npos) << refused.err;
    EXPECT_EQ(kept, "mine");
    EXPECT_EQ(forced.status, 0) << forced.err;
    EXPECT_NE(replaced, "mine");
}

TEST_F(FieldCommand, RefusesPixelsThatThereAreNot) {
    save_field();
    const auto show = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"field", folder_.file("room.field"), "-o", folder_.file("x.png")});
        return run_wend(more);
    };
    for (const char* pixel : {"16,0", "0,12", "-1,0", "1", "1,2,3", "a,b", "99999999999,1", "1.5,2"}) {
        const auto result = show({"--scene", scene_, "--pixel", pixel});
        EXPECT_EQ(result.status, 2) << pixel;
        EXPECT_NE(result.err.find(std::string("--pixel ") + pixel), std::string::npos) << result.err;
    }
    EXPECT_EQ(show({"--pixel", "1,1"}).status, 2) << "of which scene?";
    EXPECT_EQ(show({"--scene", scene_, "--pixel", "1,1", "--at", "0,0,0"}).status, 2);
    EXPECT_EQ(show({}).status, 2) << "a picture of which place?";
    EXPECT_EQ(show({"--scene", scene_, "--pixel", "31,23", "--resolution", "32x24"}).status, 0);
}

}  // namespace
}  // namespace wend
