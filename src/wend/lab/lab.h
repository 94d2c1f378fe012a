// The one-dimensional laboratory: half-spaces and slabs, where the exact answer is known and a sampler can be judged.
#pragma once

#include <wend/planar/adjoint.h>
#include <wend/planar/half_space.h>
#include <wend/planar/moment_match.h>
#include <wend/stats/moments.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace wend {

/// Which side is lit by a uniform sky of radiance 1; the walk enters at the near side.
enum class Tally { reflectance, transmittance };

/// What ends walks early or splits them: nothing beyond the sampler's own rule; a window around the expected
/// contribution, weight times adjoint; or roulette by the weight alone, for comparison.
enum class PlanarWindow { none, adjoint, weight };

/// An experiment. Lengths are in mean free paths of the first channel.
struct PlanarExperiment {
    std::vector<double> albedo = {0.8};    ///< of each channel, in [0,1]: one, or three for a chromatic medium
    std::vector<double> extinction = {1};  ///< of each channel relative to the first, > 0; one entry stands for all
    double g = 0;                          ///< mean cosine of the Henyey-Greenstein phase function, |g| <= 0.95
    double ior = 1;                        ///< inside over outside, in [1, 3]
    double roughness = 0;                  ///< alpha of the GGX boundary; 0: smooth; only with ior > 1
    double thickness = std::numeric_limits<double>::infinity();  ///< infinite: a half-space
    Tally tally = Tally::reflectance;
    std::optional<double> mu0 = 1;  ///< cosine of incidence outside, in (0,1]; none: cosine-weighted (Lambertian)

    std::string sampler = "classical";                  ///< one of planar_samplers()
    std::optional<double> stretch;                      ///< constant of `stretched`, in [0,1); none: 1/nu0
    FirstFlight first_flight = FirstFlight::stretched;  ///< of `dwivedi`
    int exponentials = 1;                               ///< of `boundary`: 1 or 2
    MatchedMoments moments = MatchedMoments::zeroth_first;
    int modes = 8;                       ///< transients of `modes` beside the discrete mode, 0 to 71
    std::optional<PlanarModes> adjoint;  ///< what `modes` follows in place of the medium's own (grey media)
    std::optional<double> guide_albedo;  ///< a guide made for another albedo than the medium's (grey media)
    PlanarWindow window = PlanarWindow::none;
};

/// The names of the samplers: analog, classical, stretched, dwivedi, boundary, modes.
const std::vector<std::string>& planar_samplers();

struct PlanarRun {
    std::uint64_t walks = 100000;
    std::uint64_t seed = 0;
    int threads = 0;  ///< 0: all; the results do not depend on it
    /// Is called every few thousand walks, by any of the threads. What it throws ends the run. May be empty.
    std::function<void()> watch = {};
};

struct PlanarResult {
    std::vector<Moments> channels;  ///< of one walk's (or tree's) value, per channel
    std::vector<double> exact;      ///< the expected mean by an independent method; NaN where there is none
    double collisions_per_walk = 0;
    double seconds = 0;          ///< of the walks, summed over threads
    double setup_seconds = 0;    ///< of the sampler's tables
    std::uint64_t rejected = 0;  ///< walks whose value was not finite (counted as 0)
};

/// Runs an experiment. Throws InputError for values outside their ranges, with the range.
PlanarResult run_planar(const PlanarExperiment& experiment, const PlanarRun& run);

/// The exact answer alone, per channel.
std::vector<double> planar_exact(const PlanarExperiment& experiment);

/// A walk as a polyline for drawing: lateral position and depth of the entry, of every collision and of the exit, and
/// the value the walk brought.
struct PlanarTrace {
    struct Vertex {
        double lateral = 0, depth = 0;
    };
    std::vector<Vertex> vertices;
    double value = 0;
};
std::vector<PlanarTrace> trace_planar(const PlanarExperiment& experiment, int walks, std::uint64_t seed);

/// Where a sampler's walks first collide and where they head from there, beside the exact densities that a walk of no
/// variance would follow. (Grey media only.)
struct PlanarHistogram {
    std::vector<double> depth_edges;     ///< bins of the depth of the first collision
    std::vector<double> depth_density;   ///< fraction of walks per bin and mean free path
    std::vector<double> depth_exact;     ///< of the exact flight: in proportion to transmittance times source
    std::vector<double> cosine_edges;    ///< bins in [-1,1] of the direction after the first collision
    std::vector<double> cosine_density;  ///< of those that collided between `depth_begin` and `depth_end`
    std::vector<double> cosine_exact;    ///< of phase function times radiance
    double depth_begin = 0, depth_end = 0;
};
PlanarHistogram histogram_planar(const PlanarExperiment& experiment, const PlanarRun& run);

}  // namespace wend
