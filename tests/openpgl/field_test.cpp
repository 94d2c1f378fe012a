// Fields: bounds that are given or found, files, statistics, and handles that are none.
#include <tests/openpgl/training.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace wend::test {
namespace {

const pgl_point3f somewhere{0.4f, 0.5f, 0.6f};

/// The greatest ratio of two fields' densities over a few places and directions.
float difference(const pgl::Field& a, const pgl::Field& b) {
    pgl::SurfaceSamplingDistribution at_a(&a), at_b(&b);
    Pcg32 random(9);
    float most = 1;
    for (int i = 0; i < 200; ++i) {
        const pgl_point3f p{random.uniform(), random.uniform(), random.uniform()};
        const pgl_vec3f w = to_pgl(to_sphere(random.uniform2()));
        float u = 0;
        EXPECT_TRUE(at_a.Init(&a, p, u) && at_b.Init(&b, p, u));
        const float ratio = at_a.PDF(w) / at_b.PDF(w);
        most = std::max({most, ratio, 1 / ratio});
    }
    return most;
}

TEST(OpenPglField, BoundsAreGivenOrFound) {
    TrainedRenderer renderer;
    const pgl_box3f found = renderer.field.GetSceneBounds();
    // The unit cube and a tenth of its diagonal.
    EXPECT_NEAR(found.lower.x, -0.173f, 0.005f);
    EXPECT_NEAR(found.upper.z, 1.173f, 0.005f);
    pgl::Field told(&renderer.device, renderer.config);
    EXPECT_GT(told.GetSceneBounds().lower.x, told.GetSceneBounds().upper.x);
    told.SetSceneBounds(pgl::Box3(0, 0, 0, 1, 1, 1));
    told.Update(renderer.samples);
    EXPECT_EQ(told.GetSceneBounds().upper.y, 1);
    EXPECT_TRUE(told.Validate());
    // Both learned the same light, from cells that were cut a little differently.
    EXPECT_LT(difference(renderer.field, told), 1.6f);
    // Bounds that are none are not taken, and records outside are learned from.
    pgl::Field odd(&renderer.device, renderer.config);
    odd.SetSceneBounds(pgl::Box3(0, 0, 0, 1, -1, 1));
    odd.SetSceneBounds(pgl::Box3(0, 0, 0, 1, NAN, 1));
    odd.Update(renderer.samples);
    EXPECT_TRUE(odd == renderer.field);
    pgl::Field small(&renderer.device, renderer.config);
    small.SetSceneBounds(pgl::Box3(0.4f, 0.4f, 0.4f, 0.6f, 0.6f, 0.6f));
    small.Update(renderer.samples);
    EXPECT_LT(difference(renderer.field, small), 1.6f);
}

TEST(OpenPglField, OnePointIsAScene) {
    Renderer renderer;
    std::vector<PGLSampleData> samples = made_up_samples(1000);
    for (PGLSampleData& sample : samples) {
        sample.position = {3, 4, 5};
    }
    renderer.add(samples);
    pgl::Field field(&renderer.device, renderer.config);
    field.Update(renderer.samples);
    pgl::SurfaceSamplingDistribution surface(&field);
    float u = 0;
    EXPECT_TRUE(surface.Init(&field, {3, 4, 5}, u));
}

TEST(OpenPglField, CountsUpdatesAndForgets) {
    Renderer renderer;
    pgl::Field field(&renderer.device, renderer.config);
    EXPECT_EQ(field.GetIteration(), 0u);
    field.Update(renderer.samples);  // nothing to learn, and an update all the same
    EXPECT_EQ(field.GetIteration(), 1u);
    renderer.add(made_up_samples(5000));
    field.UpdateVolume(renderer.samples);
    pgl::SurfaceSamplingDistribution surface(&field);
    pgl::VolumeSamplingDistribution volume(&field);
    float u = 0;
    EXPECT_TRUE(volume.Init(&field, somewhere, u));
    EXPECT_FALSE(surface.Init(&field, somewhere, u));
    field.UpdateSurface(renderer.samples);
    EXPECT_TRUE(surface.Init(&field, somewhere, u));
    EXPECT_EQ(field.GetIteration(), 3u);
    field.Reset();
    EXPECT_EQ(field.GetIteration(), 0u);
    EXPECT_FALSE(surface.Init(&field, somewhere, u));
    EXPECT_GT(field.GetSceneBounds().lower.x, field.GetSceneBounds().upper.x);
    // What is learned afterwards is what a new field learns.
    field.Update(renderer.samples);
    pgl::Field fresh(&renderer.device, renderer.config);
    fresh.Update(renderer.samples);
    EXPECT_TRUE(field == fresh);
}

TEST(OpenPglField, ComesBackFromAFileAndLearnsOn) {
    const std::string file = testing::TempDir() + "/openpgl_field.bin";
    TrainedRenderer renderer(10000);
    ASSERT_TRUE(renderer.field.Store(file));
    pgl::Field again(&renderer.device, file);
    EXPECT_TRUE(again == renderer.field);
    EXPECT_EQ(again.GetIteration(), 1u);
    EXPECT_EQ(again.GetSceneBounds().lower.x, renderer.field.GetSceneBounds().lower.x);
    again.Update(renderer.samples);
    EXPECT_FALSE(again == renderer.field);
    renderer.field.Update(renderer.samples);
    EXPECT_TRUE(again == renderer.field);
    // One that has learned nothing is a field as well.
    pgl::Field empty(&renderer.device, renderer.config);
    ASSERT_TRUE(empty.Store(file));
    EXPECT_TRUE(pgl::Field(&renderer.device, file) == empty);

    ASSERT_TRUE(renderer.field.Store(file));
    std::ifstream in(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    for (const std::size_t place : {std::size_t{0}, std::size_t{9}, bytes.size() / 2, bytes.size() - 1}) {
        std::string changed = bytes;
        changed[place] = static_cast<char>(changed[place] ^ 1);
        std::ofstream(file, std::ios::binary) << changed;
        EXPECT_THROW(pgl::Field(&renderer.device, file), std::runtime_error) << place;
    }
    std::ofstream(file, std::ios::binary) << bytes.substr(0, bytes.size() - 10);
    EXPECT_THROW(pgl::Field(&renderer.device, file), std::runtime_error);
    EXPECT_THROW(pgl::Field(&renderer.device, file + ".none"), std::runtime_error);
    EXPECT_FALSE(renderer.field.Store("/nowhere/at/all"));
}

TEST(OpenPglField, SaysWhatItHolds) {
    TrainedRenderer renderer(10000);
    const pgl::FieldStatistics statistics = renderer.field.GetSurfaceStatistics();
    EXPECT_NE(statistics.ToString().find("samples of the last update: 5000\n"), std::string::npos);
    const std::string header = statistics.HeaderCSVString(), row = statistics.ToCSVString();
    EXPECT_EQ(std::count(header.begin(), header.end(), ','), std::count(row.begin(), row.end(), ','));
    EXPECT_EQ(row.substr(0, 2), "1,");
}

TEST(OpenPglField, IsConfigured) {
    TrainedRenderer renderer(40000);
    const auto cells = [&](const pgl::FieldConfig& config) {
        pgl::Field field(&renderer.device, config);
        field.Update(renderer.samples);
        return std::stoi(field.GetSurfaceStatistics().ToCSVString().substr(2));
    };
    pgl::FieldConfig config;
    EXPECT_GT(cells(config), 1);  // one that was not initialized is the default
    EXPECT_EQ(cells(config), cells(renderer.config));
    config.Init(PGL_SPATIAL_STRUCTURE_KDTREE, PGL_DIRECTIONAL_DISTRIBUTION_QUADTREE, false, 4000000);
    EXPECT_EQ(cells(config), 1);
    config.Init(PGL_SPATIAL_STRUCTURE_KDTREE, PGL_DIRECTIONAL_DISTRIBUTION_VMM);
    EXPECT_EQ(cells(config), cells(renderer.config));
    config.SetUseKnnLookup(true);
    config.SetUseKnnIsLookup(true);
    config.SetDebugArgFitRegions(false);
    config.SetSpatialStructureArgMaxDepth(1);
    EXPECT_EQ(cells(config), 2);
    config.SetSpatialStructureArgMaxDepth(100000);
    EXPECT_EQ(cells(config), cells(renderer.config));
}

TEST(OpenPglField, NullsDoNoHarm) {
    pgl::FieldConfig config;
    pgl::Field field(nullptr, config);
    pgl::SampleStorage samples;
    const std::vector<PGLSampleData> some = made_up_samples(10);
    samples.AddSamples(some.data(), some.size());
    field.Update(samples);
    field.SetSceneBounds({});
    field.Reset();
    EXPECT_FALSE(field.Validate());
    EXPECT_FALSE(field == field);
    EXPECT_EQ(field.GetIteration(), 0u);
    EXPECT_EQ(field.GetSurfaceStatistics().ToString(), "");
    EXPECT_FALSE(field.Store("/tmp/never"));
    pgl::SurfaceSamplingDistribution surface(&field);
    float u = 0;
    EXPECT_FALSE(surface.Init(&field, somewhere, u));
    EXPECT_FALSE(surface.Init(nullptr, somewhere, u));
    EXPECT_FLOAT_EQ(pglSurfaceSamplingDistributionPDF(nullptr, {0, 0, 1}), inv_4pi);
    EXPECT_NEAR(length(to_vector(pglVolumeSamplingDistributionSample(nullptr, {2, NAN}))), 1, 1e-5f);
    pglVolumeSamplingDistributionApplySingleLobeHenyeyGreensteinProduct(nullptr, {0, 0, 1}, NAN);
    pglSampleStorageAddSamples(nullptr, some.data(), 10);
    samples.AddSamples(nullptr, 10);
    samples.AddZeroValueSamples(nullptr, 10);
    EXPECT_EQ(samples.GetSizeSurface(), 5u);
    pgl::PathSegmentStorage path;
    path.PropagateSamples(nullptr, true, true);
    std::size_t count = 1;
    EXPECT_EQ(pglPathSegmentStorageGetSamples(nullptr, count), nullptr);
    EXPECT_EQ(count, 0u);
    EXPECT_EQ(pglPathSegmentStorageNextSegment(nullptr), nullptr);
    EXPECT_EQ(pglDeviceNewFieldFromFile(nullptr, nullptr), nullptr);
    pglReleaseField(nullptr);
    // Handles of another kind are none.
    const PGLDevice device = pglNewDevice(PGL_DEVICE_TYPE_NONE);
    pglReleaseField(reinterpret_cast<PGLField>(device));
    EXPECT_EQ(pglFieldGetIteration(reinterpret_cast<PGLField>(device)), 0u);
    EXPECT_FALSE(pglFieldStoreToFile(reinterpret_cast<PGLField>(device), "/tmp/never"));
    pglReleaseDevice(device);
    pglReleaseString({});
}

TEST(OpenPglRoulette, FollowsTheWindow) {
    using namespace pgl::util;
    const pgl_vec3f half{0.5f, 0.5f, 0.5f}, one{1, 1, 1}, dark{0, 0, 0};
    EXPECT_EQ(StandardThroughputBasedRussianRoulette({0.1f, 0.5f, 0.2f}), 0.5f);
    EXPECT_EQ(StandardThroughputBasedRussianRoulette(dark, 0.1f), 0.1f);
    // The window's lower edge is a third of reference over adjoint.
    EXPECT_FLOAT_EQ(GuidedRussianRoulette({0.1f, 0.1f, 0.1f}, one, one), 0.3f);
    EXPECT_EQ(GuidedRussianRoulette(half, one, one), 1);
    EXPECT_EQ(GuidedRussianRoulette({0.01f, 0.01f, 0.01f}, one, one, 0.1f, 0.95f), 0.1f);
    EXPECT_EQ(GuidedRussianRoulette(half, dark, one), 1);
    EXPECT_EQ(GuidedRussianRoulette(half, {NAN, NAN, NAN}, one), 1);
}

}  // namespace
}  // namespace wend::test
