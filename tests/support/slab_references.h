// Slabs computed by others: reflectance and transmittance of isotropic scattering behind matched boundaries.
#pragma once

#include <tests/support/paths.h>

#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace wend::test {

struct SlabReference {
    double albedo = 0;
    double thickness = 0;       ///< in mean free paths
    std::optional<double> mu0;  ///< cosine of a beam's incidence; nothing: diffuse
    double transmittance = 0;
    double reflectance = 0;
    std::string text;  ///< the row of the table

    bool is_normal_beam() const { return mu0 == 1.0; }
};

/// The rows of the table. Throws for one that is not understood, and if there is none.
inline std::vector<SlabReference> slab_references() {
    std::ifstream file(source_dir() / "tests/references/slab_reference.csv");
    std::vector<SlabReference> rows;
    std::string line;
    std::getline(file, line);  // names of the columns
    while (std::getline(file, line)) {
        std::vector<std::string> fields;
        std::istringstream stream(line);
        for (std::string field; std::getline(stream, field, ',');) {
            fields.push_back(field);
        }
        SlabReference row{std::stod(fields.at(0)), std::stod(fields.at(1)), {},
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
    if (rows.empty()) {
        throw std::runtime_error("no slab references");
    }
    return rows;
}

}  // namespace wend::test
