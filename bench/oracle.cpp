// How much of what a perfect guide would bring the learned field does bring. An oracle is a field that was taught by
// sixteen times the records and then stays as it is; a guide from it errs by what its form cannot tell, not by noise.
#include <wend/film/metrics.h>
#include <wend/io/load/load_scene.h>
#include <wend/render/render.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <string>

namespace wend {
namespace {

// Per pixel: with all passes that teach and one more.
constexpr int samples = 95;
constexpr int seeds = 3;
const Vec2i twin(96, 54), teaching(384, 216);

/// One scene at one size.
class Studio {
public:
    Studio(const std::string& scene_name, const Vec2i& resolution)
        : Studio(load_scene(std::string(WEND_SOURCE_DIR "/scenes/") + scene_name + ".pbrt", {resolution})) {}

    struct Take {
        Image image;
        std::shared_ptr<const guide::Fields> fields;
    };
    /// With given fields they are followed and not taught.
    Take shoot(const char* preset, int spp, std::uint64_t seed,
               std::shared_ptr<const guide::Fields> fields = nullptr) const {
        RenderSettings settings;
        settings.preset = parse_preset(preset);
        settings.samples = spp;
        settings.seed = seed;
        settings.max_depth = max_depth_;
        settings.filter = filter_;
        settings.most_records = 1e9;
        if (fields) {
            settings.fields = std::move(fields);
            settings.training_samples = 0;
        }
        Film film(resolution_, {{0, 0}, resolution_});
        const RenderStatistics statistics = render(scene_, film, settings);
        return {film.beauty(), statistics.fields};
    }

private:
    explicit Studio(LoadedScene loaded)
        : resolution_(loaded.resolution),
          max_depth_(loaded.max_depth),
          filter_(loaded.filter),
          scene_(std::move(loaded.scene)) {}

    Vec2i resolution_;
    int max_depth_;
    Filter filter_;
    Scene scene_;
};

/// Mean error of several pictures.
struct Error {
    double whole = 0, trimmed = 0;

    void add(const Metrics& m) {
        whole += m.relmse / seeds;
        trimmed += m.relmse_trimmed / seeds;
    }
};

void oracle(benchmark::State& state, const char* scene_name) {
    const Studio studio(scene_name, twin);
    for (auto _ : state) {
        const auto taught = Studio(scene_name, teaching).shoot("full", RenderSettings().training_samples, 100).fields;
        const Reference reference{studio.shoot("full", samples, 101, taught).image,
                                  studio.shoot("full", samples, 102, taught).image};
        Error classical, learning, learned, perfect;
        for (int seed = 1; seed <= seeds; ++seed) {
            classical.add(measure(studio.shoot("classical", samples, seed).image, reference));
            const Studio::Take own = studio.shoot("full", samples, seed);
            learning.add(measure(own.image, reference));
            learned.add(measure(studio.shoot("full", samples, seed + 10, own.fields).image, reference));
            perfect.add(measure(studio.shoot("full", samples, seed, taught).image, reference));
        }
        const auto tell = [&](const std::string& name, double Error::*error) {
            state.counters[name + "classical"] = classical.*error;
            state.counters[name + "gain"] = classical.*error / learning.*error;
            state.counters[name + "gain_learned"] = classical.*error / learned.*error;
            state.counters[name + "gain_oracle"] = classical.*error / perfect.*error;
            state.counters[name + "share"] = perfect.*error / learning.*error;
        };
        tell("", &Error::whole);
        tell("trimmed_", &Error::trimmed);
    }
}

void once(benchmark::internal::Benchmark* row) {
    row->Iterations(1)->UseRealTime()->Unit(benchmark::kSecond);
}

BENCHMARK_CAPTURE(oracle, fog_door, "fog-door")->Apply(once);
BENCHMARK_CAPTURE(oracle, shield_duct, "shield-duct")->Apply(once);
BENCHMARK_CAPTURE(oracle, cloud, "cloud")->Apply(once);

}  // namespace
}  // namespace wend
