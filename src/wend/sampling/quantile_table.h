// Densities on an interval, tabulated over a parameter as quantile functions.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace wend {

/// A family of densities on one interval, row by row. The interval is cut into pieces at fixed places (where densities
/// may jump); in each piece a row keeps the piece's probability and its quantile function at fixed fractions, dense
/// at both ends, with the slopes there. Between rows quantile functions are interpolated linearly, and between
/// fractions by monotone cubics, so a value is drawn by one evaluation, and its density is the derivative of the very
/// function it was drawn by: exact for what is drawn, whatever the interpolation is worth as an approximation.
class QuantileTable {
public:
    /// `breaks`: increasing ends of the pieces, at least two. `cells`: of each quantile function, even. All rows are
    /// uniform at first.
    QuantileTable(std::vector<double> breaks, int cells, int rows);

    /// The places in one piece where set_row() wants the density, `resolution` of them.
    std::vector<double> places(int piece, int resolution) const;

    /// Sets a row from densities (not normalized, finite; negative ones count as 0) at places(piece, resolution), one
    /// list after the other. A floor keeps every density positive.
    void set_row(int row, std::span<const double> densities, int resolution);

    int pieces() const { return static_cast<int>(breaks_.size()) - 1; }

    /// A convex combination of up to four rows.
    struct Blend {
        std::array<int, 4> row{};
        std::array<double, 4> weight{1, 0, 0, 0};
        int count = 1;
    };

    struct Sample {
        double value = 0;
        double density = 0;
    };
    Sample sample(const Blend& blend, double u) const;
    double density(const Blend& blend, double value) const;

private:
    struct Node {
        double value, slope;  // of the quantile function, by fraction
    };
    double piece_probability(const Blend& blend, int piece) const;
    std::size_t node_index(int row, int piece, int node) const;
    struct Cubic {
        double value, slope;  // at the cell's begin
        double end_value, end_slope;
        Sample at(double s) const;  // value and derivative by s in [0,1]
    };
    Cubic cubic(const Blend& blend, int piece, int cell) const;
    void set_piece(int row, int piece, std::span<const double> densities);

    std::vector<double> breaks_;
    int cells_;
    std::vector<double> fraction_;     // of the nodes, cells + 1
    std::vector<double> probability_;  // row by row, piece by piece
    std::vector<Node> nodes_;
};

}  // namespace wend
