#include <tests/support/text.h>

#include <wend/app/markup.h>
#include <wend/app/report_page.h>

#include <gtest/gtest.h>

#include <limits>
#include <regex>
#include <stdexcept>
#include <string>
#include <string_view>

namespace wend {
namespace {

using test::contains;
using test::count;

/// The inverse of encode_base64, refusing anything that is not complete groups of the alphabet.
std::string decode_base64(const std::string& text) {
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    if (text.size() % 4 != 0) {
        throw std::invalid_argument("incomplete group");
    }
    std::string bytes;
    unsigned bits = 0, held = 0;
    for (const char c : text.substr(0, text.find('='))) {
        const std::size_t value = alphabet.find(c);
        if (value == std::string_view::npos) {
            throw std::invalid_argument("not in the alphabet");
        }
        bits = bits << 6 | static_cast<unsigned>(value);
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes += static_cast<char>(bits >> held & 255u);
        }
    }
    return bytes;
}

std::vector<std::string> embedded_pictures(const std::string& page) {
    const std::regex uri("src=\"data:image/png;base64,([^\"]*)\"");
    std::vector<std::string> pictures;
    for (std::sregex_iterator match(page.begin(), page.end(), uri), end; match != end; ++match) {
        pictures.push_back(decode_base64((*match)[1]));
    }
    return pictures;
}

/// Bytes that look like a PNG file and hold every value.
std::string some_png(std::size_t tail) {
    std::string bytes = "\x89PNG\r\n\x1a\n";
    for (int value = 0; value < 256; ++value) {
        bytes += static_cast<char>(value);
    }
    return bytes + std::string(tail, 'x');
}

Report example_report() {
    Report report;
    report.title = "Fog & <script>alert(1)</script>";
    report.scene = "scenes/\"quoted\".pbrt";
    report.settings = {{"seeds", "1, 2, 3"}, {"<i>", "{{rows}}"}};
    report.rows = {{"classical", "", 1024, 60, 0.5, 0.25, 7.5, 0.125, 0.3, 1.0},
                   {"distance+direction", "no <survival>", 512, 60.5, 0.0625, 0.03, 0.75, 1e-5, 0.1, 8.0},
                   {"<b>odd</b>", "", 1, 1, std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, 0, std::nullopt}};
    report.maps = {{"Error", "relative squared error", {ColourScale::Kind::logarithmic, 1e-3f, 10}},
                   {"Walk <length>", "segments & samples", {ColourScale::Kind::linear, 1, 40}}};
    report.pictures = {{"reference", "", some_png(0), {}},
                       {"classical", "1024 spp, relMSE 0.5", some_png(1), {some_png(3), some_png(5)}},
                       {"it's <full>", "<b>", some_png(2), {some_png(4), some_png(6)}}};
    report.left = 1;
    report.right = 2;
    report.convergence = {{"classical", {{1, 10}, {60, 0.5}}}, {"a < b", {{1, 2}, {60, 0.06}}}};
    return report;
}

TEST(Markup, EscapesWhatHtmlReads) {
    EXPECT_EQ(escape_markup("a<b>&\"c\"'d'"), "a&lt;b&gt;&amp;&quot;c&quot;&#39;d&#39;");
    EXPECT_EQ(escape_markup("plain · ä"), "plain · ä");
}

TEST(Markup, EncodesTheVectorsOfRfc4648) {
    EXPECT_EQ(encode_base64(""), "");
    EXPECT_EQ(encode_base64("f"), "Zg==");
    EXPECT_EQ(encode_base64("fo"), "Zm8=");
    EXPECT_EQ(encode_base64("foo"), "Zm9v");
    EXPECT_EQ(encode_base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(encode_base64("\xff\xfe\xfd"), "//79");
}

TEST(Markup, TemplateValuesAreNotSearchedAgain) {
    EXPECT_EQ(fill_template("<{{a}}|{{b}}>", {{"a", "{{b}}"}, {"b", "2"}}), "<{{b}}|2>");
    EXPECT_EQ(fill_template("open {{ end", {}), "open {{ end");
    EXPECT_THROW(fill_template("{{missing}}", {}), std::out_of_range);
}

TEST(ReportPage, ShowsEveryRowOnce) {
    const std::string page = report_page(example_report());
    EXPECT_EQ(count(page, "<th scope=\"row\">"), 3u);
    EXPECT_TRUE(contains(page,
                         "<tr><th scope=\"row\">classical</th><td>0.5</td><td class=\"ratio\">1×</td><td>60</td>"
                         "<td>1024</td><td>0.25</td><td>7.5</td><td>0.125</td><td>0.3</td></tr>"));
    EXPECT_TRUE(contains(page,
                         "<tr class=\"best\"><th scope=\"row\">distance+direction "
                         "<span class=\"role\">no &lt;survival&gt;</span></th><td>0.0625</td>"
                         "<td class=\"ratio\">8×</td><td>60.5</td><td>512</td><td>0.03</td><td>0.75</td>"
                         "<td>1.00e-05</td><td>0.1</td></tr>"));
    EXPECT_TRUE(contains(page, "<td>–</td>")) << "what is not finite shows as a dash";
    EXPECT_EQ(count(page, "class=\"best\""), 1u);
}

TEST(ReportPage, ShowsTheSpreadWhereThereAreSeveralSeeds) {
    EXPECT_FALSE(contains(report_page(example_report()), "Spread over seeds"));
    Report report = example_report();
    report.rows[0].relmse_spread = {3, 0.5, 0.4, 0.75, 0.55, 0.1};
    report.rows[0].ratio_spread = {3, 1, 1, 1, 1, 0};
    const std::string page = report_page(report);
    EXPECT_TRUE(contains(page,
                         "<tr><th scope=\"row\">classical</th><td>0.5</td><td>0.4</td><td>0.75</td><td>0.55</td>"
                         "<td>0.1</td><td>1</td><td>1</td></tr>"));
    EXPECT_EQ(count(page, "<th scope=\"row\">"), 6u);
}

TEST(ReportPage, EscapesEveryText) {
    const std::string page = report_page(example_report());
    EXPECT_EQ(count(page, "<title>Fog &amp; &lt;script&gt;alert(1)&lt;/script&gt;</title>"), 1u);
    EXPECT_EQ(count(page, "<script>"), 1u);
    EXPECT_FALSE(contains(page, "<b>odd"));
    EXPECT_FALSE(contains(page, "<full>"));
    EXPECT_TRUE(contains(page, "scenes/&quot;quoted&quot;.pbrt"));
    EXPECT_TRUE(contains(page, "alt=\"it&#39;s &lt;full&gt;\""));
    EXPECT_TRUE(contains(page, "<dt>&lt;i&gt;</dt><dd>{{rows}}</dd>"))
        << "a value is text, even one like a placeholder";
    EXPECT_TRUE(contains(page, ">a &lt; b</text>"));
}

TEST(ReportPage, EmbedsAllPicturesExactly) {
    const std::vector<std::string> pictures = embedded_pictures(report_page(example_report()));
    ASSERT_EQ(pictures.size(), 7u);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        EXPECT_EQ(pictures[i], some_png(i));
    }
}

TEST(ReportPage, NeedsNothingFromOutside) {
    const std::string page = report_page(example_report());
    EXPECT_EQ(count(page, "http"), count(page, "xmlns=\"http://www.w3.org/2000/svg\""));
    EXPECT_FALSE(contains(page, "<link"));
    EXPECT_FALSE(contains(page, "<script src"));
    EXPECT_FALSE(contains(page, "@import"));
    EXPECT_FALSE(contains(page, "url("));
}

TEST(ReportPage, OffersEveryPictureOnBothSides) {
    const std::string page = report_page(example_report());
    EXPECT_EQ(count(page, "<option "), 6u);
    EXPECT_EQ(count(page, "<option value=\"1\" selected>classical</option>"), 1u);
    EXPECT_EQ(count(page, "<option value=\"2\" selected>it&#39;s &lt;full&gt;</option>"), 1u);
}

TEST(ReportPage, ShowsThePicturesInAStripWithTheirFigures) {
    const std::string page = report_page(example_report());
    const std::string strip = page.substr(page.find("id=\"view-0\""), page.find("id=\"view-1\""));
    const std::size_t reference = strip.find("<b>reference</b>");
    const std::size_t classical = strip.find("<b>classical</b> 1024 spp, relMSE 0.5</figcaption>");
    const std::size_t full = strip.find("<b>it&#39;s &lt;full&gt;</b> &lt;b&gt;</figcaption>");
    ASSERT_NE(full, std::string::npos);
    EXPECT_LT(reference, classical);
    EXPECT_LT(classical, full);
}

TEST(ReportPage, EveryMapHasItsColoursAndAPlaceInTheSlider) {
    const std::string page = report_page(example_report());
    EXPECT_TRUE(contains(page, "relative squared error, logarithmic scale"));
    EXPECT_TRUE(contains(page, "segments &amp; samples, linear scale"));
    EXPECT_TRUE(contains(page, "<span>1</span><i></i><span>40</span>"));
    EXPECT_EQ(count(page, "name=\"view\""), 1u + 2u) << "the pictures and two maps";
    EXPECT_TRUE(contains(page, "value=\"2\"><span>Walk &lt;length&gt;</span>"));
    for (const char* section : {"id=\"view-0\"", "id=\"view-1\"", "id=\"view-2\""}) {
        EXPECT_EQ(count(page, section), 1u);
    }
    EXPECT_EQ(count(page, "<figure data-picture=\"0\">"), 1u) << "the reference has no maps";
    EXPECT_EQ(count(page, "<figure data-picture=\"1\">"), 3u);
}

TEST(ReportPage, AnEmptyReportIsStillAPage) {
    const std::string page = report_page({});
    EXPECT_TRUE(contains(page, "</html>"));
    EXPECT_TRUE(contains(page, "no positive errors to plot"));
}

TEST(ConvergencePlot, DrawsEveryPointAndNamesEverySeries) {
    const std::string svg = convergence_svg({{"one", {{1, 1}, {10, 0.1}, {100, 0.01}}}, {"two", {{1, 2}, {100, 0.1}}}});
    EXPECT_EQ(count(svg, "<polyline"), 4u) << "a curve and a legend entry each";
    EXPECT_EQ(count(svg, "<circle"), 3u + 2u);
    EXPECT_EQ(count(svg, "<rect"), 2u + 2u);
    EXPECT_TRUE(contains(svg, ">one</text>"));
    EXPECT_TRUE(contains(svg, ">two</text>"));
    EXPECT_TRUE(contains(svg, ">seconds</text>"));
    EXPECT_TRUE(contains(svg, ">relMSE</text>"));
    for (const char* tick : {">1</text>", ">10</text>", ">100</text>", ">0.1</text>", ">0.01</text>"}) {
        EXPECT_TRUE(contains(svg, tick)) << tick;
    }
}

TEST(ConvergencePlot, HasOtherAxesAndTheRendersThatAreNotNamed) {
    ConvergenceSeries series{"one", {{1, 1, 4, 100, 1}, {10, 0.1, 40, 1000, 0.1}}, {}};
    series.others = {{{1, 2, 5, 100, 1}, {9, 0.2, 45, 900, 0.1}}};
    const std::string svg = convergence_svg({series}, ConvergenceOver::samples);
    EXPECT_TRUE(contains(svg, ">samples per pixel</text>"));
    EXPECT_EQ(count(svg, "<polyline"), 3u) << "two curves and one entry of the legend";
    EXPECT_TRUE(contains(convergence_svg({series}, ConvergenceOver::work), ">1000</text>"));
}

TEST(ConvergencePlot, LogarithmicAxesSpaceDecadesEvenly) {
    const std::string svg = convergence_svg({{"s", {{1, 1}, {10, 1}, {100, 1}}}});
    const std::regex circle("cx=\"([0-9.]+)\"");
    std::vector<double> x;
    for (std::sregex_iterator match(svg.begin(), svg.end(), circle), end; match != end; ++match) {
        x.push_back(std::stod((*match)[1]));
    }
    ASSERT_GE(x.size(), 3u);
    EXPECT_GT(x[1] - x[0], 100);
    EXPECT_NEAR(x[2] - x[1], x[1] - x[0], 0.11);
}

TEST(ConvergencePlot, LeavesOutWhatALogarithmicAxisCannotShow) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::string svg =
        convergence_svg({{"s", {{1, 0.5}, {2, -0.1}, {0, 1}, {3, infinity}, {4, infinity - infinity}}}});
    EXPECT_EQ(count(svg, "<circle"), 1u + 2u);
    EXPECT_FALSE(contains(svg, "nan"));
    EXPECT_FALSE(contains(svg, "inf"));
}

TEST(ConvergencePlot, ExtremeRangesKeepAFewTicks) {
    const std::string svg = convergence_svg({{"s", {{1e-300, 1e300}, {1e300, 1e-300}}}});
    EXPECT_LE(count(svg, "class=\"grid\""), 20u);
    EXPECT_GE(count(svg, "class=\"grid\""), 8u);
}

}  // namespace
}  // namespace wend
