#include <wend/lab/lab.h>

#include <wend/core/parallel.h>
#include <wend/lab/build.h>
#include <wend/lab/chromatic.h>

#include <time.h>

#include <chrono>
#include <cmath>

namespace wend {

using namespace planar_build;

namespace {

double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double wall_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Sums over blocks of walks of fixed size, each with random numbers of its own, merged in order.
constexpr std::uint64_t block_size = 2048;

struct Block {
    std::vector<Moments> channels;
    std::uint64_t collisions = 0;
    std::uint64_t rejected = 0;
    double seconds = 0;
};

/// walk(random, collisions, values) fills the values of one walk.
PlanarResult run_blocks(std::size_t channels, const PlanarRun& run, const auto& walk) {
    const std::uint64_t count = (run.walks + block_size - 1) / block_size;
    std::vector<Block> blocks(count);
    parallel_for(count, run.threads, [&](std::size_t b) {
        if (run.watch) {
            run.watch();
        }
        Block& block = blocks[b];
        block.channels.resize(channels);
        const double begin = thread_seconds();
        Pcg32 random(hash_of(run.seed, b));
        std::vector<double> values(channels);
        const std::uint64_t first = b * block_size;
        for (std::uint64_t i = first; i < std::min(first + block_size, run.walks); ++i) {
            walk(random, block.collisions, values);
            for (std::size_t c = 0; c < channels; ++c) {
                const bool finite = std::isfinite(values[c]);
                block.rejected += finite ? 0 : 1;
                block.channels[c].add(finite ? values[c] : 0);
            }
        }
        block.seconds = thread_seconds() - begin;
    });
    PlanarResult result;
    result.channels.resize(channels);
    std::uint64_t collisions = 0;
    for (const Block& block : blocks) {
        for (std::size_t c = 0; c < channels; ++c) {
            result.channels[c].merge(block.channels[c]);
        }
        collisions += block.collisions;
        result.rejected += block.rejected;
        result.seconds += block.seconds;
    }
    result.collisions_per_walk = run.walks > 0 ? static_cast<double>(collisions) / static_cast<double>(run.walks) : 0;
    return result;
}

}  // namespace

const std::vector<std::string>& planar_samplers() {
    static const std::vector<std::string> names = {"analog", "classical", "stretched", "dwivedi", "boundary", "modes"};
    return names;
}

PlanarResult run_planar(const PlanarExperiment& e, const PlanarRun& run) {
    validate(e);
    const double begin = wall_seconds();
    double setup = 0;
    PlanarResult result;
    if (e.albedo.size() == 1) {
        result = with_walker(e, [&](const auto& walker) {
            setup = wall_seconds() - begin;
            return run_blocks(1, run, [&](Pcg32& random, std::uint64_t& collisions, std::vector<double>& values) {
                UnobservedWalk nobody;
                values[0] = walker.walk(random, collisions, nobody);
            });
        });
    } else {
        result = with_samplers(e, [&](const auto& samplers, const std::vector<Guide>& guides) {
            using Walker = ChromaticPlanarWalker<std::remove_cvref_t<decltype(samplers[0])>>;
            std::array<typename Walker::Channel, Walker::channels> channels;
            const std::array<double, 3> shares = channel_shares(e, guides);
            for (std::size_t c = 0; c < channels.size(); ++c) {
                channels[c] = {e.albedo[c], extinction_of(e, c), shares[c], &guides[c].slab, &samplers[c]};
            }
            const Walker walker(channels, make_survival(e, {}));
            setup = wall_seconds() - begin;
            return run_blocks(3, run, [&](Pcg32& random, std::uint64_t& collisions, std::vector<double>& values) {
                const auto value = walker.walk(random, collisions);
                std::copy(value.begin(), value.end(), values.begin());
            });
        });
    }
    result.setup_seconds = setup;
    result.exact = planar_exact(e);
    return result;
}

std::vector<double> planar_exact(const PlanarExperiment& e) {
    validate(e);
    std::vector<double> exact;
    for (std::size_t c = 0; c < e.albedo.size(); ++c) {
        if (is_half_space(e) && e.ior == 1 && e.g == 0) {
            const double value = e.mu0 ? reflectance(e.albedo[c], *e.mu0) : diffuse_reflectance(e.albedo[c]);
            exact.push_back(value > 0 ? value : 0);  // never a negative zero
            continue;
        }
        const PlanarSlab slab = make_slab(e, c);
        const PlanarEntry entry = make_entry(e, slab, nullptr);
        const PlanarAdjoint adjoint(solve_planar(make_problem(e.albedo[c], e.g, slab, reference_transients)), slab);
        exact.push_back(entry.expected(adjoint) + entry.expected_reflection());
    }
    return exact;
}

}  // namespace wend
