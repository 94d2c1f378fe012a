#include <wend/core/transform.h>

#include <stdexcept>

namespace wend {
namespace {

Imath::M44d inverse_of(const Imath::M44d& m) {
    const Imath::M44d inverse = m.gjInverse();
    // Imath returns the identity for a singular matrix: only the product tells.
    const Imath::M44d product = m * inverse;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            if (!(std::abs(product.x[i][j] - (i == j ? 1.0 : 0.0)) < 1e-4)) {
                throw std::domain_error("the transformation matrix is singular");
            }
        }
    }
    return inverse;
}

}  // namespace

Transform::Transform() = default;

Transform::Transform(const Matrix& m) {
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            m_.x[column][row] = m[row][column];
        }
    }
    inverse_ = inverse_of(m_);
}

Transform Transform::translate(double x, double y, double z) {
    return {Imath::M44d().setTranslation(Imath::V3d(x, y, z)), Imath::M44d().setTranslation(Imath::V3d(-x, -y, -z))};
}

Transform Transform::scale(double x, double y, double z) {
    if (x == 0 || y == 0 || z == 0 || !std::isfinite(x * y * z)) {
        throw std::domain_error("a scale must be finite and not zero");
    }
    return {Imath::M44d().setScale(Imath::V3d(x, y, z)), Imath::M44d().setScale(Imath::V3d(1 / x, 1 / y, 1 / z))};
}

Transform Transform::rotate(double degrees, double x, double y, double z) {
    const Imath::V3d axis(x, y, z);
    if (!(axis.length() > 0) || !std::isfinite(axis.length() + degrees)) {
        throw std::domain_error("a rotation needs a finite angle and an axis that is not zero");
    }
    Imath::M44d m;
    m.setAxisAngle(axis.normalized(), degrees * (3.14159265358979323846 / 180));
    return {m, m.transposed()};
}

Transform Transform::look_at(const Imath::V3d& eye, const Imath::V3d& look, const Imath::V3d& up) {
    const Imath::V3d forward = (look - eye).normalized();
    const Imath::V3d right = up.normalized().cross(forward);
    if (!(forward.length() > 0) || !(right.length() > 1e-12)) {
        throw std::domain_error("the up vector and the viewing direction must be finite, not zero and not parallel");
    }
    const Imath::V3d x = right.normalized();
    const Imath::V3d y = forward.cross(x);
    const Matrix camera_to_world = {
        {x.x, y.x, forward.x, eye.x}, {x.y, y.y, forward.y, eye.y}, {x.z, y.z, forward.z, eye.z}, {0, 0, 0, 1}};
    return Transform(camera_to_world).inverse();
}

Transform Transform::operator*(const Transform& first) const {
    return {first.m_ * m_, inverse_ * first.inverse_};
}

Transform Transform::inverse() const {
    return {inverse_, m_};
}

Vec3 Transform::point(const Vec3& p) const {
    Imath::V3d out;
    m_.multVecMatrix(Imath::V3d(p), out);
    return Vec3(out);
}

Vec3 Transform::vector(const Vec3& v) const {
    Imath::V3d out;
    m_.multDirMatrix(Imath::V3d(v), out);
    return Vec3(out);
}

Vec3 Transform::normal(const Vec3& n) const {
    Imath::V3d out;
    inverse_.transposed().multDirMatrix(Imath::V3d(n), out);
    return Vec3(out);
}

double Transform::determinant() const {
    const auto& a = m_.x;
    return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
           a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

bool Transform::swaps_handedness() const {
    return determinant() < 0;
}

}  // namespace wend
