// How walks enter: the density of the cosine, and what the boundary takes and gives.
#include <tests/sampling/verdicts.h>
#include <tests/support/planar.h>
#include <wend/lab/entry.h>

#include <memory>

namespace wend {
namespace {

using test::PlanarCase;

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Medium {
    PlanarCase planar;
    bool rough = false;
};

const std::vector<Medium>& media() {
    static const std::vector<Medium> all = {{{"half-space", 0.8}},
                                            {{"shield", 0.5, 0, 10, 1, true}},
                                            {{"thin forward slab", 0.95, 0.8, 0.1, 1.33}},
                                            {{"refractive half-space", 0.95, 0, infinite, 1.5}},
                                            {{"rough half-space", 0.8, 0, infinite, 1.5}, true}};
    return all;
}

/// A medium and its adjoint, kept together.
struct Solved {
    explicit Solved(const Medium& m) : slab(test::slab_of(m.planar)) {
        PlanarProblem problem;
        if (m.rough) {
            slab.near.rough = std::make_shared<RoughBoundary>(m.planar.ior, 0.3);
        }
        problem.albedo = m.planar.albedo;
        problem.moments = henyey_greenstein_moments(m.planar.g, m.planar.g == 0 ? 1 : 2 * (m.planar.transients + 1));
        problem.slab = slab;
        adjoint = std::make_unique<PlanarAdjoint>(solve_planar(problem), slab);
    }
    PlanarSlab slab;
    std::unique_ptr<PlanarAdjoint> adjoint;
};

/// Cosines drawn by one entry, judged by the density of another.
test::PlanarVerdict judge_entry(const PlanarEntry& drawn, const PlanarEntry& claimed, int count = 50000) {
    const auto density = [&](double outside) { return 2 * outside * claimed.density_ratio(outside); };
    Pcg32 random(2);
    std::vector<double> pilot, samples, probabilities;
    for (int i = 0; i < count / 4; ++i) {
        pilot.push_back(claimed.sample(random).outside);
    }
    const std::vector<double> edges = test::cell_edges(std::move(pilot), 0);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        probabilities.push_back(
            test::adaptive_integral(density, edges[i], i + 1 < edges.size() ? edges[i + 1] : 1.0, 1e-9));
    }
    double disagreement = 0;
    for (int i = 0; i < count; ++i) {
        const PlanarEntry::Outcome entry = drawn.sample(random);
        samples.push_back(entry.outside);
        disagreement = std::max(disagreement, std::abs(drawn.density_ratio(entry.outside) / entry.density_ratio - 1));
    }
    test::PlanarVerdict verdict = test::judge(samples, edges, probabilities, 0);
    verdict.disagreement = disagreement;
    return verdict;
}

TEST(PlanarEntry, DrawsTheDensityItClaims) {
    for (const Medium& m : media()) {
        const Solved solved(m);
        for (const PlanarAdjoint* adjoint :
             std::initializer_list<const PlanarAdjoint*>{nullptr, solved.adjoint.get()}) {
            const PlanarEntry entry(solved.slab, adjoint);
            const test::PlanarVerdict v = judge_entry(entry, entry);
            EXPECT_NEAR(v.total, 1, 1e-7) << m.planar.name;
            EXPECT_GT(v.p_value, test::passing) << m.planar.name;
            EXPECT_LT(v.disagreement, 1e-7) << m.planar.name;
        }
    }
}

TEST(PlanarEntry, AnotherDensityIsRejected) {
    const Solved shield(media()[1]);
    const PlanarEntry plain(shield.slab, nullptr), guided(shield.slab, shield.adjoint.get());
    EXPECT_LT(judge_entry(plain, guided).p_value, test::failing);
    EXPECT_LT(judge_entry(guided, plain).p_value, test::failing);
}

TEST(PlanarEntry, WeightsBringWhatIsExpected) {
    for (const Medium& m : media()) {
        const Solved solved(m);
        for (const PlanarEntry& entry :
             {PlanarEntry(solved.slab, 1.0), PlanarEntry(solved.slab, 0.3), PlanarEntry(solved.slab, nullptr),
              PlanarEntry(solved.slab, solved.adjoint.get())}) {
            Moments value, reflected;
            Pcg32 random(9);
            for (int i = 0; i < 20000; ++i) {
                const PlanarEntry::Outcome e = entry.sample(random);
                value.add(e.weight > 0 ? e.weight * solved.adjoint->radiance(0, e.cosine) : 0);
                reflected.add(e.reflected);
            }
            const double rounding = m.rough ? 2e-4 : 1e-6;
            EXPECT_TRUE(agrees(value, entry.expected(*solved.adjoint), 4, rounding))
                << m.planar.name << ": " << value.mean() << " +- " << value.standard_error() << " against "
                << entry.expected(*solved.adjoint);
            EXPECT_TRUE(agrees(reflected, entry.expected_reflection(), 4, rounding)) << m.planar.name;
            EXPECT_FALSE(agrees(value, 1.1 * entry.expected(*solved.adjoint), 4, rounding)) << m.planar.name;
        }
    }
}

// Guided by the adjoint, entry and medium bring the same wherever they enter.
TEST(PlanarEntry, GuidedEntriesBringTheSameEach) {
    for (const Medium& m : media()) {
        if (m.rough) {
            continue;  // where a facet is drawn as well
        }
        const Solved solved(m);
        Moments plain, guided;
        Pcg32 random(9);
        const PlanarEntry uniform(solved.slab, nullptr), by_adjoint(solved.slab, solved.adjoint.get());
        for (int i = 0; i < 10000; ++i) {
            const PlanarEntry::Outcome a = uniform.sample(random), b = by_adjoint.sample(random);
            plain.add(a.reflected + a.weight * solved.adjoint->radiance(0, a.cosine));
            guided.add(b.reflected + b.weight * solved.adjoint->radiance(0, b.cosine));
        }
        EXPECT_LT(guided.variance(), 1e-4 * plain.variance()) << m.planar.name;
    }
}

}  // namespace
}  // namespace wend
