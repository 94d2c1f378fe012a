#include <wend/core/motion.h>

#include <Imath/ImathMatrixAlgo.h>
#include <Imath/ImathQuat.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace wend {
namespace {

/// Embree takes one transform more.
constexpr std::size_t most_steps = 128;
constexpr double largest_turn = 3.14159265358979323846 / most_steps;

/// A stretch, then a turn, then a shift. Matrices act on row vectors, as Imath has them.
struct Parts {
    Imath::M33d stretch;
    Imath::Quatd turn;
    Imath::V3d shift;
};

Imath::M33d linear_part(const Transform& t) {
    Imath::M33d m;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            m.x[column][row] = t.element(row, column);
        }
    }
    return m;
}

/// The nearest orthogonal matrix, by averaging with the inverse transpose (higham1986).
Imath::M33d orthogonal_part(Imath::M33d m) {
    constexpr int most_rounds = 100;
    constexpr double exact = 1e-15;
    for (int i = 0; i < most_rounds; ++i) {
        const Imath::M33d next = (m + m.inverse().transposed()) * 0.5;
        const bool is_done = next.equalWithAbsError(m, exact);
        m = next;
        if (is_done) {
            break;
        }
    }
    return m;
}

Parts parts_of(const Transform& t) {
    const Imath::M33d linear = linear_part(t);
    Imath::M33d turn = orthogonal_part(linear);
    // What mirrors is a turn and a stretch by negative factors.
    turn *= turn.determinant() < 0 ? -1.0 : 1.0;
    return {linear * turn.transposed(), Imath::extractQuat(Imath::M44d(turn, Imath::V3d(0.0))).normalized(),
            Imath::V3d(t.element(0, 3), t.element(1, 3), t.element(2, 3))};
}

Transform transform_of(const Parts& p) {
    const Imath::M33d linear = p.stretch * p.turn.toMatrix33();
    Transform::Matrix m = {{0, 0, 0, p.shift.x}, {0, 0, 0, p.shift.y}, {0, 0, 0, p.shift.z}, {0, 0, 0, 1}};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            m[row][column] = linear.x[column][row];
        }
    }
    return Transform(m);
}

/// Where a time is between two transforms.
struct Step {
    std::size_t first;
    float part;
};

/// As Embree finds it.
Step step_at(float time, std::size_t steps) {
    const float place = std::clamp(time, 0.0f, 1.0f) * static_cast<float>(steps);
    const std::size_t first = std::min(static_cast<std::size_t>(place), steps - 1);
    return {first, place - static_cast<float>(first)};
}

Transform interpolated(const Motion& motion, float time) {
    if (!motion.is_moving()) {
        return motion.start();
    }
    const auto [first, part] = step_at(time, motion.key_count() - 1);
    Transform::Matrix m;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            m[row][column] = (1 - double{part}) * motion.key(first).element(row, column) +
                             double{part} * motion.key(first + 1).element(row, column);
        }
    }
    return Transform(m);
}

/// Of a map that has one. It throws nothing.
AffineMap inverse_of(const float (&m)[3][4]) {
    const auto at = [&](int row, int column) { return double{m[row][column]}; };
    double cofactors[3][3];
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            const int r1 = (row + 1) % 3, r2 = (row + 2) % 3, c1 = (column + 1) % 3, c2 = (column + 2) % 3;
            cofactors[row][column] = at(r1, c1) * at(r2, c2) - at(r1, c2) * at(r2, c1);
        }
    }
    const double determinant = at(0, 0) * cofactors[0][0] + at(0, 1) * cofactors[0][1] + at(0, 2) * cofactors[0][2];
    float inverse[3][4];
    for (int row = 0; row < 3; ++row) {
        double shift = 0;
        for (int column = 0; column < 3; ++column) {
            const double element = cofactors[column][row] / determinant;
            inverse[row][column] = static_cast<float>(element);
            shift -= element * at(column, 3);
        }
        inverse[row][3] = static_cast<float>(shift);
    }
    return AffineMap(inverse);
}

}  // namespace

Motion::Motion(const Transform& start, const Transform& end) : first_(start) {
    if (start == end) {
        return;
    }
    if (start.swaps_handedness() != end.swaps_handedness()) {
        throw std::domain_error("of the transformations at the start and the end only one mirrors");
    }
    const Parts a = parts_of(start), b = parts_of(end);
    const double angle = 2 * std::acos(std::min(std::abs(a.turn ^ b.turn), 1.0));
    const std::size_t steps =
        std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(angle / largest_turn)), 1, most_steps);
    for (std::size_t i = 1; i < steps; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(steps);
        later_.push_back(transform_of({a.stretch * (1 - t) + b.stretch * t, Imath::slerpShortestArc(a.turn, b.turn, t),
                                       a.shift * (1 - t) + b.shift * t}));
    }
    later_.push_back(end);
}

Motion Motion::operator*(const Motion& inner) const {
    Motion product(first_ * inner.first_);
    const std::size_t steps =
        is_moving() && inner.is_moving() ? most_steps : std::max(later_.size(), inner.later_.size());
    for (std::size_t i = 1; i <= steps; ++i) {
        const float time = static_cast<float>(i) / static_cast<float>(steps);
        product.later_.push_back(interpolated(*this, time) * interpolated(inner, time));
    }
    return product;
}

Placement Motion::at(float time) const {
    if (!is_moving()) {
        return {AffineMap(first_), AffineMap(first_.inverse())};
    }
    const auto [first, part] = step_at(time, later_.size());
    const AffineMap a(key(first)), b(key(first + 1));
    float m[3][4];
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            m[row][column] = (1 - part) * a.element(row, column) + part * b.element(row, column);
        }
    }
    return {AffineMap(m), inverse_of(m)};
}

}  // namespace wend
