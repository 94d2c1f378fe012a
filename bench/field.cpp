// How true the learned field is, and how fast it learns: the divergence of its distributions from the truth they were
// drawn from.
#include <wend/core/random.h>
#include <wend/guide/fit.h>
#include <wend/sampling/discrete.h>

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <vector>

namespace {

using namespace wend;
using namespace wend::guide;

/// Lamps around the unit cube, seen as lobes of concentration 300 in the directions of their centres: the truth is
/// known at every position. bench/README.md describes the input.
struct Lamps {
    static constexpr float kappa = 300;
    std::vector<Vec3> centre;
    std::vector<float> share;

    double density(const Vec3& position, const Vec3& w) const {
        double sum = 0;
        for (std::size_t i = 0; i < centre.size(); ++i) {
            sum += share[i] * Vmf{normalize(centre[i] - position), kappa}.density(w);
        }
        return sum;
    }

    struct Seen {
        Vec3 direction;
        float distance;
    };
    Seen sample(const Vec3& position, Pcg32& random) const {
        float u = random.uniform();
        const auto lamp = static_cast<std::size_t>(select(share, 1, u));
        const Vec3 to_lamp = centre[lamp] - position;
        return {Vmf{normalize(to_lamp), kappa}.sample(random.uniform2()), length(to_lamp)};
    }
};

const Lamps three_lamps{{{0.5f, 0.5f, 1.6f}, {-1, 0.2f, 0.5f}, {0.4f, -0.5f, -0.6f}}, {0.5f, 0.3f, 0.2f}};

/// Twelve equal ones on a spiral around the cube: more than a cell has lobes at first.
Lamps twelve_lamps() {
    constexpr int count = 12;
    constexpr float golden_angle = 2.39996323f;
    Lamps lamps;
    for (int i = 0; i < count; ++i) {
        const float z = 1 - (2 * i + 1.0f) / count, r = std::sqrt(1 - z * z);
        lamps.centre.push_back(Vec3(0.5f, 0.5f, 0.5f) +
                               Vec3(r * std::cos(golden_angle * i), r * std::sin(golden_angle * i), z) * 3.0f);
        lamps.share.push_back(1.0f / count);
    }
    return lamps;
}

Vec3 position_in(bool volume, Pcg32& random) {
    const Vec2 u = random.uniform2();
    return {u.x, u.y, volume ? random.uniform() : 0.0f};
}

/// `scattered`: records tell the distance of the next vertex in a medium, exponential, instead of the lamp's.
Records lamp_records(const Lamps& lamps, bool volume, bool scattered, std::size_t count, std::uint64_t seed) {
    Pcg32 random(seed);
    Records records;
    records.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 position = position_in(volume, random);
        const auto [w, distance] = lamps.sample(position, random);
        const auto density = static_cast<float>(lamps.density(position, w));
        const float told = scattered ? 0.05f - distance * std::log(1 - random.uniform()) : distance;
        records.push_back({position, w, density, density, told});
    }
    return records;
}

/// Mean over positions of the divergence of the field's distribution from the truth, in nats.
double divergence(const Lamps& lamps, const Field& field, bool volume) {
    constexpr int samples = 100000;
    Pcg32 random(99);
    double sum = 0;
    for (int i = 0; i < samples; ++i) {
        const Vec3 position = position_in(volume, random);
        const Vec3 w = lamps.sample(position, random).direction;
        const double fitted = static_cast<double>(field.find(position)->incident(position).density(w));
        sum += std::log(lamps.density(position, w) / std::max(fitted, 1e-30));
    }
    return sum / samples;
}

/// How far the error ln(fit/truth) changes on a step of a thousandth of the cube, in nats: across faces of cells and
/// within them.
struct Jumps {
    double across = 0, within = 0;
};

Jumps mean_jumps(const Lamps& lamps, const Field& field) {
    constexpr int samples = 1000000;
    constexpr float step = 1e-3f;
    Pcg32 random(98);
    std::array<double, 2> sum{}, count{};
    for (int i = 0; i < samples; ++i) {
        const Vec3 from = position_in(true, random), to = from + Vmf{}.sample(random.uniform2()) * step;
        const Region &a = *field.find(from), &b = *field.find(to);
        const std::size_t crosses = &a != &b ? 1 : 0;
        if (crosses == 0 && i % 32 != 0) {
            continue;  // most steps
        }
        const Vec3 w = lamps.sample(from, random).direction;
        const auto error = [&](const Region& region, const Vec3& position) {
            return std::log(static_cast<double>(region.incident(position).density(w)) / lamps.density(position, w));
        };
        sum[crosses] += std::abs(error(b, to) - error(a, from));
        ++count[crosses];
    }
    return {sum[1] / std::max(count[1], 1.0), sum[0] / std::max(count[0], 1.0)};
}

/// A million records, half on a surface and half in a volume, in passes that double, by default settings and one
/// thread.
void learning(benchmark::State& state, const Lamps& lamps, bool scattered) {
    constexpr std::size_t per_field = 500000;
    constexpr std::size_t passes = 6;
    std::array<std::vector<Records>, 2> records;
    for (std::size_t field = 0; field < 2; ++field) {
        std::size_t left = per_field;
        for (std::size_t pass = 0; pass < passes; ++pass) {
            const std::size_t count = pass + 1 < passes ? per_field >> (passes - pass) : left;
            left -= count;
            records[field].push_back(lamp_records(lamps, field == 1, scattered, count, 10 * pass + field));
        }
    }
    std::array<double, 2> kl{};
    Jumps jumps;
    std::size_t cells = 0, bytes = 0;
    for (auto _ : state) {
        for (std::size_t field = 0; field < 2; ++field) {
            Field learned = Field::empty(field == 1 ? Box3(Vec3(0, 0, 0), Vec3(1, 1, 1))
                                                    : Box3(Vec3(0, 0, -0.01f), Vec3(1, 1, 0.01f)));
            for (const Records& pass : records[field]) {
                learned = fit(learned, pass, {}, 1).field;
            }
            state.PauseTiming();
            kl[field] = divergence(lamps, learned, field == 1);
            jumps = field == 1 ? mean_jumps(lamps, learned) : jumps;
            cells = learned.size();
            bytes = learned.bytes();
            state.ResumeTiming();
        }
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(2 * per_field));
    state.counters["KL_surface"] = kl[0];
    state.counters["KL_volume"] = kl[1];
    state.counters["jump_across"] = jumps.across;
    state.counters["jump_within"] = jumps.within;
    state.counters["bytes_per_cell"] = static_cast<double>(bytes) / static_cast<double>(cells);
    state.counters["cells"] = static_cast<double>(cells);
}
BENCHMARK_CAPTURE(learning, true_distances, three_lamps, false)->Unit(benchmark::kMillisecond)->Iterations(2);
BENCHMARK_CAPTURE(learning, scattered_distances, three_lamps, true)->Unit(benchmark::kMillisecond)->Iterations(2);
BENCHMARK_CAPTURE(learning, many_lamps, twelve_lamps(), false)->Unit(benchmark::kMillisecond)->Iterations(2);

/// A hundred million records in passes of a million, within 4 MiB.
void soak(benchmark::State& state) {
    constexpr std::size_t passes = 100, per_pass = 1000000;
    FitSettings settings;
    settings.max_bytes = std::size_t{4} << 20;
    std::vector<Records> records;
    for (std::size_t i = 0; i < 4; ++i) {
        records.push_back(lamp_records(three_lamps, true, false, per_pass, i));
    }
    for (auto _ : state) {
        Field learned = Field::empty(Box3(Vec3(0, 0, 0), Vec3(1, 1, 1)));
        for (std::size_t pass = 0; pass < passes; ++pass) {
            learned = fit(learned, records[pass % records.size()], settings, 1).field;
        }
        state.PauseTiming();
        state.counters["KL_volume"] = divergence(three_lamps, learned, true);
        state.counters["cells"] = static_cast<double>(learned.size());
        state.counters["bytes"] = static_cast<double>(learned.bytes());
        state.ResumeTiming();
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(passes * per_pass));
}
BENCHMARK(soak)->Unit(benchmark::kSecond)->Iterations(1);

}  // namespace
