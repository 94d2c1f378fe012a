// What a segment of a walk costs once its guide is trained, by preset, beside what a classical one does: the renderer's
// own passes, on one thread, through homogeneous media: a thin one among surfaces and a dense one.
#include <wend/io/load/load_scene.h>
#include <wend/render/render.h>

#include <benchmark/benchmark.h>

#include <ctime>
#include <string>
#include <utility>

namespace wend {
namespace {

/// How far a render was at the end of a pass.
struct Mark {
    double seconds = 0;  ///< of processor time
    double segments = 0;
};

Mark mark(const Film& film, int samples) {
    Mark m{static_cast<double>(std::clock()) / CLOCKS_PER_SEC, 0};
    for (const Layer& layer : film.walk_layers()) {
        if (layer.name == "segments") {
            for (const float mean : layer.values) {
                m.segments += static_cast<double>(mean) * samples;
            }
        }
    }
    return m;
}

void segments(benchmark::State& state, const char* scene_name, const char* preset) {
    LoadedScene loaded = load_scene(std::string(WEND_SOURCE_DIR "/scenes/") + scene_name + ".pbrt", {Vec2i(128, 72)});
    const Scene scene(std::move(loaded.scene));
    RenderSettings settings;
    settings.preset = parse_preset(preset);
    settings.max_depth = loaded.max_depth;
    settings.filter = loaded.filter;
    settings.threads = 1;
    // The passes that teach, as every render has them, and one that only follows: it is what is measured.
    settings.passes = {1, 2, 4, 8, 16, 32, 16};
    for (auto _ : state) {
        Film film(loaded.resolution, {{0, 0}, loaded.resolution});
        Mark before_last;
        Mark last;
        const RenderStatistics statistics = render(scene, film, settings, [&](const RenderProgress& progress) {
            before_last = std::exchange(last, mark(film, progress.samples));
            return true;
        });
        const double seconds = last.seconds - before_last.seconds;
        const double walked = last.segments - before_last.segments;
        const double walks = static_cast<double>(loaded.resolution.x * loaded.resolution.y) * settings.passes.back();
        state.SetIterationTime(seconds);
        state.counters["ns_per_segment"] = 1e9 * seconds / walked;
        state.counters["segments_per_walk"] = walked / walks;
        state.counters["field_bytes"] = static_cast<double>(statistics.field_bytes);
    }
}

void once(benchmark::internal::Benchmark* row) {
    row->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(segments, fog_classical, "fog-door", "classical")->Apply(once);
BENCHMARK_CAPTURE(segments, fog_direction, "fog-door", "direction")->Apply(once);
BENCHMARK_CAPTURE(segments, fog_distance_direction, "fog-door", "distance+direction")->Apply(once);
BENCHMARK_CAPTURE(segments, fog_full, "fog-door", "distance+direction+roulette+splitting")->Apply(once);
BENCHMARK_CAPTURE(segments, shield_classical, "shield-duct", "classical")->Apply(once);
BENCHMARK_CAPTURE(segments, shield_direction, "shield-duct", "direction")->Apply(once);
BENCHMARK_CAPTURE(segments, shield_distance_direction, "shield-duct", "distance+direction")->Apply(once);
BENCHMARK_CAPTURE(segments, shield_full, "shield-duct", "distance+direction+roulette+splitting")->Apply(once);

}  // namespace
}  // namespace wend
