// Samples of a made-up light for tests, and fields that learned from them.
#pragma once

#include <openpgl/cpp/OpenPGL.h>
#include <wend/core/random.h>
#include <wend/core/vector.h>
#include <wend/sampling/warp.h>

#include <cmath>
#include <vector>

namespace wend::test {

namespace pgl = ::openpgl::cpp;

inline Vec3 to_vector(const pgl_vec3f& v) {
    return {v.x, v.y, v.z};
}
inline pgl_vec3f to_pgl(const Vec3& v) {
    return {v.x, v.y, v.z};
}

/// The radiance of a broad glow around +z and a narrower one, of eight times the radiance, around +x.
inline float made_up_radiance(const Vec3& w) {
    return std::exp(3 * (w.z - 1)) + 8 * std::exp(30 * (w.x - 1));
}

/// Samples at places in the unit cube, their directions uniform, half of them in volumes.
inline std::vector<PGLSampleData> made_up_samples(int count, std::uint64_t seed = 1) {
    Pcg32 random(seed);
    std::vector<PGLSampleData> samples;
    for (int i = 0; i < count; ++i) {
        const Vec3 w = to_sphere(random.uniform2());
        PGLSampleData sample{};
        sample.position = {random.uniform(), random.uniform(), random.uniform()};
        sample.direction = to_pgl(w);
        sample.weight = made_up_radiance(w) / inv_4pi;
        sample.pdf = inv_4pi;
        sample.distance = 100;
        sample.flags = i % 2 == 0 ? 0u : std::uint32_t{PGLSampleData::EInsideVolume};
        samples.push_back(sample);
    }
    return samples;
}

/// A device, a field and samples, as a renderer has them.
struct Renderer {
    pgl::Device device{PGL_DEVICE_TYPE_CPU_8};
    pgl::FieldConfig config;
    pgl::SampleStorage samples;

    Renderer() { config.Init(PGL_SPATIAL_STRUCTURE_KDTREE, PGL_DIRECTIONAL_DISTRIBUTION_PARALLAX_AWARE_VMM); }
    void add(const std::vector<PGLSampleData>& more) { samples.AddSamples(more.data(), more.size()); }
};

/// The same with a field that has learned the made-up light.
struct TrainedRenderer : Renderer {
    pgl::Field field{&device, config};

    explicit TrainedRenderer(int count = 40000) {
        add(made_up_samples(count));
        field.Update(samples);
    }
};

}  // namespace wend::test
