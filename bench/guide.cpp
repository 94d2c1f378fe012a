// Cost of asking the learned field and of training it.
#include <wend/core/random.h>
#include <wend/guide/fit.h>
#include <wend/guide/path_records.h>
#include <wend/medium/phase_lobes.h>

#include <benchmark/benchmark.h>

#include <array>
#include <limits>
#include <vector>

namespace {

using namespace wend;
using namespace wend::guide;

const Box3 unit_box(Vec3(0, 0, 0), Vec3(1, 1, 1));
constexpr std::size_t queries = 1024;

/// Radiance of three lamps at finite distances over a weak background.
Records lamp_records(std::size_t count, std::uint64_t seed) {
    const std::array<Vec3, 3> lamps = {Vec3(0.5f, 0.5f, 3), Vec3(-2, 0.2f, 0.5f), Vec3(0.4f, -1, -1)};
    Pcg32 random(seed);
    Records records;
    records.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec2 u = random.uniform2();
        const Vec3 position(u.x, u.y, random.uniform());
        const Vec3& lamp = lamps[static_cast<std::size_t>(3 * random.uniform())];
        const bool background = random.uniform() < 0.2f;
        const Vmf lobe = background ? Vmf{} : Vmf{normalize(lamp - position), 50};
        const Vec3 w = lobe.sample(random.uniform2());
        records.push_back({position, w, lobe.density(w), lobe.density(w),
                           background ? std::numeric_limits<float>::infinity() : length(lamp - position)});
    }
    return records;
}

FitSettings settings_with(int lobes) {
    FitSettings settings;
    settings.lobes = lobes;
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
const AxialLobes phase = lobes_of(HenyeyGreenstein{0.8f});

void field_step(benchmark::State& state, const AxialLobes& lobes, auto step) {
    const Field field = fit(Field::empty(unit_box), lamp_records(200000, 1), settings_with(state.range(0)), 1).field;
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
    const Records first = lamp_records(200000, 1), second = lamp_records(200000, 2);
    const Field start = fit(Field::empty(unit_box), first, settings_with(state.range(0)), 1).field;
    for (auto _ : state) {
        benchmark::DoNotOptimize(fit(Field::empty(unit_box), first, settings_with(state.range(0)), 1));
        benchmark::DoNotOptimize(fit(start, second, settings_with(state.range(0)), 1));
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(first.size() + second.size()));
}
BENCHMARK(training)->Arg(8)->Arg(16)->Unit(benchmark::kMillisecond);

/// Records of walks of 1,024 vertices, alternately on surfaces and in volumes, in colour.
void path_records(benchmark::State& state) {
    constexpr std::size_t vertices = 1024;
    Pcg32 random(3);
    std::vector<PathVertex> path(vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
        const Vec2 u = random.uniform2();
        path[i].position = Vec3(u.x, u.y, random.uniform());
        path[i].direction = Vmf{}.sample(random.uniform2());
        path[i].density = inv_4pi;
        path[i].distance = 1;
        path[i].scattering = Rgb(0.95f, 0.9f, 0.8f);
        path[i].gathered = Rgb(random.uniform());
        path[i].parent = static_cast<std::int32_t>(i) - 1;
        path[i].in_volume = i % 2 == 0;
    }
    // As in training, walks share their records' memory; it is emptied before it outgrows the caches of a small
    // machine.
    constexpr std::size_t walks = 64;
    PathRecords records;
    std::size_t kept = 0;
    for (auto _ : state) {
        if (kept++ == walks) {
            records.clear();
            kept = 0;
        }
        records.add(path);
        benchmark::DoNotOptimize(records);
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(vertices));
}
BENCHMARK(path_records)->Unit(benchmark::kMicrosecond);

}  // namespace
