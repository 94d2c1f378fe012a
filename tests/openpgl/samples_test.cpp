// Sample storages: many threads, no order, and files.
#include <tests/openpgl/training.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <string>
#include <thread>

namespace wend::test {
namespace {

std::vector<PGLZeroValueSampleData> made_up_zeros(int count) {
    Pcg32 random(7);
    std::vector<PGLZeroValueSampleData> zeros;
    for (int i = 0; i < count; ++i) {
        zeros.push_back(
            {{random.uniform(), random.uniform(), random.uniform()}, to_pgl(to_sphere(random.uniform2())), i % 3 == 0});
    }
    return zeros;
}

/// Adds all from so many threads, each taking what it finds next.
void add_by_threads(pgl::SampleStorage& storage, const std::vector<PGLSampleData>& samples,
                    const std::vector<PGLZeroValueSampleData>& zeros, int count) {
    std::atomic<std::size_t> next{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < count; ++t) {
        threads.emplace_back([&] {
            for (std::size_t i = next++; i < samples.size(); i = next++) {
                if (i % 5 == 0) {
                    storage.AddSamples(&samples[i], 1);
                } else {
                    storage.AddSample(samples[i]);
                }
                if (i < zeros.size()) {
                    storage.AddZeroValueSample(zeros[i]);
                }
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
}

TEST(OpenPglSamples, WhatIsLearnedDependsOnNoOrder) {
    std::vector<PGLSampleData> samples = made_up_samples(20000);
    const std::vector<PGLZeroValueSampleData> zeros = made_up_zeros(3000);
    Renderer renderer;
    renderer.add(samples);
    renderer.samples.AddZeroValueSamples(zeros.data(), zeros.size());
    pgl::Field field(&renderer.device, renderer.config);
    field.Update(renderer.samples);
    field.Update(renderer.samples);
    std::reverse(samples.begin(), samples.end());
    for (const int threads : {1, 3, 8}) {
        pgl::SampleStorage other;
        add_by_threads(other, samples, zeros, threads);
        EXPECT_TRUE(other == renderer.samples);
        pgl::Device device(PGL_DEVICE_TYPE_CPU_16, static_cast<std::size_t>(threads));
        pgl::Field same(&device, renderer.config);
        same.Update(other);
        same.Update(other);
        EXPECT_TRUE(same == field) << threads;
    }
    // The twin: another sample is another field.
    renderer.samples.AddSample(samples.front());
    pgl::Field another(&renderer.device, renderer.config);
    another.Update(renderer.samples);
    another.Update(renderer.samples);
    EXPECT_FALSE(another == field);
}

TEST(OpenPglSamples, AreKeptByHalfAndValue) {
    pgl::SampleStorage storage;
    const std::vector<PGLSampleData> samples = made_up_samples(10);
    const std::vector<PGLZeroValueSampleData> zeros = made_up_zeros(9);
    storage.Reserve(100, 100);
    storage.AddSamples(samples.data(), samples.size());
    storage.AddZeroValueSamples(zeros.data(), zeros.size());
    EXPECT_EQ(storage.GetSizeSurface(), 5u);
    EXPECT_EQ(storage.GetSizeVolume(), 5u);
    EXPECT_EQ(storage.GetSizeZeroValueSurface(), 6u);
    EXPECT_EQ(storage.GetSizeZeroValueVolume(), 3u);
    EXPECT_EQ(storage.GetSampleSurface(1).weight, samples[2].weight);
    EXPECT_EQ(storage.GetSampleVolume(1).weight, samples[3].weight);
    EXPECT_EQ(storage.GetZeroValueSampleVolume(1).position.x, zeros[3].position.x);
    EXPECT_EQ(storage.GetZeroValueSampleSurface(0).position.x, zeros[1].position.x);
    for (const int beyond : {-1, 5, 1 << 30}) {
        EXPECT_EQ(storage.GetSampleSurface(beyond).weight, 0);
    }
    EXPECT_TRUE(storage.Validate());
    pgl::SampleStorage both;
    both.Merge(storage);
    EXPECT_TRUE(both == storage);
    both.Merge(both);
    EXPECT_EQ(both.GetSizeSurface(), 10u);
    storage.ClearSurface();
    EXPECT_EQ(storage.GetSizeSurface() + storage.GetSizeZeroValueSurface(), 0u);
    EXPECT_EQ(storage.GetSizeVolume(), 5u);
    storage.Clear();
    EXPECT_EQ(storage.GetSizeVolume() + storage.GetSizeZeroValueVolume(), 0u);
    PGLSampleData bad = samples[0];
    bad.direction = {2, 0, 0};
    storage.AddSample(bad);
    EXPECT_FALSE(storage.Validate());
}

TEST(OpenPglSamples, ComeBackFromFiles) {
    const std::string file = testing::TempDir() + "/openpgl_samples.bin";
    pgl::SampleStorage storage;
    const std::vector<PGLSampleData> samples = made_up_samples(100);
    const std::vector<PGLZeroValueSampleData> zeros = made_up_zeros(20);
    add_by_threads(storage, samples, zeros, 3);
    ASSERT_TRUE(storage.Store(file));
    EXPECT_TRUE(pgl::SampleStorage(file) == storage);
    std::ifstream in(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    for (const std::size_t place : {std::size_t{0}, std::size_t{9}, bytes.size() / 2, bytes.size() - 1}) {
        std::string changed = bytes;
        changed[place] = static_cast<char>(changed[place] ^ 1);
        std::ofstream(file, std::ios::binary) << changed;
        EXPECT_THROW(pgl::SampleStorage{file}, std::runtime_error) << place;
    }
    std::ofstream(file, std::ios::binary) << bytes.substr(0, bytes.size() / 2);
    EXPECT_THROW(pgl::SampleStorage{file}, std::runtime_error);
    EXPECT_THROW(pgl::SampleStorage{file + ".none"}, std::runtime_error);
    EXPECT_FALSE(storage.Store("/nowhere/at/all"));
}

// Zeros lower the fluence: a field without them takes what is rarely lit for bright.
TEST(OpenPglSamples, ZerosCount) {
    Renderer renderer;
    const std::vector<PGLSampleData> samples = made_up_samples(10000);
    renderer.add(samples);
    std::vector<PGLZeroValueSampleData> zeros;
    for (const PGLSampleData& sample : samples) {
        zeros.push_back({sample.position, sample.direction, (sample.flags & PGLSampleData::EInsideVolume) != 0});
    }
    const auto fluence = [&] {
        pgl::Field field(&renderer.device, renderer.config);
        field.Update(renderer.samples);
        pgl::VolumeSamplingDistribution volume(&field);
        float u = 0;
        EXPECT_TRUE(volume.Init(&field, {0.5f, 0.5f, 0.5f}, u));
        return volume.Fluence(true).x;
    };
    const float without = fluence();
    renderer.samples.AddZeroValueSamples(zeros.data(), zeros.size());
    EXPECT_NEAR(fluence() / without, 0.5, 0.1);
}

// What a path propagates keeps its colour, what is added as a plain sample is grey.
TEST(OpenPglSamples, PathsBringColour) {
    Renderer renderer;
    pgl::PathSegmentStorage path;
    path.Reserve(2);
    Pcg32 random(3);
    for (int i = 0; i < 2000; ++i) {
        pgl::PathSegment* segment = path.NextSegment();
        pgl::SetPosition(segment, {random.uniform(), random.uniform(), random.uniform()});
        pgl::SetDirectionIn(segment, to_pgl(to_sphere(random.uniform2())));
        pgl::SetPDFDirectionIn(segment, inv_4pi);
        pgl::SetVolumeScatter(segment, true);
        segment = path.NextSegment();
        pgl::SetPosition(segment, {5, 5, 5});
        pgl::SetScatteredContribution(segment, {3, 2, 1});
        path.PropagateSamples(&renderer.samples, true, true);
    }
    pgl::Field field(&renderer.device, renderer.config);
    field.Update(renderer.samples);
    pgl::VolumeSamplingDistribution volume(&field);
    float u = 0;
    ASSERT_TRUE(volume.Init(&field, {0.5f, 0.5f, 0.5f}, u));
    const pgl_vec3f fluence = volume.Fluence(true);
    EXPECT_NEAR(fluence.x, 3 * 4 * pi, 0.02f * 3 * 4 * pi);
    EXPECT_NEAR(fluence.z, 4 * pi, 0.02f * 4 * pi);
}

}  // namespace
}  // namespace wend::test
