// Plots are well-formed pictures that show every point where its value belongs, and nothing that cannot be shown.
#include <tests/support/text.h>

#include "xml_support.h"

#include <wend/app/convergence_plot.h>
#include <wend/app/plot.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>
#include <string>

namespace wend {
namespace {

using test::count;
using test::xml_problem;

/// A plot of one series without a legend.
Plot plot_of(std::vector<PlotPoint> points, PlotAxis x = {"length, m"}, PlotAxis y = {"time, s"}) {
    PlotPanel panel;
    panel.x = std::move(x);
    panel.y = std::move(y);
    panel.series = {{"", std::move(points)}};
    return {"a test", {std::move(panel)}};
}

std::vector<double> centres(const std::string& svg, const std::string& attribute) {
    const std::regex circle(" " + attribute + "=\"([0-9.-]+)\"");
    std::vector<double> values;
    for (std::sregex_iterator match(svg.begin(), svg.end(), circle), end; match != end; ++match) {
        values.push_back(std::stod((*match)[1]));
    }
    return values;
}

TEST(XmlProblem, FindsWhatIsNotWellFormed) {
    EXPECT_EQ(xml_problem("<a b=\"1\"><c/>text &amp; more</a>\n"), "");
    for (const char* bad :
         {"<a>", "<a></b>", "<a b=1/>", "<a/><a/>", "<a>1 < 2</a>", "<a>you & me</a>", "", "<a b=\"</a>"}) {
        EXPECT_NE(xml_problem(bad), "") << bad;
    }
}

TEST(Plot, IsWellFormedWhateverItsTextsSay) {
    Plot plot = plot_of({{0, 1}, {2, 3}}, {"<length> & \"more\""}, {"it's"});
    plot.description = "a < b & \"c\"";
    plot.panels.front().title = "<&>";
    plot.panels.front().series.front().name = "a & b";
    plot.panels.push_back(plot.panels.front());
    plot.panels.back().x.ticks = {{1, "<one>"}};
    const std::string svg = plot_svg(plot);
    EXPECT_EQ(xml_problem(svg), "");
    EXPECT_EQ(count(svg, "a &amp; b</text>"), 1u) << "panels share one legend";
    EXPECT_EQ(count(svg, "&lt;&amp;&gt;</text>"), 2u);
    EXPECT_EQ(xml_problem(convergence_svg({{"a & b", {{1, 2}, {3, 4}}}})), "");
}

TEST(Plot, LinearAxesSpaceEqualStepsEvenly) {
    const std::string svg = plot_svg(plot_of({{-1, 5}, {0, 6}, {1, 7}}));
    const std::vector<double> x = centres(svg, "cx"), y = centres(svg, "cy");
    ASSERT_EQ(x.size(), 3u);
    EXPECT_GT(x[1] - x[0], 100);
    EXPECT_NEAR(x[2] - x[1], x[1] - x[0], 0.11);
    EXPECT_LT(y[1], y[0]) << "larger values are higher";
    EXPECT_NEAR(y[2] - y[1], y[1] - y[0], 0.11);
    for (const char* tick : {">-1</text>", ">-0.5</text>", ">0</text>", ">1</text>", ">5</text>", ">6.5</text>"}) {
        EXPECT_EQ(count(svg, tick), 1u) << tick;
    }
}

TEST(Plot, DownwardAxesGrowDownward) {
    PlotAxis depth{"depth, m"};
    depth.downward = true;
    const std::vector<double> y = centres(plot_svg(plot_of({{0, 0}, {0, 1}}, {"x"}, depth)), "cy");
    ASSERT_EQ(y.size(), 2u);
    EXPECT_GT(y[1], y[0] + 100);
}

TEST(Plot, GivenEndsAreTheEndsOfTheAxis) {
    PlotAxis fixed{"x"};
    fixed.low = 0;
    fixed.high = 1;
    const std::vector<double> x = centres(plot_svg(plot_of({{0, 0}, {1, 1}}, fixed)), "cx");
    ASSERT_EQ(x.size(), 2u);
    EXPECT_NEAR(x[1] - x[0], PlotPanel{}.width, 0.11);
    const std::vector<double> wider = centres(plot_svg(plot_of({{0, 0}, {2, 1}}, fixed)), "cx");
    EXPECT_LT(wider[1] - wider[0], PlotPanel{}.width) << "data beyond an end widen the axis";
}

TEST(Plot, GivenTicksReplaceRoundNumbers) {
    PlotAxis named{"sampler"};
    named.ticks = {{1, "one"}, {2, "two"}};
    const std::string svg = plot_svg(plot_of({{1, 1}, {2, 1}}, named));
    EXPECT_EQ(count(svg, ">one</text>"), 1u);
    EXPECT_EQ(count(svg, ">two</text>"), 1u);
    EXPECT_EQ(count(svg, ">1.5</text>"), 0u);
}

TEST(Plot, SaysWhereThereIsNothingToPlot) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const std::vector<PlotPoint>& points :
         {std::vector<PlotPoint>{}, {{infinity, 1}}, {{1, infinity - infinity}}}) {
        const std::string svg = plot_svg(plot_of(points));
        EXPECT_EQ(xml_problem(svg), "");
        EXPECT_EQ(count(svg, "nothing to plot"), 1u);
    }
    EXPECT_EQ(xml_problem(plot_svg({})), "") << "no panel at all";
}

TEST(Plot, BreaksLinesWhereAPointCannotBeShown) {
    PlotAxis logarithmic{"variance", PlotAxis::Scale::logarithmic};
    const std::string svg = plot_svg(plot_of({{0, 1}, {1, 10}, {2, 0}, {3, 10}, {4, -1}}, {"x"}, logarithmic));
    EXPECT_EQ(count(svg, "<polyline"), 2u);
    EXPECT_EQ(count(svg, "<circle"), 3u);
    EXPECT_EQ(count(svg, "nan") + count(svg, "inf"), 0u);
}

TEST(Plot, NumbersNearTheEndOfTheirRangeDoNoHarm) {
    for (const std::vector<PlotPoint>& points : {std::vector<PlotPoint>{{-1e300, 1}, {1e300, 2}},
                                                 {{1e308, 1}, {0, 1}},
                                                 {{1, 1}},
                                                 {{1e300, 1}},
                                                 {{1, 1}, {1 + 1e-15, 1}},
                                                 {{0, 0}},
                                                 {{1e-310, 1}, {2e-310, 1}}}) {
        const std::string svg = plot_svg(plot_of(points));
        EXPECT_EQ(xml_problem(svg), "");
        EXPECT_EQ(count(svg, "nan") + count(svg, "inf"), 0u);
        EXPECT_LE(count(svg, "class=\"grid\""), 40u);
    }
}

TEST(Plot, HistogramsAreOutlined) {
    const std::vector<PlotPoint> corners = histogram_outline({0, 1, 3}, {5, 2});
    ASSERT_EQ(corners.size(), 4u);
    EXPECT_EQ(corners[1].x, 1);
    EXPECT_EQ(corners[1].y, 5);
    EXPECT_EQ(corners[2].x, 1);
    EXPECT_EQ(corners[2].y, 2);
    EXPECT_EQ(corners[3].x, 3);
    EXPECT_TRUE(histogram_outline({}, {}).empty());
}

}  // namespace
}  // namespace wend
