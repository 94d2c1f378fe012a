// --subsurface: its names on the command line, in messages and in what is reported.
#include "program_support.h"

#include <wend/transport/subsurface_guides.h>

#include <gtest/gtest.h>

#include <sstream>

namespace wend {
namespace {

using test::run_wend;

class SubsurfaceOption : public testing::Test {
protected:
    /// The room with a ball of wax in it, in which walks are long enough to be guided.
    SubsurfaceOption()
        : scene_(folder_.write("room.pbrt", test::small_scene(R"(
MakeNamedMedium "wax" "string type" "homogeneous" "rgb sigma_a" [ 1 2 4 ] "rgb sigma_s" [ 60 60 60 ]
MediumInterface "wax" "fog"
Translate -0.4 0.4 0.2
Material "interface"
Shape "sphere" "float radius" [ 0.4 ]
)"))) {}

    test::ProgramResult render(const std::string& subsurface) const {
        return run_wend({"render", scene_, "-o", folder_.file("room.exr"), "--sampling", "classical", "--subsurface",
                         subsurface, "--json", "-"});
    }
    test::ProgramResult compare(const std::string& subsurface) const {
        return run_wend({"compare", scene_, "--time", "0.05", "--seeds", "1", "--sampling", "classical", "--subsurface",
                         subsurface, "--json", "-"});
    }

    test::ScratchFolder folder_;
    std::string scene_;
};

/// All names, as the program lists them.
std::vector<std::string> names() {
    std::istringstream list(subsurface_names());
    std::vector<std::string> result;
    for (std::string name; list >> name;) {
        result.push_back(name.back() == ',' ? name.substr(0, name.size() - 1) : name);
    }
    return result;
}

TEST_F(SubsurfaceOption, RenderTakesEveryNameAndTellsIt) {
    ASSERT_GE(names().size(), 5u);
    for (const std::string& name : names()) {
        const auto result = render(name);
        ASSERT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(result.json()["settings"]["subsurface"], name);
        EXPECT_EQ(result.json()["rejected_samples"], 0);
        EXPECT_EQ(result.err.find("warning"), std::string::npos) << result.err;
    }
}

TEST_F(SubsurfaceOption, RenderMixesStrategiesByDefault) {
    const auto result = run_wend({"render", scene_, "-o", folder_.file("room.exr"), "--json", "-"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.json()["settings"]["subsurface"], "auto");
}

TEST_F(SubsurfaceOption, CompareTakesAListOfThem) {
    std::string list;
    for (const std::string& name : names()) {
        list += (list.empty() ? "" : ",") + name;
    }
    const auto result = compare(list);
    ASSERT_EQ(result.status, 0) << result.err;
    const nlohmann::json rows = result.json()["rows"];
    ASSERT_EQ(rows.size(), names().size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::string expected = names()[i] == "classical" ? "classical" : "classical/" + names()[i];
        EXPECT_EQ(rows[i]["sampling"], expected);
    }
}

TEST_F(SubsurfaceOption, AnUnknownNameIsAnsweredWithThoseThatThereAre) {
    for (const std::string& unknown : {std::string("dwivedy"), std::string()}) {
        for (const auto& result : {render(unknown), compare("classical," + unknown)}) {
            EXPECT_EQ(result.status, 2);
            EXPECT_NE(result.err.find("unknown subsurface sampling '" + unknown + "'"), std::string::npos)
                << result.err;
            for (const std::string& name : names()) {
                EXPECT_NE(result.err.find(name), std::string::npos) << name << ": " << result.err;
            }
        }
    }
}

TEST_F(SubsurfaceOption, GuidedWalksDrawAnotherPictureOfTheSame) {
    const auto segments = [&](const std::string& name) { return render(name).json()["segments"].get<double>(); };
    const double classical = segments("classical");
    EXPECT_EQ(segments("classical"), classical);
    EXPECT_NE(segments("dwivedi"), classical) << "the walks inside the wax are not guided";
}

}  // namespace
}  // namespace wend
