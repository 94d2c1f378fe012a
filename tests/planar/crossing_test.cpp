// The decision at a planar boundary: probabilities, and weights that make every one of them right in the mean.
#include <tests/sampling/verdicts.h>
#include <tests/support/planar.h>

#include <wend/medium/fresnel.h>
#include <wend/planar/crossing.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

using test::adjoint_of;
using test::PlanarCase;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr int count = 50000;

struct Place {
    PlanarCase medium;
    bool at_far;
};

const std::vector<Place>& places() {
    static const std::vector<Place> all = {
        {{"half-space", 0.8, 0, infinite, 1.5}, false},
        {{"forward half-space", 0.8, 0.8, infinite, 1.33}, false},
        {{"slab lit far", 0.8, 0, 5, 1.5, true}, true},
        {{"slab lit far, dark near side", 0.8, 0, 5, 1.5, true}, false},
        {{"disturbed slab", 0.8, 0.8, 2, 1.33, false, 8, 0.2}, false},
        {{"matched half-space", 0.8}, false},
    };
    return all;
}

// Either side of the critical angle, 0.745 at an index of 1.5 and 0.659 at 1.33.
constexpr double cosines[] = {1e-3, 0.3, 0.65, 0.67, 0.74, 0.75, 0.9, 1};

/// p-value of counts of leaving and staying.
double p_value_of(int left, double probability) {
    if (probability <= 0 || probability >= 1) {
        return left == (probability > 0 ? count : 0) ? 1 : 0;
    }
    const double sigma = std::sqrt(count * probability * (1 - probability));
    return two_sided_p_value((std::abs(left - count * probability) - std::min(3.0, 0.5 * sigma)) / sigma);
}

template <class D>
void expect_honest(const D& crossing, const PlanarSlab& slab, const Place& place) {
    const PlanarBoundary& boundary = place.at_far ? slab.far : slab.near;
    Pcg32 random(11);
    for (const double t : cosines) {
        const double probability = crossing.leaving_probability(place.at_far, t);
        const double reflectance = boundary.ior == 1 ? 0 : fresnel_dielectric(-t, boundary.ior);
        ASSERT_TRUE(probability >= 0 && probability <= 1);
        int left = 0;
        for (int i = 0; i < count; ++i) {
            const PlanarCrossing c = crossing.sample(place.at_far, t, random);
            left += c.leaves ? 1 : 0;
            // Weight times probability is physics, whatever was drawn.
            const double physics = c.leaves ? 1 - reflectance : reflectance;
            ASSERT_NEAR(c.weight * (c.leaves ? probability : 1 - probability), physics, 1e-12) << place.medium.name;
            if (c.leaves) {
                ASSERT_NEAR(1 - c.cosine * c.cosine, (1 - t * t) * boundary.ior * boundary.ior, 1e-12);
            } else {
                ASSERT_EQ(c.cosine, t);
            }
        }
        EXPECT_GT(p_value_of(left, probability), 1e-4) << place.medium.name << ", cosine " << t;
        // The twin: a wrong probability is seen.
        if (probability > 0.02 && probability < 0.98) {
            EXPECT_LT(p_value_of(left, probability + 0.015), test::failing + 1e-4) << place.medium.name << ", " << t;
        }
    }
}

TEST(ClassicalCrossing, LeavesByReflectance) {
    for (const Place& place : places()) {
        const PlanarSlab slab = test::slab_of(place.medium);
        expect_honest(ClassicalCrossing(slab), slab, place);
    }
}

TEST(GuidedCrossing, LeavesByTheProbabilityItClaims) {
    for (const Place& place : places()) {
        const PlanarAdjoint adjoint = adjoint_of(place.medium);
        expect_honest(GuidedCrossing(adjoint), adjoint.slab(), place);
    }
}

TEST(GuidedCrossing, LeavesInProportionToWhatItBrings) {
    const PlanarAdjoint adjoint = adjoint_of({"half-space", 0.8, 0, infinite, 1.5});
    const GuidedCrossing crossing(adjoint);
    for (const double t : {0.76, 0.9, 1.0}) {
        const double reflectance = fresnel_dielectric(-t, 1.5);
        EXPECT_NEAR(crossing.leaving_probability(false, t),
                    (1 - reflectance) / (1 - reflectance + reflectance * adjoint.radiance(0, t)), 1e-3);
    }
    EXPECT_EQ(crossing.leaving_probability(false, 0.7), 0) << "total reflection";
}

TEST(GuidedCrossing, NeverLeavesIntoTheDark) {
    const PlanarAdjoint adjoint = adjoint_of({"slab lit far", 0.8, 0, 5, 1.5, true});
    EXPECT_LT(GuidedCrossing(adjoint).leaving_probability(false, 0.9), 2e-3);
    EXPECT_GT(ClassicalCrossing(adjoint.slab()).leaving_probability(false, 0.9), 0.9);
}

/// Means of weight and of weight times cosine, for walks that leave and that stay.
struct CrossingMeans {
    Moments left, left_cosine, stayed, stayed_cosine;
};

CrossingMeans means_of(const auto& crossing, double cosine, std::uint64_t seed) {
    CrossingMeans means;
    Pcg32 random(seed);
    for (int i = 0; i < 200000; ++i) {
        const PlanarCrossing c = crossing.sample(false, cosine, random);
        means.left.add(c.leaves ? c.weight : 0);
        means.left_cosine.add(c.leaves ? c.weight * c.cosine : 0);
        means.stayed.add(c.leaves ? 0 : c.weight);
        means.stayed_cosine.add(c.leaves ? 0 : c.weight * c.cosine);
    }
    return means;
}

testing::AssertionResult same_mean(const Moments& a, const Moments& b, double factor = 1) {
    const double error = std::hypot(a.standard_error(), factor * b.standard_error());
    return std::abs(a.mean() - factor * b.mean()) <= 4 * error
               ? testing::AssertionSuccess()
               : testing::AssertionFailure() << a.mean() << " against " << factor * b.mean() << " +- " << error;
}

// Choosing among rough facets has no closed density: its weights must make all means those of the plain choice.
TEST(GuidedCrossing, RoughBoundariesKeepTheirMeans) {
    PlanarProblem problem;
    problem.slab.near.ior = 1.5;
    problem.slab.near.rough = std::make_shared<RoughBoundary>(1.5, 0.3);
    problem.slab.near.illumination = [](double) { return 1.0; };
    PlanarAdjoint adjoint(solve_planar(problem), problem.slab);
    adjoint.keep_positive();
    const GuidedCrossing guided(adjoint);
    const ClassicalCrossing classical(adjoint.slab());
    for (const double t : {0.05, 0.5, 0.75, 1.0}) {
        const CrossingMeans a = means_of(guided, t, 1), b = means_of(classical, t, 2);
        EXPECT_TRUE(same_mean(a.left, b.left)) << t;
        EXPECT_TRUE(same_mean(a.left_cosine, b.left_cosine)) << t;
        EXPECT_TRUE(same_mean(a.stayed, b.stayed)) << t;
        EXPECT_TRUE(same_mean(a.stayed_cosine, b.stayed_cosine)) << t;
        EXPECT_FALSE(same_mean(a.stayed, b.stayed, 1.2)) << t;
    }
}

}  // namespace
}  // namespace wend
