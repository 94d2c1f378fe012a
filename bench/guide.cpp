// Cost of asking the learned field and of training it.
#include <wend/core/parallel.h>
#include <wend/core/random.h>
#include <wend/guide/fit.h>
#include <wend/guide/path_records.h>
#include <wend/medium/phase.h>

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <vector>

namespace {

using namespace wend;
using namespace wend::guide;

const Box3 unit_box(Vec3(0, 0, 0), Vec3(1, 1, 1));
constexpr std::size_t queries = 1024;

/// Radiance of equal lamps on a spiral around the box, as many as cells are to have lobes.
Records lamp_records(int lamps, std::size_t count, std::uint64_t seed) {
    constexpr float golden_angle = 2.39996323f;
    Pcg32 random(seed);
    Records records;
    records.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec2 u = random.uniform2();
        const Vec3 position(u.x, u.y, random.uniform());
        const auto lamp = std::floor(static_cast<float>(lamps) * random.uniform());
        const float z = 1 - (2 * lamp + 1) / static_cast<float>(lamps), r = std::sqrt(1 - z * z);
        const Vec3 centre = Vec3(0.5f, 0.5f, 0.5f) +
                            Vec3(r * std::cos(golden_angle * lamp), r * std::sin(golden_angle * lamp), z) * 3.0f;
        const Vmf lobe{normalize(centre - position), 50};
        const Vec3 w = lobe.sample(random.uniform2());
        records.push_back({position, w, lobe.density(w), lobe.density(w), length(centre - position)});
    }
    return records;
}

FitSettings settings_with(int lobes) {
    FitSettings settings;
    settings.lobes = settings.most_lobes = lobes;
    return settings;
}

/// A guided direction at a surface or in a medium.
struct Query {
    Vec3 position;
    Vec2 u;
    AxialLobes lobes;
};

/// Lobes along random axes.
std::vector<Query> random_queries(const AxialLobes& lobes) {
    Pcg32 random(7);
    std::vector<Query> result;
    for (std::size_t i = 0; i < queries; ++i) {
        const Vec2 u = random.uniform2();
        const Vec3 position(u.x, u.y, random.uniform());
        const Vec3 axis = Vmf{}.sample(random.uniform2());
        result.push_back({position, random.uniform2(), lobes.around(axis)});
    }
    return result;
}

const AxialLobes& cosine = AxialLobes::cosine();
const AxialLobes phase = HenyeyGreenstein{0.8f}.lobes();

Field trained_field(int lobes) {
    return fit(Field::empty(unit_box), lamp_records(lobes, 200000, 1), settings_with(lobes), 1).field;
}

void field_step(benchmark::State& state, const AxialLobes& lobes, auto step) {
    const Field field = trained_field(static_cast<int>(state.range(0)));
    const std::vector<Query> all = random_queries(lobes);
    std::size_t i = 0;
    for (auto _ : state) {
        const Query& query = all[i++ % queries];
        step(*field.find(query.position), query);
    }
}

void guided_direction(benchmark::State& state, const AxialLobes& lobes) {
    field_step(state, lobes, [](const Region& region, const Query& query) {
        const MixtureProduct product = region.incident(query.position).product(query.lobes);
        const Vec3 w = product.sample(query.u);
        benchmark::DoNotOptimize(product.density(w));
    });
}

/// Look-up, re-aiming, product with the cosine, sample and density.
void surface(benchmark::State& state) {
    guided_direction(state, cosine);
}
BENCHMARK(surface)->Arg(8)->Arg(16);

/// Look-up, re-aiming, product with Henyey and Greenstein's function of g = 0.8, sample and density.
void volume(benchmark::State& state) {
    guided_direction(state, phase);
}
BENCHMARK(volume)->Arg(8)->Arg(16);

/// What the core does now: times above are best told as multiples of this one.
void thousand_dependent_multiply_adds(benchmark::State& state) {
    for (auto _ : state) {
        float x = 0.3f;
        for (int i = 0; i < 1000; ++i) {
            x = x * 0.999f + 1e-3f;
        }
        benchmark::DoNotOptimize(x);
    }
}
BENCHMARK(thousand_dependent_multiply_adds);

void look_up_and_re_aim(benchmark::State& state) {
    field_step(state, phase, [](const Region& region, const Query& query) {
        benchmark::DoNotOptimize(region.incident(query.position));
    });
}
BENCHMARK(look_up_and_re_aim)->Arg(8)->Arg(16);

void product(benchmark::State& state) {
    field_step(state, phase, [](const Region& region, const Query& query) {
        benchmark::DoNotOptimize(region.mixture().product(query.lobes));
    });
}
BENCHMARK(product)->Arg(8)->Arg(16);

void sample(benchmark::State& state) {
    field_step(state, phase, [](const Region& region, const Query& query) {
        benchmark::DoNotOptimize(region.mixture().sample(query.u));
    });
}
BENCHMARK(sample)->Arg(8)->Arg(16);

void density(benchmark::State& state) {
    field_step(state, phase, [](const Region& region, const Query& query) {
        benchmark::DoNotOptimize(region.mixture().density(query.lobes.axis()));
    });
}
BENCHMARK(density)->Arg(8)->Arg(16);

/// Records per second of one thread, first fit and refinement alike.
void training(benchmark::State& state) {
    const auto lobes = static_cast<int>(state.range(0));
    const Records first = lamp_records(lobes, 200000, 1), second = lamp_records(lobes, 200000, 2);
    const Field start = fit(Field::empty(unit_box), first, settings_with(lobes), 1).field;
    for (auto _ : state) {
        benchmark::DoNotOptimize(fit(Field::empty(unit_box), first, settings_with(lobes), 1));
        benchmark::DoNotOptimize(fit(start, second, settings_with(lobes), 1));
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(first.size() + second.size()));
}
BENCHMARK(training)->Arg(8)->Arg(16)->Unit(benchmark::kMillisecond);

/// The same update on one thread and on two: compare with what two threads make of arithmetic alone.
void update_on_threads(benchmark::State& state) {
    const Records first = lamp_records(8, 400000, 1), second = lamp_records(8, 400000, 2);
    const Field start = fit(Field::empty(unit_box), first, settings_with(8), 1).field;
    for (auto _ : state) {
        benchmark::DoNotOptimize(fit(start, second, settings_with(8), static_cast<int>(state.range(0))));
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(second.size()));
}
BENCHMARK(update_on_threads)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

void arithmetic_on_threads(benchmark::State& state) {
    constexpr std::size_t tasks = 64;
    constexpr int steps = 500000;
    for (auto _ : state) {
        parallel_for(tasks, static_cast<int>(state.range(0)), [](std::size_t task) {
            float x = 0.3f + 0.001f * static_cast<float>(task);
            for (int i = 0; i < steps; ++i) {
                x = x * 0.999f + 1e-3f;
            }
            benchmark::DoNotOptimize(x);
        });
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(tasks));
}
BENCHMARK(arithmetic_on_threads)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
