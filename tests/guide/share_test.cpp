#include <wend/core/random.h>
#include <wend/core/vector.h>
#include <wend/guide/fit.h>
#include <wend/guide/share.h>
#include <wend/sampling/vmf.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wend::guide {
namespace {

const Vmf lamp{Vec3(0, 0, 1), 30};

/// What a guide believes in: the lamp, or a lobe beside it.
const Vmf right = lamp;
const Vmf beside{normalize(Vec3(1, 0, 1)), 30};

/// A draw from the mixture of uniform scattering and the guide, towards a lamp before a dim background.
Record draw(const Vmf& guide, float share, Pcg32& random) {
    Record r{};
    r.direction = random.uniform() < share ? Vmf{}.sample(random.uniform2()) : guide.sample(random.uniform2());
    r.radiance = lamp.density(r.direction) + 0.01f;
    r.classical_density = inv_4pi;
    r.guided_density = guide.density(r.direction);
    r.density = share * r.classical_density + (1 - share) * r.guided_density;
    r.distance = std::numeric_limits<float>::infinity();
    r.scattered = inv_4pi * r.radiance;
    return r;
}

ShareSums sums_of(const Vmf& guide, int count, float share = 0.5f) {
    Pcg32 random(1);
    ShareSums sums;
    for (int i = 0; i < count; ++i) {
        sums.add(draw(guide, share, random));
    }
    return sums;
}

/// ∫ (f L)² / p_α dω over directions, by midpoints.
double second_moment(const Vmf& guide, double share) {
    constexpr int n = 800;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const float z = 1 - (2 * static_cast<float>(i) + 1) / n, r = std::sqrt(1 - z * z);
            const float phi = 2 * pi * (static_cast<float>(j) + 0.5f) / n;
            const Vec3 w(r * std::cos(phi), r * std::sin(phi), z);
            const double scattered = static_cast<double>(inv_4pi * (lamp.density(w) + 0.01f));
            const auto c = static_cast<double>(inv_4pi), g = static_cast<double>(guide.density(w));
            sum += scattered * scattered / (share * c + (1 - share) * g);
        }
    }
    return sum * 4 * pi / (static_cast<double>(n) * n);
}

TEST(Share, MeasuresSecondMomentsWhateverShareDrew) {
    constexpr int count = 200000;
    for (const Vmf& guide : {right, beside}) {
        for (const float drawn : {0.3f, 0.5f}) {
            const ShareSums sums = sums_of(guide, count, drawn);
            for (std::size_t k = 0; k < ShareSums::shares.size(); ++k) {
                const double truth = second_moment(guide, ShareSums::shares[k]);
                EXPECT_NEAR(sums.moment[k] / count, truth, 0.03 * truth) << ShareSums::shares[k];
            }
        }
    }
}

TEST(Share, FollowsAGuideThatIsRightAndNotOneThatIsWrong) {
    EXPECT_LT(sums_of(right, 20000).best(), 0.2f);
    // What such a guide never finds comes in bright records, few of which are many of the others.
    EXPECT_GT(sums_of(beside, 100000).best(), 0.7f);
}

TEST(Share, IsTheMinimumOfTheMeasuredMoments) {
    // A lobe over the lamp's edge has its best share between the extremes.
    const Vmf near{normalize(Vec3(0.25f, 0, 1)), 30};
    const auto share = static_cast<double>(sums_of(near, 200000).best());
    EXPECT_GT(share, 0.1);
    EXPECT_LT(share, 0.9);
    EXPECT_LE(second_moment(near, share), 1.01 * second_moment(near, std::max(0.1, share - 0.1)));
    EXPECT_LE(second_moment(near, share), 1.01 * second_moment(near, share + 0.1));
}

TEST(Share, StaysWhereItIsUnprovenUntilThereIsEvidence) {
    EXPECT_EQ(ShareSums().best(), 0.3f);
    EXPECT_NEAR(sums_of(right, 3).best(), 0.3f, 0.1f);
    EXPECT_NEAR(sums_of(beside, 3).best(), 0.3f, 0.1f);
}

TEST(Share, OneFreakDecidesNothing) {
    ShareSums sums = sums_of(right, 20000);
    Pcg32 random(2);
    Record freak = draw(right, 0.5f, random);
    freak.scattered *= 1e12f;
    freak.guided_density = 0;
    sums.add(freak);
    EXPECT_NEAR(sums.best(), 0.3f, 0.1f);
}

TEST(Share, DoesNotDependOnTheUnitOfRadiance) {
    Pcg32 random(1);
    ShareSums dim, bright;
    for (int i = 0; i < 1000; ++i) {
        Record r = draw(right, 0.5f, random);
        dim.add(r);
        r.scattered *= 0x1p60f;
        bright.add(r);
    }
    EXPECT_EQ(dim.best(), bright.best());
}

TEST(Share, IsKeptByTheFieldAndForgottenWithTime) {
    const auto records = [](const Vmf& guide) {
        Pcg32 random(3);
        Records result;
        for (int i = 0; i < 100000; ++i) {
            result.push_back(draw(guide, 0.5f, random));
        }
        return result;
    };
    FitSettings settings;
    settings.leaf_samples = 1e9;
    Field field = Field::empty(Box3(Vec3(-1), Vec3(1)));
    field = fit(field, records(beside), settings, 1).field;
    EXPECT_GT(field.find(Vec3(0))->defensive_fraction(), 0.7f);
    for (int pass = 0; pass < 20; ++pass) {
        field = fit(field, records(right), settings, 1).field;
    }
    EXPECT_LT(field.find(Vec3(0))->defensive_fraction(), 0.3f);
    // Records that had no choice teach nothing about it.
    Records unguided = records(right);
    for (Record& r : unguided) {
        r.classical_density = r.guided_density = 0;
    }
    field = fit(Field::empty(field.bounds()), unguided, settings, 1).field;
    EXPECT_EQ(field.find(Vec3(0))->defensive_fraction(), 0.3f);
}

}  // namespace
}  // namespace wend::guide
