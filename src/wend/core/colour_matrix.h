// Linear maps of colours.
#pragma once

#include <wend/core/colour.h>

#include <array>
#include <cstddef>

namespace wend {

/// A matrix of 3 rows that multiplies colours from the left; the identity at first.
struct ColourMatrix {
    std::array<std::array<double, 3>, 3> m{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

    static constexpr ColourMatrix diagonal(double r, double g, double b) {
        return {{{{r, 0, 0}, {0, g, 0}, {0, 0, b}}}};
    }

    constexpr std::array<double, 3> operator*(const std::array<double, 3>& v) const {
        std::array<double, 3> result{};
        for (std::size_t i = 0; i < 3; ++i) {
            result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
        }
        return result;
    }
    constexpr Rgb operator*(const Rgb& c) const {
        const auto v = *this * std::array<double, 3>{double{c.r}, double{c.g}, double{c.b}};
        return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
    }
    /// First the other, then this.
    constexpr ColourMatrix operator*(const ColourMatrix& first) const {
        ColourMatrix product;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                product.m[i][j] = m[i][0] * first.m[0][j] + m[i][1] * first.m[1][j] + m[i][2] * first.m[2][j];
            }
        }
        return product;
    }
    /// Of a matrix that is not singular.
    constexpr ColourMatrix inverse() const {
        ColourMatrix cofactors;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
                cofactors.m[j][i] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
            }
        }
        const double determinant =
            m[0][0] * cofactors.m[0][0] + m[0][1] * cofactors.m[1][0] + m[0][2] * cofactors.m[2][0];
        for (auto& row : cofactors.m) {
            for (double& value : row) {
                value /= determinant;
            }
        }
        return cofactors;
    }
    constexpr bool is_identity() const { return m == ColourMatrix().m; }
};

}  // namespace wend
