#include <tests/guide/sphere_integral.h>
#include <wend/core/error.h>
#include <wend/core/random.h>
#include <wend/guide/fit.h>
#include <wend/guide/lobe_fit.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace wend::guide {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
const Box3 unit_box(Vec3(0, 0, 0), Vec3(1, 1, 1));

Vec3 position_in_box(Pcg32& random) {
    const Vec2 u = random.uniform2();
    return {u.x, u.y, random.uniform()};
}

VmfMixture target() {
    const std::array<WeightedVmf, 3> lobes = {{{0.5f, {normalize(Vec3(1, 2, 3)), 60}},
                                               {0.3f, {normalize(Vec3(-3, 1, 0)), 8}},
                                               {0.2f, {normalize(Vec3(0, -1, -1)), 1}}}};
    return VmfMixture(lobes);
}

/// Records of far sources whose radiance is the target's density, drawn uniformly or by the target itself.
Records records_of(const VmfMixture& radiance, int count, std::uint64_t seed, bool drawn_by_target) {
    Pcg32 random(seed);
    Records records;
    for (int i = 0; i < count; ++i) {
        const Vec3 position = position_in_box(random);
        const Vec3 w = drawn_by_target ? radiance.sample(random.uniform2()) : Vmf{}.sample(random.uniform2());
        records.push_back(
            {position, w, radiance.density(w), drawn_by_target ? radiance.density(w) : inv_4pi, infinity});
    }
    return records;
}

FitSettings one_cell() {
    FitSettings settings;
    settings.leaf_samples = 1e9;
    return settings;
}

Field trained(const Records& records, const FitSettings& settings) {
    return fit(Field::empty(unit_box), records, settings, 1).field;
}

bool is_valid(const VmfMixture& mixture) {
    float sum = 0;
    for (int i = 0; i < mixture.size(); ++i) {
        const auto [weight, vmf] = mixture.lobe(i);
        if (!(weight >= 0 && vmf.kappa >= 0 && std::isfinite(vmf.kappa) && std::abs(length(vmf.mean) - 1) < 1e-4f)) {
            return false;
        }
        sum += weight;
    }
    return std::abs(sum - 1) < 1e-4f;
}

TEST(Field, KnowsNothingBeforeTraining) {
    const Field field = Field::empty(unit_box);
    EXPECT_EQ(field.find({0.5f, 0.5f, 0.5f}), nullptr);
    EXPECT_EQ(fit(field, {}, {}, 1).field.find({0.5f, 0.5f, 0.5f}), nullptr);
}

TEST(Fit, RecoversAMixtureDrawnByItself) {
    const Field field = trained(records_of(target(), 20000, 1, true), one_cell());
    const Region* region = field.find({0.5f, 0.5f, 0.5f});
    ASSERT_NE(region, nullptr);
    EXPECT_LT(test::divergence(target(), region->mixture()), 0.01);
    EXPECT_NEAR(region->fluence(), 1, 1e-3);
}

TEST(Fit, RecoversAMixtureDrawnUniformly) {
    const Field field = trained(records_of(target(), 20000, 2, false), one_cell());
    const Region* region = field.find({0.5f, 0.5f, 0.5f});
    ASSERT_NE(region, nullptr);
    EXPECT_LT(test::divergence(target(), region->mixture()), 0.02);
    EXPECT_NEAR(region->fluence(), 1, 0.1);  // one standard error is 0.016
}

TEST(Fit, ADifferentTargetIsFarAway) {
    // The twin of the two tests above: their measure tells mixtures apart.
    const std::array<WeightedVmf, 2> other = {{{0.5f, {normalize(Vec3(1, 2, 2.6f)), 60}}, {0.5f, {{-1, 0, 0}, 3}}}};
    const Field field = trained(records_of(VmfMixture(other), 20000, 1, true), one_cell());
    EXPECT_GT(test::divergence(target(), field.find({0, 0, 0})->mixture()), 0.2);
}

TEST(Fit, ImprovesFromPassToPass) {
    FitSettings settings = one_cell();
    settings.decay = 1;
    Field field = Field::empty(unit_box);
    double first = 0, last = 0;
    for (int pass = 0; pass < 6; ++pass) {
        field = fit(field, records_of(target(), 2000, 10 + pass, false), settings, 1).field;
        last = test::divergence(target(), field.find({0, 0, 0})->mixture());
        first = pass == 0 ? last : first;
    }
    EXPECT_LT(last, 0.2 * first);
    EXPECT_LT(last, 0.02);
}

TEST(Fit, ScaleOfRadianceChangesOnlyTheFluence) {
    Records records = records_of(target(), 5000, 3, false);
    const Field field = trained(records, one_cell());
    for (Record& r : records) {
        r.radiance *= 0x1p60f;
    }
    const Field bright = trained(records, one_cell());
    const Region &a = *field.find({0, 0, 0}), &b = *bright.find({0, 0, 0});
    EXPECT_EQ(b.fluence(), a.fluence() * 0x1p60f);
    EXPECT_LT(test::divergence(a.mixture(), b.mixture()), 1e-6);
}

TEST(Fit, InScatteredRadianceIsTheIntegralOfTheTruth) {
    const Field field = trained(records_of(target(), 40000, 51, true), one_cell());
    const Vec3 position(0.5f, 0.5f, 0.5f);
    for (const float kappa : {-20.0f, 0.0f, 2.0f, 20.0f}) {
        const AxialLobes lobes = AxialLobes(std::array{AxialLobe{1, kappa}}).around(normalize(Vec3(1, 2, 2)));
        const double truth = test::integrate_sphere(
            [&](const Vec3& w) { return static_cast<double>(target().density(w)) * lobes.density(w); });
        EXPECT_NEAR(in_scattered(*field.find(position), position, lobes).g, truth, 0.05 * truth) << kappa;
    }
}

/// Equal narrow emitters around, drawn by their own density.
VmfMixture emitters(int count) {
    std::vector<WeightedVmf> lobes;
    for (int i = 0; i < count; ++i) {
        const float z = 1 - (2 * i + 1.0f) / count, r = std::sqrt(1 - z * z);
        lobes.push_back({1, {Vec3(r * std::cos(2.4f * i), r * std::sin(2.4f * i), z), 200}});
    }
    return VmfMixture(lobes);
}

TEST(Fit, LobesGrowAsRecordsCallForThem) {
    const auto learn = [](FitSettings settings) {
        settings.leaf_samples = 1e9;
        Field field = Field::empty(unit_box);
        for (int pass = 0; pass < 5; ++pass) {
            field = fit(field, records_of(emitters(12), 3000 << pass, 60 + pass, true), settings, 1).field;
        }
        return field;
    };
    const Field field = learn({});
    EXPECT_GE(field.find({0, 0, 0})->mixture().size(), 12);
    EXPECT_LT(test::divergence(emitters(12), field.find({0, 0, 0})->mixture(), 400), 0.02);
    // The twin: eight are not enough.
    FitSettings fixed;
    fixed.most_lobes = fixed.lobes;
    EXPECT_GT(test::divergence(emitters(12), learn(fixed).find({0, 0, 0})->mixture(), 400), 0.5);
}

TEST(Fit, LobesThatAreNotNeededAreMerged) {
    for (const int count : {1, 3}) {
        const Field field = trained(records_of(emitters(count), 20000, 70, true), one_cell());
        EXPECT_LE(field.find({0, 0, 0})->mixture().size(), count + 1);
        EXPECT_LT(test::divergence(emitters(count), field.find({0, 0, 0})->mixture(), 400), 0.005);
    }
}

/// Two spherical lamps, given as what a position sees of them.
struct TwoLamps {
    static VmfMixture seen_from(const Vec3& position) {
        const auto lamp = [&](const Vec3& centre, float radius, float power) {
            const Vec3 to_lamp = centre - position;
            const float d2 = length_squared(to_lamp);
            return WeightedVmf{power / d2, {normalize(to_lamp), 2 * d2 / sqr(radius)}};
        };
        const std::array<WeightedVmf, 2> lamps = {
            {lamp({0.5f, 0.5f, 2.5f}, 0.3f, 1), lamp({-1.5f, 0.2f, 0.5f}, 0.4f, 1)}};
        return VmfMixture(lamps);
    }
};

/// Records of the lamps; `distance(random, true_distance)` is what they report.
template <class Distance>
Records records_of_lamps(int count, std::uint64_t seed, const Distance& distance) {
    Pcg32 random(seed);
    Records records;
    for (int i = 0; i < count; ++i) {
        const Vec3 position = position_in_box(random);
        const VmfMixture seen = TwoLamps::seen_from(position);
        const Vec3 w = seen.sample(random.uniform2());
        const Vec3 lamp = w.z > 0.6f ? Vec3(0.5f, 0.5f, 2.5f) : Vec3(-1.5f, 0.2f, 0.5f);
        const float true_distance = length(lamp - position);
        records.push_back({position, w, seen.density(w), seen.density(w), distance(random, true_distance)});
    }
    return records;
}

double mean_divergence_from_lamps(const Field& field) {
    Pcg32 random(99);
    constexpr int positions = 12;
    double sum = 0;
    for (int i = 0; i < positions; ++i) {
        const Vec3 position = position_in_box(random);
        sum += test::divergence(TwoLamps::seen_from(position), field.find(position)->incident(position));
    }
    return sum / positions;
}

/// The best one mixture can do for all positions.
double divergence_without_parallax() {
    Field field = trained(records_of_lamps(20000, 5, [](Pcg32&, float d) { return d; }), one_cell());
    const Region& region = *field.find({0, 0, 0});
    Pcg32 random(99);
    constexpr int positions = 12;
    double sum = 0;
    for (int i = 0; i < positions; ++i) {
        sum += test::divergence(TwoLamps::seen_from(position_in_box(random)), region.mixture());
    }
    return sum / positions;
}

TEST(Fit, ParallaxSharpensNearSources) {
    const double with =
        mean_divergence_from_lamps(trained(records_of_lamps(20000, 5, [](Pcg32&, float d) { return d; }), one_cell()));
    EXPECT_LT(with, 0.12);
    EXPECT_GT(divergence_without_parallax(), 4 * with);
}

TEST(Fit, DirectionsTellDistancesThatRecordsDoNot) {
    // Nothing told; or what a medium reports: vertices at exponential distances, which say nothing about the lamp's.
    const auto unknown = [](Pcg32&, float) { return infinity; };
    const auto exponential = [](Pcg32& random, float) { return -std::log(1 - random.uniform()) + 1e-6f; };
    EXPECT_LT(mean_divergence_from_lamps(trained(records_of_lamps(20000, 6, unknown), one_cell())), 0.12);
    EXPECT_LT(mean_divergence_from_lamps(trained(records_of_lamps(20000, 6, exponential), one_cell())), 0.12);
}

/// Splits by count alone.
FitSettings leaves_of(double samples) {
    FitSettings settings;
    settings.leaf_samples = samples;
    settings.uniform_factor = 1;
    return settings;
}

TEST(Fit, CellsFollowTheRecords) {
    const FitSettings settings = leaves_of(500);
    Records records = records_of(target(), 8000, 8, true);
    for (std::size_t i = 0; i < records.size(); ++i) {  // most of them in one corner, many without radiance
        records[i].position *= i % 4 == 0 ? 1.0f : 0.1f;
        records[i].radiance *= i % 2 == 0 ? 1.0f : 0.0f;
    }
    const FitResult result = fit(Field::empty(unit_box), records, settings, 1);
    EXPECT_EQ(result.report.dark, 4000u);
    EXPECT_GE(result.report.cells, 16u);
    EXPECT_LE(result.report.cells, 64u);
    EXPECT_LT(length(result.field.find({0.05f, 0.05f, 0.05f})->reference() - Vec3(0.05f, 0.05f, 0.05f)), 0.09f);
    // Dark records count for the mean: half of them were dark.
    EXPECT_NEAR(result.field.find({0.05f, 0.05f, 0.05f})->fluence(), 0.5f, 0.2f);
}

TEST(Fit, WhereNothingDiffersCellsStayLarge) {
    FitSettings settings;
    settings.uniform_factor = 64;
    const auto train = [](const FitSettings& s) {
        Field field = Field::empty(unit_box);
        for (int pass = 0; pass < 3; ++pass) {
            field = fit(field, records_of(target(), 10000 << pass, 30 + pass, false), s, 1).field;
        }
        return field;
    };
    const Field field = train(settings), by_count = train(leaves_of(settings.leaf_samples));
    EXPECT_LE(field.size(), 2u);
    EXPECT_GE(by_count.size(), 8 * field.size());
    // Nothing is lost.
    EXPECT_LT(test::divergence(target(), field.find({0.1f, 0.1f, 0.1f})->mixture()),
              test::divergence(target(), by_count.find({0.1f, 0.1f, 0.1f})->mixture()));
}

/// Records of the target, most of its light being absent where shadowed(x).
template <class Shadow>
Records shadowed_records(int count, std::uint64_t seed, const Shadow& shadowed) {
    const VmfMixture shade(std::array<WeightedVmf, 1>{{{1, {normalize(Vec3(-3, 1, 0)), 8}}}});
    Pcg32 random(seed);
    Records records;
    for (int i = 0; i < count; ++i) {
        const Vec3 position = position_in_box(random);
        const bool dim = shadowed(position);
        const VmfMixture radiance = dim ? shade : target();
        const Vec3 w = radiance.sample(random.uniform2());
        records.push_back({position, w, radiance.density(w) * (dim ? 0.3f : 1.0f), radiance.density(w), infinity});
    }
    return records;
}

TEST(Fit, CellsRefineAtTheEdgeOfAShadow) {
    FitSettings settings;
    settings.leaf_samples = 500;
    settings.uniform_factor = 64;
    Field field = Field::empty(unit_box);
    for (int pass = 0; pass < 4; ++pass) {
        const auto shadowed = [](const Vec3& x) { return x.x < 0.3f; };
        field = fit(field, shadowed_records(3000 << pass, 40 + pass, shadowed), settings, 1).field;
    }
    field.for_each_cell([&](const Box3& box, const Region&, double) {
        if (box.min.x <= 0.3f && box.max.x >= 0.3f) {
            EXPECT_LT(box.max.x - box.min.x, 0.1f);
        }
        // Along the edge there is no reason to split.
        EXPECT_GT(box.max.y - box.min.y, 0.2f);
        EXPECT_GT(box.max.z - box.min.z, 0.2f);
    });
    EXPECT_GE(field.size(), 4u);
    EXPECT_LE(field.size(), 24u);
    EXPECT_NEAR(field.find({0.1f, 0.5f, 0.5f})->fluence(), 0.3f, 0.02f);
    EXPECT_NEAR(field.find({0.7f, 0.5f, 0.5f})->fluence(), 1, 0.02f);
    // The twin: without the edge there is no reason to split.
    field = Field::empty(unit_box);
    for (int pass = 0; pass < 4; ++pass) {
        field =
            fit(field, shadowed_records(3000 << pass, 40 + pass, [](const Vec3&) { return false; }), settings, 1).field;
    }
    EXPECT_LE(field.size(), 2u);
}

TEST(Fit, ChildrenInheritWhatTheirParentKnew) {
    const FitSettings settings = leaves_of(5000);
    const Field parent = fit(Field::empty(unit_box), records_of(target(), 4500, 9, true), settings, 1).field;
    ASSERT_EQ(parent.size(), 1u);
    const Field field = fit(parent, records_of(target(), 2000, 10, true), settings, 1).field;
    ASSERT_EQ(field.size(), 2u);
    for (const Vec3& position : {Vec3(0.1f, 0.1f, 0.1f), Vec3(0.9f, 0.9f, 0.9f)}) {
        EXPECT_LT(test::divergence(target(), field.find(position)->mixture()), 0.02);
    }
}

TEST(Fit, IsTheSameForAnyNumberOfThreads) {
    FitSettings settings;
    settings.leaf_samples = 100;
    const auto train = [&](int threads) {
        Field field = Field::empty(unit_box);
        for (int pass = 0; pass < 3; ++pass) {
            field = fit(field, records_of_lamps(8000, 20 + pass, [](Pcg32&, float d) { return d; }), settings, threads)
                        .field;
        }
        return field;
    };
    const Field one = train(1);
    EXPECT_GT(one.size(), 20u);
    for (const int threads : {2, 5}) {
        const Field other = train(threads);
        ASSERT_EQ(other.size(), one.size());
        Pcg32 random(21);
        for (int i = 0; i < 2000; ++i) {
            const Vec3 position = position_in_box(random);
            const Vec3 w = Vmf{}.sample(random.uniform2());
            const Region &a = *one.find(position), &b = *other.find(position);
            ASSERT_EQ(a.incident(position).density(w), b.incident(position).density(w));
            ASSERT_EQ(a.fluence(), b.fluence());
        }
    }
    // The order of records does matter, which shows that the comparison is sharp.
    Records reversed = records_of(target(), 5000, 22, false);
    const Field forward = trained(reversed, one_cell());
    std::reverse(reversed.begin(), reversed.end());
    EXPECT_NE(forward.find({0, 0, 0})->mixture().density({0, 0, 1}),
              trained(reversed, one_cell()).find({0, 0, 0})->mixture().density({0, 0, 1}));
}

TEST(Fit, HonoursTheMemoryLimit) {
    FitSettings settings;
    settings.leaf_samples = 10;
    const Records records = records_of(target(), 20000, 11, true);
    const FitResult free = fit(Field::empty(unit_box), records, settings, 1);
    EXPECT_FALSE(free.report.memory_limited);
    settings.max_bytes = 100 << 10;
    const FitResult limited = fit(Field::empty(unit_box), records, settings, 1);
    EXPECT_TRUE(limited.report.memory_limited);
    EXPECT_GT(free.report.bytes, settings.max_bytes);
    EXPECT_LE(limited.report.bytes, settings.max_bytes);
    EXPECT_GT(limited.report.bytes, settings.max_bytes * 9 / 10);
    EXPECT_EQ(limited.report.bytes, limited.field.bytes());
}

TEST(Fit, StreamsManyRecordsWithinTheLimit) {
    FitSettings settings;
    settings.leaf_samples = 200;
    settings.max_bytes = 128 << 10;
    const std::array<Records, 2> records = {records_of(target(), 250000, 80, true),
                                            records_of(target(), 250000, 81, true)};
    Field field = Field::empty(unit_box);
    for (std::size_t pass = 0; pass < 20; ++pass) {
        const FitResult result = fit(field, records[pass % 2], settings, 2);
        ASSERT_LE(result.report.bytes, settings.max_bytes);
        field = result.field;
    }
    EXPECT_TRUE(is_valid(field.find({0.5f, 0.5f, 0.5f})->mixture()));
    EXPECT_LT(test::divergence(target(), field.find({0.5f, 0.5f, 0.5f})->mixture()), 0.005);
}

TEST(Fit, HonoursTheDepthLimit) {
    FitSettings settings;
    settings.leaf_samples = 10;
    settings.max_depth = 3;
    EXPECT_EQ(trained(records_of(target(), 5000, 12, true), settings).size(), 8u);
}

TEST(Fit, DarknessLeavesAValidField) {
    Records records = records_of(target(), 3000, 13, false);
    for (Record& r : records) {
        r.radiance = 0;
    }
    Field field = trained(records, leaves_of(500));
    const Region* region = field.find({0.2f, 0.2f, 0.2f});
    ASSERT_NE(region, nullptr);
    EXPECT_GT(field.size(), 1u);
    EXPECT_EQ(region->fluence(), 0);
    EXPECT_FLOAT_EQ(region->mixture().density({0, 0, 1}), inv_4pi);
    // And it can still learn.
    field = fit(field, records_of(target(), 3000, 14, true), one_cell(), 1).field;
    EXPECT_LT(test::divergence(target(), field.find({0.2f, 0.2f, 0.2f})->mixture()), 0.1);
}

TEST(Fit, SurvivesRecordsAtOnePointInOneDirection) {
    FitSettings settings;
    settings.leaf_samples = 10;
    const Record record{{0.5f, 0.5f, 0.5f}, {0, 1, 0}, 2, 0.25f, 3};
    const Field field = trained(Records(1000, record), settings);
    EXPECT_EQ(field.size(), 1u);
    const Region& region = *field.find({0.5f, 0.5f, 0.5f});
    EXPECT_TRUE(is_valid(region.mixture()));
    EXPECT_FLOAT_EQ(region.fluence(), 8);
    EXPECT_GT(region.mixture().density({0, 1, 0}), 100);
    EXPECT_TRUE(is_valid(region.incident({0.5f, 3.5f, 0.5f})));  // at the source
    EXPECT_TRUE(is_valid(trained(Records(1, record), settings).find({0, 0, 0})->mixture()));
}

TEST(Fit, OneRecordMakesNoSpike) {
    const Record record{{0.5f, 0.5f, 0.5f}, {0, 1, 0}, 2, 0.25f, 3};
    const Field field = trained(Records(1, record), {});
    EXPECT_LT(field.find({0, 0, 0})->mixture().density({0, 1, 0}), 2);
}

TEST(Fit, RareLightIsLearnedInLargerCells) {
    // As many records, all of them bright or one in five hundred.
    const FitSettings settings = leaves_of(500);
    const auto cells = [&](int dark) {
        Records records = records_of(target(), 1400, 17, true);
        for (std::size_t i = 0; i < records.size(); ++i) {
            records[i].radiance *= static_cast<int>(i) % dark == 0 ? 1.0f : 0.0f;
        }
        return trained(records, settings).size();
    };
    EXPECT_GT(cells(1), 1u);
    EXPECT_EQ(cells(500), 1u);
}

TEST(Fit, OneFreakAmongManyDoesNotTakeOver) {
    Records records = records_of(target(), 10000, 15, true);
    records[5000].radiance *= 1e6f;
    const Field field = trained(records, one_cell());
    EXPECT_LT(test::divergence(target(), field.find({0, 0, 0})->mixture()), 0.03);
}

TEST(Fit, AForgottenFreakIsNoMeasureOfWhatFollows) {
    // What is left has squares below the range of single precision.
    LobeModel model = initial_lobes(2);
    std::array<LobeSums, max_lobes> sums{};
    sums[0].weight = 1e-24f;
    sums[0].direction = Vec3(0, 0, 1e-24f);
    EXPECT_TRUE(is_valid(maximization(sums, model, {}, 1).mixture));

    const auto ordinary = [](std::uint64_t seed) {
        Records records = records_of(target(), 20000, seed, true);
        for (Record& r : records) {
            r.radiance *= 1e-15f;
        }
        return records;
    };
    Records first = ordinary(1);
    first[7].radiance = 1e15f;
    Field field = trained(first, one_cell());
    for (std::uint64_t pass = 2; pass < 40; ++pass) {
        field = fit(field, ordinary(pass), one_cell(), 1).field;
        ASSERT_TRUE(is_valid(field.find({0.5f, 0.5f, 0.5f})->mixture())) << pass;
    }
}

TEST(Fit, SurvivesExtremeNumbers) {
    Pcg32 random(16);
    Records records;
    for (int i = 0; i < 4000; ++i) {
        const auto power_of_ten = [&](float largest) { return std::pow(10.0f, largest * (2 * random.uniform() - 1)); };
        const Vec3 position = (position_in_box(random) - Vec3(0.5f, 0.5f, 0.5f)) * power_of_ten(14);
        const Vec3 w = Vmf{}.sample(random.uniform2());
        const float radiance = power_of_ten(15), density = power_of_ten(14);
        records.push_back({position, w, radiance, density, power_of_ten(37)});
    }
    FitSettings settings;
    settings.leaf_samples = 50;
    const FitResult result = fit(Field::empty(unit_box), records, settings, 2);
    EXPECT_EQ(result.report.ignored, 0u);
    for (const Record& r : records) {
        const Region& region = *result.field.find(r.position);
        ASSERT_TRUE(is_valid(region.incident(r.position)));
        ASSERT_TRUE(std::isfinite(region.fluence()));
    }
}

TEST(Fit, IgnoresAndCountsUnusableRecords) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Records records = records_of(target(), 1000, 17, true);
    const Field clean = trained(records, one_cell());
    const Record good = records.front();
    const auto insert = [&](auto spoil) {
        Record bad = good;
        spoil(bad);
        EXPECT_FALSE(is_usable(bad));
        records.insert(records.begin() + 500, bad);
    };
    insert([&](Record& r) { r.position.y = nan; });
    insert([&](Record& r) { r.position.x = infinity; });
    insert([&](Record& r) { r.direction.z = nan; });
    insert([&](Record& r) { r.direction *= 2; });
    insert([&](Record& r) { r.radiance = nan; });
    insert([&](Record& r) { r.radiance = infinity; });
    insert([&](Record& r) { r.radiance = -1; });
    insert([&](Record& r) { r.density = 0; });
    insert([&](Record& r) { r.density = infinity; });
    insert([&](Record& r) { r.distance = nan; });
    insert([&](Record& r) { r.distance = 0; });
    insert([&](Record& r) { r.radiance = 1e30f, r.density = 1e-30f; });
    const FitResult result = fit(Field::empty(unit_box), records, one_cell(), 1);
    EXPECT_EQ(result.report.ignored, 12u);
    EXPECT_EQ(result.report.records, 1012u);
    EXPECT_EQ(result.field.find({0, 0, 0})->mixture().density({0, 0, 1}),
              clean.find({0, 0, 0})->mixture().density({0, 0, 1}));
}

TEST(Fit, RefusesSettingsOutOfRange) {
    const auto refused = [](auto spoil) {
        FitSettings settings;
        spoil(settings);
        EXPECT_THROW(fit(Field::empty(unit_box), {}, settings, 1), InputError);
    };
    refused([](FitSettings& s) { s.lobes = 0; });
    refused([](FitSettings& s) { s.lobes = max_lobes + 1; });
    refused([](FitSettings& s) { s.most_lobes = max_lobes + 1; });
    refused([](FitSettings& s) { s.most_lobes = s.lobes - 1; });
    refused([](FitSettings& s) { s.leaf_samples = 0; });
    refused([](FitSettings& s) { s.uniform_factor = 0.5; });
    refused([](FitSettings& s) { s.variation = std::numeric_limits<double>::quiet_NaN(); });
    refused([](FitSettings& s) { s.max_depth = 100; });
    refused([](FitSettings& s) { s.max_bytes = 0; });
    refused([](FitSettings& s) { s.decay = 1.5; });
    refused([](FitSettings& s) { s.max_iterations = 0; });
    refused([](FitSettings& s) { s.tolerance = std::numeric_limits<double>::quiet_NaN(); });
    refused([](FitSettings& s) { s.priors.weight = 0; });
    refused([](FitSettings& s) { s.priors.max_kappa = 1e9f; });
}

}  // namespace
}  // namespace wend::guide
