// Plane-parallel walks: what a flight and a set-up cost, and how much better than classical ones they estimate.
#include <wend/lab/lab.h>
#include <wend/planar/discrete_ordinates.h>
#include <wend/planar/eigenvalue.h>
#include <wend/planar/modal_decisions.h>
#include <wend/stats/figure_of_merit.h>

#include <benchmark/benchmark.h>

#include <array>
#include <sstream>
#include <string>

namespace {

using namespace wend;

constexpr std::uint64_t walks = 100000;
constexpr std::uint64_t classical_walks = 300000;

PlanarSlab half_space() {
    PlanarSlab slab;
    slab.near.illumination = [](double /*cosine*/) { return 1.0; };
    return slab;
}

PlanarAdjoint adjoint_of(double albedo, int transients) {
    PlanarProblem problem;
    problem.albedo = albedo;
    problem.slab = half_space();
    problem.transients = transients;
    return PlanarAdjoint(solve_planar(problem), problem.slab);
}

/// Flights from a few depths in all directions.
template <class Flight>
void fly(benchmark::State& state, const Flight& flight) {
    constexpr std::size_t count = 1024;
    Pcg32 random(1);
    std::array<typename Flight::Site, 16> sites;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        flight.at(0.25 * static_cast<double>(i), sites[i]);
    }
    std::array<double, count> cosines;
    for (double& mu : cosines) {
        mu = 2 * random.uniform_double() - 1;
    }
    typename Flight::Site to;
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(flight.sample(sites[i % sites.size()], cosines[i % count], random, to));
        ++i;
    }
}

void flight_classical(benchmark::State& state) {
    fly(state, PathStretching(std::numeric_limits<double>::infinity(), Heading::near, 0));
}
BENCHMARK(flight_classical);

void flight_dwivedi(benchmark::State& state) {
    fly(state, PathStretching(std::numeric_limits<double>::infinity(), Heading::near, discrete_eigenvalue(0.8).k));
}
BENCHMARK(flight_dwivedi);

void flight_modes(benchmark::State& state) {
    const PlanarAdjoint adjoint = adjoint_of(0.8, static_cast<int>(state.range(0)));
    fly(state, ModalFlight(adjoint));
}
BENCHMARK(flight_modes)->Arg(2)->Arg(8)->Arg(32);

void direction_modes(benchmark::State& state) {
    const PlanarAdjoint adjoint = adjoint_of(0.8, 8);
    const ModalDirection direction(adjoint, 0);
    Pcg32 random(1);
    for (auto _ : state) {
        benchmark::DoNotOptimize(direction.sample(1.3, 0.2, random));
    }
}
BENCHMARK(direction_modes);

void solve(benchmark::State& state) {
    for (auto _ : state) {
        benchmark::DoNotOptimize(adjoint_of(0.8, static_cast<int>(state.range(0))));
    }
}
BENCHMARK(solve)->Arg(8)->Arg(31)->Unit(benchmark::kMicrosecond);

void direction_tables(benchmark::State& state) {
    const PlanarAdjoint adjoint = adjoint_of(0.8, 8);
    const double g = 0.1 * static_cast<double>(state.range(0));
    for (auto _ : state) {
        benchmark::DoNotOptimize(ModalDirection(adjoint, g));
    }
}
BENCHMARK(direction_tables)->Arg(0)->Arg(5)->Unit(benchmark::kMillisecond);

PlanarResult run(const PlanarExperiment& e, std::uint64_t count) {
    PlanarRun one_thread;
    one_thread.walks = count;
    one_thread.threads = 1;
    return run_planar(e, one_thread);
}

double fom(const PlanarResult& result) {
    return figure_of_merit(result.channels[0], result.seconds).value_or(0);
}

void report(benchmark::State& state, const PlanarResult& result) {
    const Moments& m = result.channels[0];
    state.counters["mean"] = m.mean();
    state.counters["variance"] = m.variance();
    state.counters["off_by"] = (m.mean() - result.exact[0]) / m.standard_error();
    state.counters["ns_per_collision"] =
        1e9 * result.seconds / (static_cast<double>(m.count()) * result.collisions_per_walk);
    state.counters["setup_ms"] = 1e3 * result.setup_seconds;
    state.counters["fom"] = fom(result);
}

/// One experiment against classical sampling in the same process: how much smaller the variance, how much larger the
/// figure of merit.
void against_classical(benchmark::State& state, PlanarExperiment e) {
    PlanarExperiment classical = e;
    classical.sampler = "classical";
    for (auto _ : state) {
        const PlanarResult baseline = run(classical, classical_walks);
        const PlanarResult result = run(e, walks);
        report(state, result);
        state.counters["variance_ratio"] = baseline.channels[0].variance() / result.channels[0].variance();
        state.counters["fom_ratio"] = fom(result) / fom(baseline);
    }
}

/// Against analog walks, of which p of 1 get through: their figure of merit is p / (1 - p) times their rate.
void against_analog(benchmark::State& state, PlanarExperiment e) {
    PlanarExperiment analog = e;
    analog.sampler = "analog";
    for (auto _ : state) {
        const PlanarResult baseline = run(analog, classical_walks);
        const PlanarResult result = run(e, walks);
        const double p = result.exact[0];
        const double rate = static_cast<double>(classical_walks) / baseline.seconds;
        report(state, result);
        state.counters["relative_error"] = result.channels[0].relative_error();
        state.counters["fom_ratio"] = fom(result) / (p / (1 - p) * rate);
    }
}

void add(const std::string& name, const PlanarExperiment& e, bool analog = false) {
    benchmark::RegisterBenchmark(name.c_str(), analog ? against_analog : against_classical, e)
        ->Iterations(1)
        ->Unit(benchmark::kSecond);
}

PlanarExperiment experiment(double albedo, const std::string& sampler, int modes = 8) {
    PlanarExperiment e;
    e.albedo = {albedo};
    e.sampler = sampler;
    e.modes = modes;
    return e;
}

std::string label(const char* what, double value) {
    std::ostringstream text;
    text << '/' << what << value;
    return text.str();
}

const bool registered = [] {
    for (const double albedo : {0.2, 0.4, 0.8, 0.95}) {
        for (const char* sampler : {"stretched", "dwivedi", "boundary", "modes"}) {
            add("isotropic" + label("albedo_", albedo) + "/" + sampler, experiment(albedo, sampler));
        }
    }
    struct Anisotropic {
        double g;
        int modes;
    };
    for (const Anisotropic& a : {Anisotropic{0.5, 12}, {-0.3, 12}, {0.8, 24}, {0.9, 32}}) {
        for (const double albedo : {0.8, 0.95, 0.99}) {
            PlanarExperiment e = experiment(albedo, "modes", a.modes);
            e.g = a.g;
            add("anisotropic" + label("g_", a.g) + label("albedo_", albedo), e);
        }
    }
    for (const double ior : {1.33, 1.5}) {
        PlanarExperiment e = experiment(0.95, "modes", 24);
        e.ior = ior;
        add("refractive" + label("ior_", ior), e);
        e.g = 0.8;
        add("refractive" + label("ior_", ior) + "/g_0.8", e);
        e.g = 0;
        e.roughness = 0.3;
        add("rough" + label("ior_", ior), e);
    }
    for (const double albedo : {0.5, 0.8, 0.95}) {
        for (const double thickness : {10.0, 20.0}) {
            PlanarExperiment e = experiment(albedo, "modes");
            e.thickness = thickness;
            e.tally = Tally::transmittance;
            add("transmittance" + label("albedo_", albedo) + label("mfp_", thickness), e, true);
            e.mu0.reset();
            add("transmittance" + label("albedo_", albedo) + label("mfp_", thickness) + "/cosine", e, true);
        }
    }
    return true;
}();

}  // namespace
