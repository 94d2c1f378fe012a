// How gains are distributed over scenes, and the page that shows it.
#include <tests/support/text.h>

#include <wend/app/gains.h>
#include <wend/app/gains_plot.h>
#include <wend/app/scenes_page.h>
#include <wend/app/text_table.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace wend {
namespace {

using test::count;

ComparisonRow row(const std::string& preset, std::optional<double> ratio) {
    ComparisonRow row;
    row.way.preset = parse_preset(preset);
    row.ratio = ratio;
    for (const double factor : {0.5, 2.0}) {
        row.runs.emplace_back().ratio = factor * ratio.value_or(1);
    }
    return row;
}

Comparison scene(const std::string& name, double direction, double full) {
    Comparison comparison;
    comparison.scene = name;
    comparison.settings = {{"threads", 0}, {"version", "0"}};
    comparison.rows = {row("classical", 1), row("direction", direction), row("full", full)};
    return comparison;
}

std::vector<Comparison> two_scenes() {
    return {scene("a.pbrt", 2, 8), scene("<b>.pbrt", 0.5, -1), scene("c.pbrt", 4, 2)};
}

TEST(Gains, AreSummedUpByLogarithmsTheWorstFirst) {
    const auto gains = gain_distributions(two_scenes());
    ASSERT_EQ(gains.size(), 2u) << "none for classical sampling";
    EXPECT_EQ(gains[0].sampling, "direction");
    EXPECT_NEAR(gains[0].geometric_mean, std::cbrt(4.0), 1e-12);
    EXPECT_EQ(gains[0].min, 0.5);
    EXPECT_EQ(gains[0].median, 2);
    EXPECT_EQ(gains[0].max, 4);
    EXPECT_NEAR(gains[0].p25, 1.25, 1e-12);
    EXPECT_EQ(gains[0].losses, 1u);
    EXPECT_EQ(gains[0].scenes[0].scene, 1u);
    EXPECT_EQ(gains[0].scenes[2].scene, 2u);
    // The logarithms are ln 2 times 1, -1, 2: their variance is 7/3 (ln 2)².
    EXPECT_NEAR(std::log(gains[0].error_factor), std::log(2.0) * std::sqrt(7.0 / 9), 1e-12);
}

TEST(Gains, OfWhatHasNoneAreNotMadeUp) {
    const auto gains = gain_distributions(two_scenes());
    EXPECT_EQ(gains[1].scenes.size(), 2u);
    EXPECT_EQ(gains[1].unknown, std::vector<std::size_t>{1}) << "an error below 0 has no gain";
    EXPECT_NEAR(gains[1].geometric_mean, 4, 1e-12);
    const auto json = gains_json(gains, two_scenes());
    EXPECT_EQ(json[1]["unknown"][0], "<b>.pbrt");
    EXPECT_EQ(json[0]["scenes"][0]["min"], 0.25);
    const auto lone = gain_distributions(std::vector{scene("a", 2, 2)});
    EXPECT_TRUE(std::isnan(lone[0].error_factor));
    EXPECT_TRUE(gain_distributions(std::vector<Comparison>{}).empty());
}

TEST(Gains, ThePlotHasADotThatLeadsToEachScene) {
    const std::vector<Comparison> scenes = two_scenes();
    const std::string svg = gains_svg(gain_distributions(scenes), scenes);
    EXPECT_EQ(count(svg, "<circle"), 5u);
    EXPECT_EQ(count(svg, "class=\"loss\""), 1u);
    EXPECT_EQ(count(svg, "href=\"#scene-1\""), 1u);
    EXPECT_EQ(count(svg, "<title>&lt;b&gt;.pbrt: 0.5×, 0.25 to 1 by seed</title>"), 1u);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(ScenesPage, ShowsEverySceneTheWorstFirst) {
    const std::vector<Comparison> scenes = two_scenes();
    const std::vector<std::string> thumbnails(3, "png");
    const std::vector<FailedScene> failed = {{"d.pbrt", "no <camera>"}};
    const std::string page =
        scenes_page({scenes, thumbnails, {"a/index.html", "b/index.html", "c/index.html"}, failed, 5});
    for (const char* part : {"id=\"scene-0\"", "id=\"scene-1\"", "id=\"scene-2\"", "href=\"b/index.html\"",
                             "alt=\"Reference of &lt;b&gt;.pbrt\"", "<b>d.pbrt</b>: no &lt;camera&gt;",
                             "4 of 5 scenes so far", "<h2>Worst first</h2>"}) {
        EXPECT_NE(page.find(part), std::string::npos) << part;
    }
    EXPECT_EQ(page.find("<b>.pbrt"), std::string::npos) << "names are escaped";
    const std::size_t cases = page.find("<h2>Worst first</h2>");
    const std::size_t worst = page.find("<a href=\"#scene-1\">", cases), best = page.find("8×", cases);
    ASSERT_NE(best, std::string::npos);
    EXPECT_LT(worst, best);
    EXPECT_EQ(count(page, "http"), count(page, "xmlns=\"http://www.w3.org/2000/svg\""));
}

TEST(Csv, QuotesWhatWouldBeTakenForSomethingElse) {
    EXPECT_EQ(csv_text({{"a", "b,c"}, {"say \"x\"", "two\nlines"}}), "a,\"b,c\"\n\"say \"\"x\"\"\",\"two\nlines\"\n");
}

}  // namespace
}  // namespace wend
