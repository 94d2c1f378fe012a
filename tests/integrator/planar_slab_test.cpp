// Slabs against reference values computed by others.
#include <tests/integrator/planar_experiments.h>
#include <tests/support/paths.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

namespace wend {
namespace {

struct Row {
    double albedo = 0, thickness = 0;
    std::optional<double> mu0;
    double transmission = 0, reflection = 0;
    std::string text;
};

/// Rows of albedo, thickness, incidence, transmission, reflection; the incidence in words.
std::vector<Row> read_rows(std::istream& file) {
    std::vector<Row> rows;
    std::string line;
    std::getline(file, line);  // names of the columns
    while (std::getline(file, line)) {
        std::vector<std::string> fields;
        std::istringstream stream(line);
        for (std::string field; std::getline(stream, field, ',');) {
            fields.push_back(field);
        }
        Row row{std::stod(fields.at(0)), std::stod(fields.at(1)), {},
                std::stod(fields.at(3)), std::stod(fields.at(4)), line};
        if (fields[2] == "normal-beam") {
            row.mu0 = 1;
        } else if (const std::size_t at = fields[2].find("mu0="); at != std::string::npos) {
            row.mu0 = std::stod(fields[2].substr(at + 4));
        } else if (fields[2] != "cosine-current") {
            throw std::runtime_error("unknown incidence: " + line);
        }
        rows.push_back(row);
    }
    return rows;
}

TEST(SlabReference, EveryRowIsMetByModes) {
    std::ifstream file(test::shared_dir() / "references" / "slab_reference.csv");
    if (!file) {
        GTEST_SKIP() << "the table of slab references is not here";
    }
    const std::vector<Row> rows = read_rows(file);
    ASSERT_EQ(rows.size(), 36u);
    for (const Row& row : rows) {
        for (const Tally tally : {Tally::transmittance, Tally::reflectance}) {
            PlanarExperiment e = test::slab(row.albedo, row.thickness, tally, "modes");
            e.mu0 = row.mu0;
            PlanarResult result = test::run(e, 4000);
            const double reference = tally == Tally::transmittance ? row.transmission : row.reflection;
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
