// Roulette and splitting inside the walk: by expected contribution, never by weight alone.
#include <tests/lab/experiments.h>
#include <wend/decision/roulette_splitting.h>
#include <wend/planar/half_space.h>

namespace wend {
namespace {

using test::half_space;
using test::is_exact;
using test::run;
using test::slab;

PlanarResult run_with(PlanarExperiment e, PlanarWindow window, std::uint64_t walks) {
    e.window = window;
    return run(e, walks);
}

TEST(WeightWindow, KeepsTheMeanOfWhatItSplitsAndEnds) {
    const WeightWindow window;
    Pcg32 random(1);
    for (const double ratio : {0.0, 1e-6, 0.01, 0.3, 0.5, 1.0, 1.6, 1.7, 3.25, 63.9, 1e6}) {
        Moments weight;
        bool inside = true;
        for (int i = 0; i < 100000; ++i) {
            const WeightWindow::Outcome outcome = window.sample(ratio, random);
            weight.add(outcome.copies / outcome.expected);
            inside = inside && outcome.copies == 1 && outcome.expected == 1;
        }
        EXPECT_TRUE(agrees(weight, 1, 4)) << ratio << ": " << weight.mean() << " +- " << weight.standard_error();
        EXPECT_EQ(inside, ratio >= window.low && ratio <= window.high) << ratio;
    }
    // The twin: roulette that forgets to raise the weight.
    Moments forgotten;
    for (int i = 0; i < 10000; ++i) {
        forgotten.add(window.sample(0.2, random).copies);
    }
    EXPECT_FALSE(agrees(forgotten, 1, 4));
}

TEST(PlanarWindow, ByTheAdjointSparesAGuide) {
    for (const double albedo : {0.4, 0.8, 0.95}) {
        for (const char* sampler : {"dwivedi", "boundary", "modes"}) {
            const PlanarExperiment e = half_space(albedo, sampler);
            const PlanarResult plain = run_with(e, PlanarWindow::none, 40000);
            const PlanarResult window = run_with(e, PlanarWindow::adjoint, 40000);
            EXPECT_TRUE(is_exact(window)) << sampler << ' ' << albedo;
            EXPECT_LT(window.channels[0].variance(), 1.25 * plain.channels[0].variance()) << sampler << ' ' << albedo;
        }
    }
}

TEST(PlanarWindow, ByTheWeightAloneUndoesAGuide) {
    const PlanarExperiment e = half_space(0.95, "dwivedi");
    const PlanarResult roulette = run_with(e, PlanarWindow::weight, 100000);
    EXPECT_TRUE(is_exact(roulette));
    // 41 times; 17 where the roulette comes before the direction is drawn.
    EXPECT_GT(roulette.channels[0].variance() / dwivedi_variance(0.95, 1, FirstFlight::stretched), 5);
}

TEST(PlanarWindow, HelpsWalksThroughShields) {
    for (const auto& [albedo, thickness] : {std::pair(0.8, 5.0), std::pair(0.95, 10.0)}) {
        for (const std::string& sampler : planar_samplers()) {
            const PlanarExperiment e = slab(albedo, thickness, Tally::transmittance, sampler);
            const PlanarResult window = run_with(e, PlanarWindow::adjoint, 20000);
            EXPECT_TRUE(is_exact(window)) << sampler << ' ' << thickness;
            EXPECT_FALSE(is_exact(window, 1e-6, 1.25)) << sampler << ' ' << thickness;
            // It saves walks that do not know where to go, and does not hurt the others much.
            const bool lost = sampler == "analog" || sampler == "classical" || sampler == "stretched";
            const double plain = run_with(e, PlanarWindow::none, 20000).channels[0].variance();
            EXPECT_LT(window.channels[0].variance(), (lost ? 0.9 : 1.5) * plain) << sampler << ' ' << thickness;
        }
    }
}

}  // namespace
}  // namespace wend
