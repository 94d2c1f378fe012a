#include <tests/guide/sphere_integral.h>
#include <wend/core/random.h>
#include <wend/guide/evidence.h>
#include <wend/guide/lobe_revision.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace wend::guide {
namespace {

const Vec3 mean = normalize(Vec3(1, -2, 0.5f));

double merging_divergence_by_quadrature(const WeightedVmf& a, const WeightedVmf& b) {
    const double p = a.weight / (static_cast<double>(a.weight) + b.weight);
    Imath::V3d resultant = Imath::V3d(a.vmf.mean) * (p * vmf_mean_cosine(a.vmf.kappa)) +
                           Imath::V3d(b.vmf.mean) * ((1 - p) * vmf_mean_cosine(b.vmf.kappa));
    const Vmf c{Vec3(resultant.normalized()), vmf_kappa(static_cast<float>(resultant.length()))};
    return test::integrate_sphere(
               [&](const Vec3& w) {
                   const double both = p * a.vmf.density(w) + (1 - p) * b.vmf.density(w);
                   return both * both / static_cast<double>(c.density(w));
               },
               400) -
           1;
}

TEST(MergingDivergence, IsTheIntegral) {
    const Vec3 beside = normalize(mean + Vec3(0.3f, 0, 0.1f));
    for (const auto& [a, b] : {std::pair(WeightedVmf{1, {mean, 20}}, WeightedVmf{1, {beside, 20}}),
                               std::pair(WeightedVmf{0.2f, {mean, 30}}, WeightedVmf{0.6f, {beside, 8}}),
                               std::pair(WeightedVmf{1, {mean, 0.5f}}, WeightedVmf{2, {-mean, 1}})}) {
        const double truth = merging_divergence_by_quadrature(a, b);
        EXPECT_NEAR(merging_divergence(a, b), truth, 2e-3 * truth + 1e-5);
    }
}

TEST(MergingDivergence, IsZeroForEqualLobesOnly) {
    EXPECT_NEAR(merging_divergence({1, {mean, 50}}, {3, {mean, 50}}), 0, 1e-4);
    EXPECT_GT(merging_divergence({1, {mean, 50}}, {1, {-mean, 50}}), 10);
}

/// The sums of directions of a mixture in one lobe.
LearnedLobes one_lobe_for(const VmfMixture& truth, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<Observation> observations;
    for (int i = 0; i < 4000; ++i) {
        observations.push_back({truth.sample(random.uniform2()), Vec3(0, 0, 0), 0, 1});
    }
    LearnedLobes learned{{VmfMixture(std::array{WeightedVmf{1, {mean, 5}}}), {}}, {}};
    for (int round = 0; round < 4; ++round) {
        learned.sums = expectation(learned.model, observations, 1);
        learned.model = maximization(learned.sums, learned.model, {}, 0);
    }
    return learned;
}

Misfit misfit_of(const VmfMixture& truth) {
    const LearnedLobes learned = one_lobe_for(truth, 3);
    return misfit(learned.sums[0], learned.model.mixture.lobe(0).vmf);
}

VmfMixture two(const Vmf& a, const Vmf& b) {
    return VmfMixture(std::array{WeightedVmf{1, a}, WeightedVmf{1, b}});
}

TEST(Misfit, IsSmallForALobe) {
    for (const float kappa : {0.3f, 3.0f, 30.0f, 1000.0f}) {
        EXPECT_LT(misfit_of(VmfMixture(std::array{WeightedVmf{1, {mean, kappa}}})).total(), 0.01) << kappa;
    }
}

TEST(Misfit, TellsTwoSourcesFromOneBeforeABackground) {
    const Misfit side_by_side = misfit_of(two({mean, 300}, {normalize(mean + Vec3(0.2f, 0.1f, 0)), 300}));
    EXPECT_GT(side_by_side.unequal, 0.1);
    const Misfit before_background = misfit_of(two({mean, 1000}, {mean, 20}));
    EXPECT_GT(before_background.radial, 0.1);
    EXPECT_TRUE(before_background.heavy_tailed);
    EXPECT_LT(before_background.unequal, 0.01);
}

TEST(ReviseLobes, SplitsAlongTheLongestAxis) {
    const Vec3 a = normalize(mean + Vec3(0.2f, 0.1f, 0)), b = normalize(mean - Vec3(0.2f, 0.1f, 0));
    LearnedLobes learned = one_lobe_for(two({a, 300}, {b, 300}), 4);
    std::array<LobeSums, max_lobes> earlier{};
    ASSERT_TRUE(revise_lobes(learned, earlier, max_lobes));
    ASSERT_EQ(learned.model.mixture.size(), 2);
    const Vec3 first = learned.model.mixture.lobe(0).vmf.mean, second = learned.model.mixture.lobe(1).vmf.mean;
    EXPECT_GT(std::max(dot(first, a) + dot(second, b), dot(first, b) + dot(second, a)), 2 * 0.998f);
    // The twins: no room, and no reason.
    learned = one_lobe_for(two({a, 300}, {b, 300}), 4);
    EXPECT_FALSE(revise_lobes(learned, earlier, 1));
    learned = one_lobe_for(VmfMixture(std::array{WeightedVmf{1, {a, 300}}}), 4);
    EXPECT_FALSE(revise_lobes(learned, earlier, max_lobes));
}

TEST(ReviseLobes, MergesLobesThatShareOneSource) {
    Pcg32 random(5);
    std::vector<Observation> observations;
    for (int i = 0; i < 4000; ++i) {
        observations.push_back({Vmf{mean, 100}.sample(random.uniform2()), Vec3(0, 0, 0), 0, 1});
    }
    LobeModel model{two({normalize(mean + Vec3(0.05f, 0, 0)), 100}, {normalize(mean - Vec3(0.05f, 0, 0)), 100}), {}};
    LearnedLobes learned{model, expectation(model, observations, 1)};
    std::array<LobeSums, max_lobes> earlier{};
    ASSERT_TRUE(revise_lobes(learned, earlier, max_lobes));
    ASSERT_EQ(learned.model.mixture.size(), 1);
    EXPECT_GT(dot(learned.model.mixture.lobe(0).vmf.mean, mean), 0.9999f);
    EXPECT_EQ(learned.sums[1].weight, 0);
    EXPECT_NEAR(learned.sums[0].weight, 4000, 1);
    // The shape of the joined lobes is that of one.
    EXPECT_LT(misfit(learned.sums[0], learned.model.mixture.lobe(0).vmf).total(), 0.02);
}

TEST(ReviseLobes, KeepsWhatIsKnownOfALobeThatWasSplit) {
    // Of a lobe's earlier records only the weight is known once it was split; then it is merged.
    Pcg32 random(5);
    std::vector<Observation> observations;
    for (int i = 0; i < 4000; ++i) {
        observations.push_back({Vmf{mean, 100}.sample(random.uniform2()), Vec3(0, 0, 0), 0, 1, 1.5f, 0.5f});
    }
    const LobeModel model{two({normalize(mean + Vec3(0.05f, 0, 0)), 100}, {normalize(mean - Vec3(0.05f, 0, 0)), 100}),
                          {}};
    std::array<LobeSums, max_lobes> earlier = expectation(model, observations, 1);
    LearnedLobes learned{model, earlier};
    for (int i = 0; i < 2; ++i) {
        learned.sums[i] += earlier[i];
    }
    earlier[0] = {};
    earlier[0].weight = 2000;
    ASSERT_TRUE(revise_lobes(learned, earlier, max_lobes));
    ASSERT_EQ(learned.model.mixture.size(), 1);
    const LobeSums& known = earlier[0];
    EXPECT_NEAR(known.weight, 4000, 200);
    EXPECT_NEAR(length(known.direction) / known.weight, vmf_mean_cosine(100.0f), 2e-3f);
    EXPECT_NEAR(known.red / known.weight, 1.5f, 1e-3f);
    EXPECT_NEAR(known.blue / known.weight, 0.5f, 1e-3f);
    EXPECT_GT(effective_records(known), 1500);
    EXPECT_LT(effective_records(known), 8000) << "not more than if all were known";
}

/// Observations at random places whose number or weight follows the place.
template <class Weight>
SplitEvidence evidence_of(const Weight& weight) {
    Pcg32 random(6);
    std::vector<Observation> observations;
    for (int i = 0; i < 4000; ++i) {
        const Vec2 u = random.uniform2();
        const Vec3 place(2 * u.x - 1, 2 * u.y - 1, 2 * random.uniform() - 1);
        const Vec3 w = two({mean, 20}, {-mean, 20}).sample(random.uniform2());
        observations.push_back({w, -place, 0, weight(place, w)});
    }
    const LobeModel model{two({mean, 20}, {-mean, 20}), {}};
    return split_evidence(model, expectation(model, observations, 1), {Vec3(0, 0, 0), Vec3(1, 1, 1) * (1.0f / 3)});
}

TEST(SplitEvidence, FollowsWhatVaries) {
    const SplitEvidence nothing = evidence_of([](const Vec3&, const Vec3&) { return 1.0f; });
    EXPECT_LT(nothing.significance, 4);
    EXPECT_LT(nothing.gain, 0.002);
    // All radiance grows along y: for 1 + s y the gain is s²/6.
    const SplitEvidence fluence = evidence_of([](const Vec3& x, const Vec3&) { return 1 + 0.5f * x.y; });
    EXPECT_EQ(fluence.axis, 1);
    EXPECT_GT(fluence.significance, 5);
    EXPECT_NEAR(fluence.gain, 0.25 / 6, 0.01);
    // One source replaces the other along z; the sum stays.
    const SplitEvidence sources =
        evidence_of([](const Vec3& x, const Vec3& w) { return 1 + (dot(w, mean) > 0 ? 0.5f : -0.5f) * x.z; });
    EXPECT_EQ(sources.axis, 2);
    EXPECT_GT(sources.significance, 5);
    EXPECT_NEAR(sources.gain, 0.25 / 6, 0.01);
}

}  // namespace
}  // namespace wend::guide
