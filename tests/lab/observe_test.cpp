// Walks that are drawn, walks that are counted, and experiments that are refused.
#include <tests/lab/experiments.h>
#include <tests/sampling/verdicts.h>
#include <wend/core/error.h>

#include <functional>
#include <vector>

namespace wend {
namespace {

using test::half_space;
using test::slab;

TEST(TracePlanar, WalksGoFromTheSurfaceToABoundary) {
    for (const std::string& sampler : planar_samplers()) {
        const PlanarExperiment e = slab(0.8, 3, Tally::transmittance, sampler);
        const std::vector<PlanarTrace> traces = trace_planar(e, 200, 1);
        ASSERT_EQ(traces.size(), 200u);
        for (const PlanarTrace& trace : traces) {
            ASSERT_GE(trace.vertices.size(), 2u);
            EXPECT_EQ(trace.vertices.front().depth, 0);
            for (const PlanarTrace::Vertex& v : trace.vertices) {
                EXPECT_TRUE(v.depth >= 0 && v.depth <= 3 && std::isfinite(v.lateral));
            }
            // What brings something went out on the lit side.
            EXPECT_TRUE(trace.value == 0 || trace.vertices.back().depth == 3) << sampler;
        }
    }
}

TEST(TracePlanar, GuidedWalksAreShortAndBringTheSame) {
    std::size_t lost = 0, guided = 0;
    for (const PlanarTrace& trace : trace_planar(half_space(0.95, "classical"), 300, 1)) {
        lost += trace.vertices.size();
    }
    const double exact = planar_exact(half_space(0.95, "modes"))[0];
    for (const PlanarTrace& trace : trace_planar(half_space(0.95, "modes"), 300, 1)) {
        guided += trace.vertices.size();
        EXPECT_NEAR(trace.value, exact, 1e-2 * exact);
    }
    EXPECT_LT(2 * guided, lost);
}

TEST(TracePlanar, SameSeedSameWalks) {
    const PlanarExperiment e = half_space(0.8, "modes");
    const std::vector<PlanarTrace> a = trace_planar(e, 3, 5), b = trace_planar(e, 3, 5), c = trace_planar(e, 3, 6);
    EXPECT_EQ(a[2].value, b[2].value);
    EXPECT_NE(a[0].vertices[1].depth, c[0].vertices[1].depth);
}

/// p-value of densities over bins from so many samples, of which some lie outside unless the bins are `complete`.
double fit(const std::vector<double>& edges, const std::vector<double>& found, const std::vector<double>& exact,
           double samples, bool complete) {
    std::vector<std::uint64_t> counts;
    std::vector<double> expected;
    double counted = 0, inside = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const double width = edges[i + 1] - edges[i];
        counts.push_back(static_cast<std::uint64_t>(std::llround(samples * found[i] * width)));
        expected.push_back(samples * exact[i] * width);
        counted += static_cast<double>(counts.back());
        inside += expected.back();
    }
    if (!complete) {
        counts.push_back(static_cast<std::uint64_t>(std::llround(samples - counted)));
        expected.push_back(samples - inside);
    }
    return chi_square_test(counts, expected).p_value;
}

TEST(HistogramPlanar, ModesFollowTheExactDensitiesAndClassicalWalksDoNot) {
    PlanarRun run;
    run.walks = 100000;
    run.threads = 1;
    for (const PlanarExperiment& medium : {half_space(0.8, ""), slab(0.8, 3, Tally::transmittance, "")}) {
        for (const bool guided : {true, false}) {
            PlanarExperiment e = medium;
            e.sampler = guided ? "modes" : "classical";
            const PlanarHistogram h = histogram_planar(e, run);
            const double depth =
                fit(h.depth_edges, h.depth_density, h.depth_exact, static_cast<double>(run.walks), false);
            // Of the directions only those after collisions in a range of depths.
            double selected = 0;
            for (std::size_t i = 0; i < h.depth_exact.size(); ++i) {
                const double width =
                    std::min(h.depth_edges[i + 1], h.depth_end) - std::max(h.depth_edges[i], h.depth_begin);
                selected += std::max(width, 0.0) * h.depth_density[i] * static_cast<double>(run.walks);
            }
            const double cosine = fit(h.cosine_edges, h.cosine_density, h.cosine_exact, std::round(selected), true);
            if (guided) {
                EXPECT_GT(depth, test::passing);
                EXPECT_GT(cosine, test::passing);
            } else {
                EXPECT_LT(depth, test::failing);
                EXPECT_LT(cosine, test::failing);
            }
        }
    }
}

TEST(HistogramPlanar, DoesNotDependOnThreads) {
    PlanarRun one, three;
    one.walks = three.walks = 20000;
    one.threads = 1;
    three.threads = 3;
    const PlanarExperiment e = half_space(0.8, "modes");
    EXPECT_EQ(histogram_planar(e, one).depth_density, histogram_planar(e, three).depth_density);
}

struct Refusal {
    const char* word;
    std::function<void(PlanarExperiment&)> spoil;
};

TEST(PlanarLab, RefusesWhatItCannotDoWithTheRange) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Refusal refusals[] = {
        {"[0, 1]", [](auto& e) { e.albedo = {1.1}; }},
        {"[0, 1]", [=](auto& e) { e.albedo = {nan}; }},
        {"three",
         [](auto& e) {
             e.albedo = {0.5, 0.5};
         }},
        {"as many",
         [](auto& e) {
             e.extinction = {1, 2, 3};
         }},
        {"extinction", [](auto& e) { e.extinction = {0}; }},
        {"[-0.95, 0.95]", [](auto& e) { e.g = 0.96; }},
        {"[-0.95, 0.95]", [=](auto& e) { e.g = nan; }},
        {"[1, 3]", [](auto& e) { e.ior = 0.9; }},
        {"roughness", [](auto& e) { e.roughness = 2; }},
        {"matched", [](auto& e) { e.roughness = 0.3; }},
        {"thickness", [](auto& e) { e.thickness = 0; }},
        {"thickness", [](auto& e) { e.thickness = 1e9; }},
        {"thickness", [=](auto& e) { e.thickness = nan; }},
        {"reflectance", [](auto& e) { e.tally = Tally::transmittance; }},
        {"(0, 1]", [](auto& e) { e.mu0 = 0; }},
        {"(0, 1]", [=](auto& e) { e.mu0 = nan; }},
        {"[0, 1)", [](auto& e) { e.stretch = 1; }},
        {"1 or 2", [](auto& e) { e.exponentials = 3; }},
        {"[0, 71]", [](auto& e) { e.modes = 72; }},
        {"guide albedo", [](auto& e) { e.guide_albedo = -0.1; }},
        {"1 to 72", [](auto& e) { e.adjoint = PlanarModes(); }},
        {"longest first",
         [](auto& e) {
             e.adjoint = PlanarModes{{{1, 1, 0, {1}}, {2, 1, 0, {1}}}};
         }},
        {"every direction",
         [](auto& e) {
             e.adjoint = PlanarModes{{{1, 1, 0, {0.5, 1}}}};
         }},
        {"every direction",
         [](auto& e) {
             e.adjoint = PlanarModes{{{1, -1, 0, {1}}}};
         }},
        {"grows",
         [](auto& e) {
             e.adjoint = PlanarModes{{{1, 1, 1, {1}}}};
         }},
        {"coefficients",
         [](auto& e) {
             e.adjoint = PlanarModes{{{1, 1, 0, {}}}};
         }},
        {"finite",
         [=](auto& e) {
             e.adjoint = PlanarModes{{{1, nan, 0, {1}}}};
         }},
        {"length",
         [=](auto& e) {
             e.adjoint = PlanarModes{{{nan, 1, 0, {1}}}};
         }},
        {"alone",
         [](auto& e) {
             e.adjoint = PlanarModes{{{1, 1, 0, {1}}}}, e.sampler = "boundary";
         }},
        {"one channel",
         [](auto& e) {
             e.adjoint = PlanarModes{{{1, 1, 0, {1}}}}, e.albedo = {0.5, 0.5, 0.5};
         }},
        {"analog classical", [](auto& e) { e.sampler = "perfect"; }},
        {"analog",
         [](auto& e) {
             e.albedo = {0.5, 0.5, 0.5}, e.sampler = "analog";
         }},
        {"window",
         [](auto& e) {
             e.albedo = {0.5, 0.5, 0.5}, e.window = PlanarWindow::adjoint;
         }},
        {"guide",
         [](auto& e) {
             e.albedo = {0.5, 0.5, 0.5}, e.guide_albedo = 0.5;
         }},
    };
    for (const Refusal& refusal : refusals) {
        PlanarExperiment e = half_space(0.8, "modes");
        refusal.spoil(e);
        try {
            test::run(e, 10);
            ADD_FAILURE() << "was accepted: " << refusal.word;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(refusal.word), std::string::npos) << error.what();
        }
    }
    EXPECT_NO_THROW(test::run(half_space(0.8, "modes"), 10));
}

}  // namespace
}  // namespace wend
