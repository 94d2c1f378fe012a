// Slabs against reference values computed by others.
#include <tests/lab/experiments.h>
#include <tests/support/slab_references.h>

#include <cmath>
#include <vector>

namespace wend {
namespace {

TEST(SlowSlabReference, EveryRowIsMetByModes) {
    const std::vector<test::SlabReference> rows = test::slab_references();
    ASSERT_EQ(rows.size(), 36u);
    for (const test::SlabReference& row : rows) {
        for (const Tally tally : {Tally::transmittance, Tally::reflectance}) {
            PlanarExperiment e = test::slab(row.albedo, row.thickness, tally, "modes");
            e.mu0 = row.mu0;
            PlanarResult result = test::run(e, 4000);
            const double reference = tally == Tally::transmittance ? row.transmittance : row.reflectance;
            EXPECT_NEAR(result.exact[0], reference, 1e-6 * reference) << row.text;
            result.exact = {reference};
            EXPECT_TRUE(test::is_exact(result)) << row.text;
            EXPECT_NEAR(result.channels[0].mean(), reference, 1e-3 * reference) << row.text;
            EXPECT_LT(result.channels[0].relative_error(), 1e-4) << row.text;
            EXPECT_FALSE(test::is_exact(result, 1e-6, 1.001)) << row.text;
        }
    }
}

}  // namespace
}  // namespace wend
