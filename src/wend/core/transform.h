#pragma once

#include <wend/core/export.h>
#include <wend/core/vector.h>

#include <Imath/ImathMatrix.h>

#include <algorithm>

namespace wend {

/// An affine (or, for cameras, projective) map with its inverse, in the column-vector convention: `(a * b)(p) ==
/// a(b(p))`. Held in double precision: scene files chain many transforms, and the world is then float.
class WEND_API Transform {
public:
    /// Row-major matrix m[row][column] acting on column vectors.
    using Matrix = double[4][4];

    Transform();
    /// Throws std::domain_error if the matrix is singular or not finite.
    explicit Transform(const Matrix& m);

    /// By a vector.
    static Transform translate(double x, double y, double z);
    /// By a factor along each axis.
    static Transform scale(double x, double y, double z);
    /// Around an axis through the origin, of any length but 0.
    static Transform rotate(double degrees, double x, double y, double z);
    /// World-to-camera transform with the camera at `eye`, looking along +z, left-handed as in pbrt. Throws
    /// std::domain_error if the vectors are degenerate.
    static Transform look_at(const Imath::V3d& eye, const Imath::V3d& look, const Imath::V3d& up);

    /// The map that does `first` and then this.
    Transform operator*(const Transform& first) const;
    /// The map back.
    Transform inverse() const;

    /// Where a point goes.
    Vec3 point(const Vec3& p) const;
    /// Where a direction goes, with its length.
    Vec3 vector(const Vec3& v) const;
    /// Normals map by the inverse transpose; the result is not normalized.
    Vec3 normal(const Vec3& n) const;
    /// Whether right-handed frames become left-handed.
    bool swaps_handedness() const;
    /// Of the matrix, rows and columns from 0.
    double element(int row, int column) const { return m_.x[column][row]; }
    /// The volume factor |det| of the linear part.
    double determinant() const;

    /// Whether the matrices are the same.
    friend bool operator==(const Transform&, const Transform&) = default;

private:
    Transform(const Imath::M44d& m, const Imath::M44d& inverse) : m_(m), inverse_(inverse) {}

    Imath::M44d m_;  // Imath multiplies row vectors from the left, so these hold the transposes
    Imath::M44d inverse_;
};

/// An affine map in single precision, for the path loop.
class AffineMap {
public:
    AffineMap() = default;
    /// Drops the projective row, which must be (0, 0, 0, 1).
    explicit AffineMap(const Transform& t) {
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 4; ++column) {
                m_[row][column] = static_cast<float>(t.element(row, column));
            }
        }
    }
    /// Of its rows, without the projective one.
    explicit AffineMap(const float (&rows)[3][4]) { std::copy_n(&rows[0][0], 12, &m_[0][0]); }

    /// Rows from 0 to 2, columns from 0 to 3.
    float element(int row, int column) const { return m_[row][column]; }

    /// Where a point goes.
    Vec3 point(const Vec3& p) const { return vector(p) + Vec3(m_[0][3], m_[1][3], m_[2][3]); }
    /// Where a direction goes, with its length.
    Vec3 vector(const Vec3& v) const {
        return {m_[0][0] * v.x + m_[0][1] * v.y + m_[0][2] * v.z, m_[1][0] * v.x + m_[1][1] * v.y + m_[1][2] * v.z,
                m_[2][0] * v.x + m_[2][1] * v.y + m_[2][2] * v.z};
    }
    /// Bounds of the terms that point() adds up for points whose coordinates are no larger than these: rounding is in
    /// proportion to it.
    Vec3 magnitude(const Vec3& largest) const {
        const auto row = [&](int i) {
            return std::abs(m_[i][0]) * largest.x + std::abs(m_[i][1]) * largest.y + std::abs(m_[i][2]) * largest.z +
                   std::abs(m_[i][3]);
        };
        return {row(0), row(1), row(2)};
    }
    /// The transposed linear part: maps normals when this is the inverse map.
    Vec3 transposed_vector(const Vec3& v) const {
        return {m_[0][0] * v.x + m_[1][0] * v.y + m_[2][0] * v.z, m_[0][1] * v.x + m_[1][1] * v.y + m_[2][1] * v.z,
                m_[0][2] * v.x + m_[1][2] * v.y + m_[2][2] * v.z};
    }

private:
    float m_[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
};

}  // namespace wend
