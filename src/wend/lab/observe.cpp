#include <wend/core/parallel.h>
#include <wend/lab/build.h>
#include <wend/lab/lab.h>
#include <wend/numeric/quadrature.h>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace wend {

using namespace planar_build;

namespace {

/// Follows a walk in three dimensions, of which the drawing keeps the depth and one lateral axis.
class Tracer {
public:
    Tracer(double g, std::uint64_t key) : g_(g), random_(key) {}

    void enters(double /*cosine*/) {
        // A ray that enters obliquely does so in the plane of the drawing.
        azimuth_ = 0;
        trace.vertices.push_back({0, 0});
    }
    void collides(double depth, double length, double before, double after) {
        move(depth, length, before);
        azimuth_ += sample_azimuth(g_, before, after, random_);
    }
    void is_absorbed(double depth, double length, double cosine) { move(depth, length, cosine); }
    void arrives(double depth, double length, double cosine) { move(depth, length, cosine); }

    PlanarTrace trace;

private:
    void move(double depth, double length, double cosine) {
        const double horizontal = length * std::sqrt(std::max(0.0, 1 - cosine * cosine));
        lateral_ += horizontal * std::cos(azimuth_);
        trace.vertices.push_back({lateral_, depth});
    }

    double g_;
    Pcg32 random_;
    double azimuth_ = 0;
    double lateral_ = 0;
};

/// Counts first collisions by depth, and directions after those in a range of depths.
class FirstCollision {
public:
    FirstCollision(double depth_step, std::size_t depth_bins, double begin, double end, std::size_t cosine_bins)
        : depths(depth_bins), cosines(cosine_bins), step_(depth_step), begin_(begin), end_(end) {}

    void enters(double /*cosine*/) { first_ = true; }
    void collides(double depth, double /*length*/, double /*before*/, double after) {
        if (first_ && depth >= begin_ && depth < end_) {
            const auto count = static_cast<double>(cosines.size());
            ++cosines[static_cast<std::size_t>(std::clamp((after + 1) / 2 * count, 0.0, count - 1))];
        }
        count_depth(depth);
    }
    void is_absorbed(double depth, double /*length*/, double /*cosine*/) { count_depth(depth); }
    void arrives(double /*depth*/, double /*length*/, double /*cosine*/) { first_ = false; }

    std::vector<std::uint64_t> depths, cosines;

private:
    void count_depth(double depth) {
        const auto bin = static_cast<std::size_t>(depth / step_);
        if (first_ && bin < depths.size()) {
            ++depths[bin];
        }
        first_ = false;
    }

    double step_, begin_, end_;
    bool first_ = true;
};

}  // namespace

std::vector<PlanarTrace> trace_planar(const PlanarExperiment& experiment, int walks, std::uint64_t seed) {
    validate(experiment);
    PlanarExperiment e = experiment;
    e.window = PlanarWindow::none;  // branches would have to be drawn as trees
    return with_walker(e, [&](const auto& walker) {
        std::vector<PlanarTrace> traces;
        Pcg32 random(hash_of(seed, 0));
        for (int i = 0; i < walks; ++i) {
            Tracer tracer(e.g, hash_of(seed, 1, i));
            std::uint64_t collisions = 0;
            tracer.trace.value = walker.walk(random, collisions, tracer);
            traces.push_back(std::move(tracer.trace));
        }
        return traces;
    });
}

namespace {

constexpr std::size_t depth_bins = 50, cosine_bins = 50;

/// Where first collisions of walks are, and where those of some depths head.
void count_collisions(const PlanarExperiment& e, const PlanarRun& run, double step, PlanarHistogram& h) {
    constexpr std::uint64_t block_size = 4096;
    const std::uint64_t count = (run.walks + block_size - 1) / block_size;
    std::vector<FirstCollision> blocks(count,
                                       FirstCollision(step, depth_bins, h.depth_begin, h.depth_end, cosine_bins));
    with_walker(e, [&](const auto& walker) {
        parallel_for(count, run.threads, [&](std::size_t b) {
            Pcg32 random(hash_of(run.seed, b));
            std::uint64_t collisions = 0;
            for (std::uint64_t i = b * block_size; i < std::min((b + 1) * block_size, run.walks); ++i) {
                walker.walk(random, collisions, blocks[b]);
            }
        });
    });
    std::vector<double> depths(depth_bins), cosines(cosine_bins);
    double selected = 0;
    for (const FirstCollision& block : blocks) {
        for (std::size_t i = 0; i < depth_bins; ++i) {
            depths[i] += static_cast<double>(block.depths[i]);
        }
        for (std::size_t i = 0; i < cosine_bins; ++i) {
            cosines[i] += static_cast<double>(block.cosines[i]);
            selected += static_cast<double>(block.cosines[i]);
        }
    }
    for (const double n : depths) {
        h.depth_density.push_back(n / (static_cast<double>(run.walks) * step));
    }
    for (const double n : cosines) {
        h.cosine_density.push_back(selected > 0 ? n * cosine_bins / (2 * selected) : 0);
    }
}

/// What a walk of no variance does, where the walk enters at one cosine.
void add_exact(const PlanarExperiment& e, PlanarHistogram& h) {
    const PlanarSlab slab = make_slab(e, 0);
    const PlanarAdjoint adjoint(solve_planar(make_problem(e.albedo[0], e.g, slab, reference_transients)), slab);
    const double outside = e.mu0.value_or(1);
    const double entering = std::sqrt(1 - (1 - outside * outside) / (e.ior * e.ior));
    const double all = adjoint.radiance(0, entering);
    PlanarAdjoint::Site site;
    const auto collision_density = [&](double depth) {
        adjoint.at(depth, site);
        return std::exp(-depth / entering) * adjoint.source(site, entering).value / (all * entering);
    };
    const Quadrature rule = gauss_legendre(4);
    const auto mean_over = [&](double begin, double end, const auto& f) {
        double sum = 0;
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            sum += rule.weights[i] * f(begin + rule.nodes[i] * (end - begin));
        }
        return sum;
    };
    for (std::size_t i = 0; i < depth_bins; ++i) {
        h.depth_exact.push_back(mean_over(h.depth_edges[i], h.depth_edges[i + 1], collision_density));
    }
    double total = 0;
    for (std::size_t i = 0; i < cosine_bins; ++i) {
        h.cosine_exact.push_back(mean_over(h.depth_begin, h.depth_end, [&](double depth) {
            const double weight = collision_density(depth);
            return mean_over(h.cosine_edges[i], h.cosine_edges[i + 1], [&](double mu) {
                return weight * averaged_henyey_greenstein(e.g, entering, mu) * adjoint.ray(site, mu).radiance();
            });
        }));
        total += h.cosine_exact.back() * 2 / cosine_bins;
    }
    for (double& density : h.cosine_exact) {
        density = total > 0 ? density / total : 0;
    }
}

}  // namespace

PlanarHistogram histogram_planar(const PlanarExperiment& experiment, const PlanarRun& run) {
    validate(experiment);
    const double deepest = std::min(5.0, experiment.thickness);
    PlanarHistogram h;
    h.depth_begin = 0.1 * deepest;
    h.depth_end = 0.16 * deepest;
    const double step = deepest / depth_bins;
    for (std::size_t i = 0; i <= depth_bins; ++i) {
        h.depth_edges.push_back(step * static_cast<double>(i));
    }
    for (std::size_t i = 0; i <= cosine_bins; ++i) {
        h.cosine_edges.push_back(-1 + 2 * static_cast<double>(i) / cosine_bins);
    }

    PlanarExperiment e = experiment;
    e.window = PlanarWindow::none;
    count_collisions(e, run, step, h);
    add_exact(e, h);
    return h;
}

}  // namespace wend
