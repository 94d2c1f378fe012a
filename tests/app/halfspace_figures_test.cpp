// The pictures and tables of the half-space experiment, from data made up here.
#include <tests/support/text.h>

#include "xml_support.h"

#include <wend/app/halfspace_figures.h>
#include <wend/app/halfspace_table.h>
#include <wend/app/planar_report.h>
#include <wend/app/text_table.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace wend {
namespace {

using test::contains;
using test::xml_problem;

/// Two values around 0.25 with this variance.
HalfspaceRow row(double albedo, const std::string& sampler, int modes, double variance) {
    HalfspaceRow r;
    r.experiment.albedo = {albedo};
    r.experiment.sampler = sampler;
    r.experiment.modes = modes;
    Moments moments;
    moments.add(0.25 - std::sqrt(variance / 2));
    moments.add(0.25 + std::sqrt(variance / 2));
    r.result.channels = {moments};
    r.result.exact = {0.25};
    r.result.seconds = 2;
    return r;
}

std::vector<HalfspaceRow> some_rows() {
    std::vector<HalfspaceRow> rows;
    for (const double albedo : {0.4, 0.8}) {
        rows.push_back(row(albedo, "classical", 8, 0.1));
        for (const int modes : {2, 8, 32}) {
            rows.push_back(row(albedo, "modes", modes, std::pow(10, -modes)));
        }
    }
    return rows;
}

TEST(HalfspaceFigures, AreWellFormedWithLabelledAxes) {
    PlanarHistogram histogram{{0, 1, 2}, {0.7, 0.2}, {0.6, 0.3}, {-1, 0, 1}, {0.8, 0.2}, {0.7, 0.3}, 0.5, 0.6};
    const std::string depth = depth_svg({{"classical", histogram}, {"modes", histogram}});
    const std::string direction = direction_svg({{"classical", histogram}});
    const std::string walks =
        walks_svg({{"classical", {{{{0, 0}, {0, 1}, {3, 2}}, 0}}}, {"modes", {{{{0, 0}, {0, 1}, {0.5, 0}}, 1}}}});
    const std::string variance = variance_svg(some_rows());
    for (const std::string& svg : {depth, direction, walks, variance}) {
        EXPECT_EQ(xml_problem(svg), "");
        EXPECT_FALSE(contains(svg, "nan") || contains(svg, "inf\""));
    }
    EXPECT_TRUE(contains(depth, "mean free paths</text>") && contains(depth, "per mean free path</text>"));
    EXPECT_TRUE(contains(depth, ">exact</text>") && contains(depth, ">modes</text>"));
    EXPECT_TRUE(contains(direction, "cosine"));
    EXPECT_TRUE(contains(walks, ">depth, mean free paths</text>") && contains(walks, ">surface</text>"));
    EXPECT_TRUE(contains(variance, ">albedo 0.4</text>") && contains(variance, ">albedo 0.8</text>"));
    EXPECT_TRUE(contains(variance, ">classical</text>") && contains(variance, ">32</text>"));
}

TEST(HalfspaceFigures, SurviveHavingNoData) {
    for (const std::string& svg : {depth_svg({}), direction_svg({}), walks_svg({}), walks_svg({{"none", {}}}),
                                   variance_svg({}), variance_svg({row(0.4, "modes", 8, 0)})}) {
        EXPECT_EQ(xml_problem(svg), "");
        EXPECT_FALSE(contains(svg, "nan"));
    }
}

TEST(HalfspaceTable, VariesSamplersAndAlbedosAlone) {
    PlanarExperiment base;
    base.g = 0.5;
    base.mu0 = std::nullopt;
    const std::vector<PlanarExperiment> experiments = halfspace_experiments(base);
    EXPECT_EQ(experiments.size() % 5, 0u);
    for (const PlanarExperiment& e : experiments) {
        EXPECT_EQ(e.g, 0.5);
        EXPECT_FALSE(e.mu0);
        EXPECT_EQ(e.albedo.size(), 1u);
    }
    const auto analog = std::count_if(experiments.begin(), experiments.end(),
                                      [](const PlanarExperiment& e) { return e.sampler == "analog"; });
    EXPECT_EQ(analog, 5);
}

TEST(HalfspaceTable, ShowsWhatIsUnknownAsADash) {
    std::vector<HalfspaceRow> rows = {row(0.4, "classical", 8, 0.1), row(0.4, "modes", 8, 0)};
    rows[0].gain = 1;
    rows[0].closed_form = 0.1;
    rows[1].result.exact = {std::nan("")};
    const auto cells = halfspace_cells(rows);
    ASSERT_EQ(cells.size(), 3u);
    for (const auto& line : cells) {
        EXPECT_EQ(line.size(), cells.front().size());
    }
    EXPECT_EQ(std::count(cells[1].begin(), cells[1].end(), "–"), 0);
    EXPECT_EQ(std::count(cells[2].begin(), cells[2].end(), "–"), 5)
        << "exact, off by, closed form, ratio and figure of merit";
    const nlohmann::json json = halfspace_json(rows, {});
    EXPECT_EQ(json["rows"][0]["fom_ratio"], 1);
    EXPECT_EQ(json["rows"][0]["closed_form_variance"], 0.1);
    EXPECT_TRUE(json["rows"][1]["closed_form_variance"].is_null());
    EXPECT_TRUE(json["rows"][1]["fom"].is_null());
    EXPECT_TRUE(json["rows"][1]["fom_ratio"].is_null());
    EXPECT_TRUE(json["rows"][1]["exact"].is_null());
    EXPECT_EQ(json["rows"][1]["variance"], 0);
}

TEST(PlanarReport, GivesTheMeanTheDigitsThatItsErrorLeaves) {
    const auto moments = [](double mean, double half_range) {
        Moments m;
        m.add(mean - half_range);
        m.add(mean + half_range);
        return m;
    };
    EXPECT_EQ(mean_text(moments(0.123456789, 0.001)), "0.12346");
    EXPECT_EQ(mean_text(moments(1.23456789e-9, 1e-12)), "1.23457e-09");
    EXPECT_EQ(mean_text(moments(0, 1)), "0");
    EXPECT_EQ(deviation_text(moments(0.5, 0.01), 0.48), "+2.00");
    EXPECT_EQ(deviation_text(moments(0.5, 0), 0.5), "–") << "no noise to measure by";
    EXPECT_EQ(deviation_text(moments(0.5, 0.1), std::nan("")), "–");
}

TEST(TextTable, AlignsColumnsOfCharactersNotBytes) {
    EXPECT_EQ(text_table({{"a", "1"}, {"long", "± 2"}, {}, {"–", "33"}}),
              "a       1\n"
              "long  ± 2\n"
              "\n"
              "–      33\n");
    EXPECT_EQ(text_table({{"a", "b", "1"}, {"aa", "bb", "22"}}, 2),
              "a   b    1\n"
              "aa  bb  22\n");
}

}  // namespace
}  // namespace wend
