// The segments of a path against samples worked out by hand.
#include <tests/openpgl/training.h>

#include <gtest/gtest.h>

#include <limits>

namespace wend::test {
namespace {

/// Three vertices along x, a unit and then two apart, and light met at the last. Numbers are powers of two, so that
/// samples come out exactly.
class OpenPglPaths : public testing::Test {
protected:
    void SetUp() override {
        path.Reserve(8);
        first = path.NextSegment();
        pgl::SetPosition(first, {0, 0, 0});
        pgl::SetDirectionIn(first, {1, 0, 0});
        pgl::SetPDFDirectionIn(first, 0.25f);
        pgl::SetScatteringWeight(first, {0.5f, 0.5f, 0.5f});
        pgl::SetTransmittanceWeight(first, {0.5f, 0.25f, 0.125f});
        pgl::SetRussianRouletteProbability(first, 0.25f);
        pgl::SetDirectContribution(first, {64, 64, 64});
        pgl::SetScatteredContribution(first, {32, 32, 32});

        second = path.NextSegment();
        pgl::SetPosition(second, {1, 0, 0});
        pgl::SetDirectionIn(second, {1, 0, 0});
        pgl::SetPDFDirectionIn(second, 2);
        pgl::SetVolumeScatter(second, true);
        pgl::SetScatteringWeight(second, {0.5f, 0.25f, 1});
        pgl::SetTransmittanceWeight(second, {2, 2, 2});
        pgl::SetRussianRouletteProbability(second, 0.5f);
        pgl::AddScatteredContribution(second, {1, 2, 4});

        third = path.NextSegment();
        pgl::SetPosition(third, {3, 0, 0});
        pgl::SetDirectContribution(third, {8, 8, 8});
        pgl::SetMiWeight(third, 0.5f);
        pgl::SetScatteredContribution(third, {0, 0, 4});
    }

    std::vector<PGLSampleData> samples() {
        std::size_t count;
        const PGLSampleData* data = path.GetSamples(count);
        return {data, data + count};
    }
    std::vector<PGLZeroValueSampleData> zeros() {
        std::size_t count;
        const PGLZeroValueSampleData* data = path.GetZeroValueSamples(count);
        return {data, data + count};
    }

    pgl::PathSegmentStorage path;
    pgl::PathSegment *first, *second, *third;
};

TEST_F(OpenPglPaths, EveryFactorIsInItsPlace) {
    ASSERT_EQ(path.PrepareSamples(true, true, true), 2u);
    // From the end. At the second vertex: its flight (2) times the light met, weighted, and what is scattered there.
    const PGLSampleData at_second = samples()[0];
    EXPECT_EQ(to_vector(at_second.position), Vec3(1, 0, 0));
    EXPECT_EQ(to_vector(at_second.direction), Vec3(1, 0, 0));
    EXPECT_FLOAT_EQ(at_second.weight * at_second.pdf, (8 + 8 + 16) / 3.0f);
    EXPECT_EQ(at_second.pdf, 2);
    EXPECT_EQ(at_second.distance, 2);
    EXPECT_EQ(at_second.flags, std::uint32_t{PGLSampleData::EInsideVolume});
    // At the first vertex: its flight times what is scattered at the second, and what arrives there (8, 8, 16) times
    // the scattering weight over the survival. The survival at the first vertex is not in it.
    const PGLSampleData at_first = samples()[1];
    const float red = 0.5f * (1 + 0.5f / 0.5f * 8), green = 0.25f * (2 + 0.25f / 0.5f * 8),
                blue = 0.125f * (4 + 1 / 0.5f * 16);
    EXPECT_FLOAT_EQ(at_first.weight, (red + green + blue) / 3 / 0.25f);
    EXPECT_EQ(at_first.pdf, 0.25f);
    EXPECT_EQ(at_first.distance, 1);
    EXPECT_EQ(at_first.flags, std::uint32_t{PGLSampleData::ENextEventVolume});
    EXPECT_TRUE(zeros().empty());
    EXPECT_TRUE(path.Validate());
    // Prepared again, they are made anew.
    EXPECT_EQ(path.PrepareSamples(true, true, true), 2u);
}

TEST_F(OpenPglPaths, LightAtTheNextVertexFollowsTheRules) {
    path.PrepareSamples(false, true);  // without its weight
    EXPECT_FLOAT_EQ(samples()[0].weight * 2, (16 + 16 + 24) / 3.0f);
    // Further on it is always weighted, and counted.
    const float at_first = samples()[1].weight;
    path.PrepareSamples(false, false);  // none of it
    EXPECT_FLOAT_EQ(samples()[0].weight * 2, 8 / 3.0f);
    EXPECT_EQ(samples()[1].weight, at_first);
    path.PrepareSamples(true, true);
    EXPECT_EQ(samples()[1].weight, at_first);
}

TEST_F(OpenPglPaths, SurvivalCanBeLeftOutOfLightThatIsMet) {
    path.PrepareSamples(true, true, false);
    // Of the light met at the third vertex, 4 after its weight, the survival at the second is taken back out; of what
    // is scattered there it is not.
    const auto behind = [](float weight, float scattered) { return weight / 0.5f * 2 * (4 * 0.5f + scattered); };
    const float red = 0.5f * (1 + behind(0.5f, 0)), green = 0.25f * (2 + behind(0.25f, 0)),
                blue = 0.125f * (4 + behind(1, 4));
    EXPECT_FLOAT_EQ(samples()[1].weight * 0.25f, (red + green + blue) / 3);
    // No survival is before the light at the next vertex.
    EXPECT_FLOAT_EQ(samples()[0].weight * 2, (8 + 8 + 16) / 3.0f);
}

TEST_F(OpenPglPaths, TheEstimateIsThatOfTheWalk) {
    const float arrived = 0.5f * (1 + 0.5f / 0.5f * 8);
    EXPECT_FLOAT_EQ(path.CalculatePixelEstimate(true).x, 64 + 32 + 0.5f / 0.25f * arrived);
    const float met = 0.5f * (1 + 0.5f / 0.5f * 2 * 4 * 0.5f);
    EXPECT_FLOAT_EQ(path.CalculatePixelEstimate(false).x, 64 + 32 + 0.5f / 0.25f * met);
    path.Clear();
    EXPECT_EQ(path.CalculatePixelEstimate(true).x, 0);
    pgl::SetDirectContribution(path.NextSegment(), {1, 2, 3});
    EXPECT_EQ(path.CalculatePixelEstimate(true).y, 2);
}

TEST_F(OpenPglPaths, LightMetAloneIsMarked) {
    pgl::SetScatteredContribution(third, {0, 0, 0});
    path.PrepareSamples(true, true);
    EXPECT_TRUE(samples()[0].flags & PGLSampleData::EDirectLight);
    EXPECT_FALSE(samples()[1].flags & PGLSampleData::EDirectLight);
}

TEST_F(OpenPglPaths, WhatFoundNothingIsASampleToo) {
    pgl::SetDirectContribution(third, {0, 0, 0});
    pgl::SetScatteredContribution(third, {0, 0, 0});
    EXPECT_EQ(path.PrepareSamples(true, true), 1u);
    ASSERT_EQ(zeros().size(), 1u);
    EXPECT_TRUE(zeros()[0].volume);
    EXPECT_EQ(to_vector(zeros()[0].position), Vec3(1, 0, 0));
    EXPECT_EQ(path.GetNumZeroValueSamples(), 1);
    pgl::SampleStorage storage;
    path.PropagateSamples(&storage, true, true);
    EXPECT_EQ(storage.GetSizeSurface(), 1u);
    EXPECT_EQ(storage.GetSizeZeroValueVolume(), 1u);
    EXPECT_EQ(path.GetNumSegments(), 0);
}

TEST_F(OpenPglPaths, NothingIsClamped) {
    pgl::SetPDFDirectionIn(second, 1e-5f);
    pgl::SetTransmittanceWeight(second, {1e4f, 1e4f, 1e4f});
    path.PrepareSamples(true, true);
    EXPECT_EQ(samples()[0].pdf, 1e-5f);
    EXPECT_FLOAT_EQ(samples()[0].weight * 1e-5f, 1e4f * 16 / 3);
}

TEST_F(OpenPglPaths, MirrorsHaveNoSampleAndAddTheirDistance) {
    pgl::SetIsDelta(second, true);
    EXPECT_EQ(path.PrepareSamples(true, true), 1u);
    EXPECT_EQ(samples()[0].distance, 3);
    // Through a refraction by the square of the index, seen straight: the distance shrinks by the index.
    pgl::SetEta(second, 2);
    pgl::SetNormal(second, {-1, 0, 0});
    pgl::SetDirectionOut(second, {-1, 0, 0});
    path.PrepareSamples(true, true);
    EXPECT_EQ(samples()[0].distance, 2);
    // Rough enough to see its own light in, but not to be known by a density.
    pgl::SetIsDelta(second, false);
    pgl::SetRoughness(second, 0.005f);
    EXPECT_EQ(path.PrepareSamples(true, true), 1u);
    pgl::SetRoughness(second, 0.5f);
    EXPECT_EQ(path.PrepareSamples(true, true), 2u);
    EXPECT_EQ(samples()[1].distance, 1);
    path.SetMaxDistance(0.25f);
    path.PrepareSamples(true, true);
    EXPECT_EQ(samples()[1].distance, 0.5f);
}

TEST_F(OpenPglPaths, WhatIsWrongIsFoundAndNotHidden) {
    pgl::SetScatteredContribution(third, {NAN, 0, 0});
    EXPECT_FALSE(path.ValidateSegments());
    EXPECT_EQ(path.PrepareSamples(true, true), 2u);
    EXPECT_FALSE(path.ValidateSamples());
}

TEST_F(OpenPglPaths, TheClientsSamplesStay) {
    PGLSampleData own{};
    own.pdf = 7;
    path.AddSample(own);
    path.PrepareSamples(true, true);
    EXPECT_EQ(path.PrepareSamples(true, true), 3u);
    EXPECT_EQ(samples()[0].pdf, 7);
    path.Clear();
    EXPECT_EQ(path.GetNumSamples(), 0);
}

TEST(OpenPglPathLimits, RoomIsForAsManyAsWereReserved) {
    pgl::PathSegmentStorage path;
    EXPECT_EQ(path.NextSegment(), nullptr);
    for (const std::size_t most : {1, 2, 5, 100}) {
        path.Reserve(most);
        std::vector<pgl::PathSegment*> segments;
        for (std::size_t i = 0; i < most; ++i) {
            segments.push_back(path.NextSegment());
            ASSERT_NE(segments.back(), nullptr);
        }
        EXPECT_EQ(path.NextSegment(), nullptr);
        path.AddSegment({});
        EXPECT_EQ(path.GetNumSegments(), static_cast<int>(most));
        // Segments stay where they are, for connections that come back later.
        EXPECT_EQ(segments.back(), segments.front() + (most - 1));
        path.PrepareSamples(true, true);
        path.Clear();
    }
    // The same again keeps what is there, another number does not.
    path.NextSegment();
    path.Reserve(100);
    EXPECT_EQ(path.GetNumSegments(), 1);
    path.Reserve(200);
    EXPECT_EQ(path.GetNumSegments(), 0);
    // What cannot be had leaves what there was.
    path.Reserve(std::numeric_limits<std::size_t>::max());
    EXPECT_NE(path.NextSegment(), nullptr);
    pgl::SetPosition(nullptr, {1, 2, 3});
}

}  // namespace
}  // namespace wend::test
