#include <wend/io/spectrum/colour_space.h>

#include <wend/io/spectrum/colorimetry.h>
#include <wend/io/spectrum/white_balance.h>

#include <cstddef>

namespace wend {
namespace {

using pbrt::ColourSpace;

constexpr Primaries::Point d65_white{0.3127, 0.3290}, d60_white{0.32168, 0.33767};

// In the order of ColourSpace.
constexpr std::array<Primaries, 4> all_primaries = {{
    {{0.64, 0.33}, {0.3, 0.6}, {0.15, 0.06}, d65_white},
    {{0.68, 0.32}, {0.265, 0.69}, {0.15, 0.06}, d65_white},
    {{0.708, 0.292}, {0.17, 0.797}, {0.131, 0.046}, d65_white},
    {{0.7347, 0.2653}, {0, 1}, {0.0001, -0.077}, d60_white},
}};

std::array<double, 3> tristimulus(const Primaries::Point& p) {
    return {p.x / p.y, 1, (1 - p.x - p.y) / p.y};
}

/// Colours of luminance 1 to tristimulus values.
ColourMatrix xyz_of(const Primaries& p) {
    ColourMatrix m;
    const std::array<const Primaries::Point*, 3> points = {&p.red, &p.green, &p.blue};
    for (std::size_t c = 0; c < points.size(); ++c) {
        const Primaries::Point& point = *points[c];
        const std::array<double, 3> column = {point.x, point.y, 1 - point.x - point.y};
        for (std::size_t row = 0; row < column.size(); ++row) {
            m.m[row][c] = column[row];
        }
    }
    const std::array<double, 3> amounts = m.inverse() * tristimulus(p.white);
    return m * ColourMatrix::diagonal(amounts[0], amounts[1], amounts[2]);
}

}  // namespace

const Primaries& primaries_of(ColourSpace space) {
    return all_primaries[static_cast<std::size_t>(space)];
}

const ColourMatrix& rec709_from(ColourSpace space, bool keeps_white) {
    using Matrices = std::array<ColourMatrix, all_primaries.size()>;
    static const auto all = [] {
        std::array<Matrices, 2> matrices;
        const ColourMatrix from_xyz = xyz_of(all_primaries[0]).inverse();
        for (std::size_t i = 1; i < all_primaries.size(); ++i) {
            const ColourMatrix xyz = xyz_of(all_primaries[i]);
            matrices[0][i] = from_xyz * xyz;
            matrices[1][i] = from_xyz * adaptation(tristimulus(all_primaries[i].white), tristimulus(d65_white)) * xyz;
        }
        return matrices;
    }();
    return all[keeps_white ? 1 : 0][static_cast<std::size_t>(space)];
}

}  // namespace wend
