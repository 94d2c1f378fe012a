// Rays, walks and camera samples per second on three of the project's scenes. Google Benchmark's items are those.
#include <wend/io/load/load_scene.h>
#include <wend/render/render.h>
#include <wend/transport/path_tracer.h>

#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <string>

namespace wend {
namespace {

struct Loaded {
    explicit Loaded(LoadedScene l)
        : resolution(l.resolution), max_depth(l.max_depth), filter(l.filter), scene(std::move(l.scene)) {}

    Vec2i resolution;
    int max_depth;
    Filter filter;
    Scene scene;
};

const Loaded& scene_named(const char* name) {
    static std::map<std::string, std::unique_ptr<Loaded>> scenes;
    auto& entry = scenes[name];
    if (!entry) {
        entry = std::make_unique<Loaded>(load_scene(std::string(WEND_SOURCE_DIR) + "/scenes/" + name + ".pbrt"));
    }
    return *entry;
}

Ray camera_ray(const Loaded& loaded, Sampler& sampler) {
    const Vec2 u = sampler.uniform2();
    return loaded.scene.camera().ray(
        {u.x * static_cast<float>(loaded.resolution.x), u.y * static_cast<float>(loaded.resolution.y)},
        sampler.uniform2());
}

void rays(benchmark::State& state, const char* name) {
    const Loaded& loaded = scene_named(name);
    std::uint32_t i = 0;
    for (auto _ : state) {
        Sampler sampler(SamplerKind::independent, 1, 0, i++);
        benchmark::DoNotOptimize(loaded.scene.intersect(camera_ray(loaded, sampler)));
    }
    state.SetItemsProcessed(state.iterations());
}

void walks(benchmark::State& state, const char* name) {
    const Loaded& loaded = scene_named(name);
    const ClassicalDecisions decisions;
    const SubsurfaceGuides unguided;
    const LightSelection lights(loaded.scene);
    const ReflectionProbability reflections(loaded.scene.bounds());
    const PathTracer<ClassicalDecisions> tracer(loaded.scene, decisions, unguided, lights, reflections,
                                                loaded.max_depth);
    std::uint32_t i = 0;
    std::uint64_t segments = 0;
    for (auto _ : state) {
        Sampler sampler(SamplerKind::sobol, 1, i % 1000, i / 1000);
        ++i;
        WalkResult result = tracer.trace(camera_ray(loaded, sampler), 0, sampler);
        segments += result.sample.segments;
        benchmark::DoNotOptimize(result);
    }
    state.SetItemsProcessed(state.iterations());
    state.counters["segments"] = static_cast<double>(segments) / static_cast<double>(state.iterations());
}

void camera_samples(benchmark::State& state, const char* name, const char* preset) {
    const Loaded& loaded = scene_named(name);
    RenderSettings settings;
    settings.preset = parse_preset(preset);
    settings.samples = 8;
    settings.max_depth = loaded.max_depth;
    settings.filter = loaded.filter;
    std::uint64_t paths = 0;
    for (auto _ : state) {
        Film film(loaded.resolution, {{0, 0}, loaded.resolution});
        paths += render(loaded.scene, film, settings).counts.paths;
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(paths));
}

BENCHMARK_CAPTURE(rays, haze, "haze");
BENCHMARK_CAPTURE(rays, cloud, "cloud");
BENCHMARK_CAPTURE(rays, liquid, "liquid");
BENCHMARK_CAPTURE(walks, haze, "haze");
BENCHMARK_CAPTURE(walks, cloud, "cloud");
BENCHMARK_CAPTURE(walks, liquid, "liquid");
BENCHMARK_CAPTURE(camera_samples, haze, "haze", "classical")->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(camera_samples, haze_guided, "haze", "direction")->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(camera_samples, cloud, "cloud", "classical")->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(camera_samples, cloud_guided, "cloud", "direction")->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(camera_samples, liquid, "liquid", "classical")->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(camera_samples, liquid_guided, "liquid", "direction")->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wend
