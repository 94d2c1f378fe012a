#include <wend/planar/discrete_ordinates.h>

#include <wend/medium/rough_boundary.h>
#include <wend/numeric/legendre.h>
#include <wend/numeric/quadrature.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace wend {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Nodes {
    VectorXd cosine;
    VectorXd weight;
};

void append(Nodes& nodes, int& at, const Quadrature& rule, const auto& place, const auto& slope) {
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        nodes.cosine[at] = place(rule.nodes[i]);
        nodes.weight[at] = rule.weights[i] * slope(rule.nodes[i]);
        ++at;
    }
}

/// Nodes on (0,1). `lean` in [0,1] is how much they crowd at 0.
Nodes matched_nodes(int count, double lean) {
    Nodes nodes{VectorXd(count), VectorXd(count)};
    int at = 0;
    append(
        nodes, at, gauss_legendre(count), [&](double s) { return s * (1 - lean + lean * s); },
        [&](double s) { return 1 - lean + 2 * lean * s; });
    return nodes;
}

/// The same, split at the critical angle: above it nodes follow the cosine outside, in which the boundary is smooth.
Nodes refractive_nodes(int count, double ior, double lean) {
    Nodes nodes{VectorXd(count), VectorXd(count)};
    const double critical = std::sqrt(1 - 1 / (ior * ior));
    int at = 0;
    append(
        nodes, at, gauss_legendre(count / 2), [&](double s) { return critical * s * (1 - lean + lean * s); },
        [&](double s) { return critical * (1 - lean + 2 * lean * s); });
    const auto inside = [&](double outside) { return std::sqrt(1 - (1 - outside * outside) / (ior * ior)); };
    append(nodes, at, gauss_legendre(count - count / 2), inside,
           [&](double outside) { return outside / (ior * ior * inside(outside)); });
    return nodes;
}

Nodes choose_nodes(const PlanarProblem& problem, int count) {
    const PlanarSlab& slab = problem.slab;
    const double ior = slab.near.ior > 1 ? slab.near.ior : (std::isinf(slab.thickness) ? 1 : slab.far.ior);
    const bool smooth = !slab.near.rough && !slab.far.rough;
    const bool split = ior > 1 && smooth && count >= 4;
    // Crowding costs exactness for the high moments: what the nodes of one part leave of the phase function's peak
    // decides.
    const double mean_cosine = problem.moments.size() > 1 ? std::abs(problem.moments[1]) : 0;
    const double resolved = -(split ? 0.5 : 1.0) * count * std::log(mean_cosine);
    const double lean = std::clamp((resolved - 2) / 6.5, 0.0, 1.0);
    return split ? refractive_nodes(count, ior, lean) : matched_nodes(count, lean);
}

/// Modes at the nodes: columns phi_k(t_j) and phi_k(-t_j).
struct Basis {
    VectorXd length;
    MatrixXd forward;   // mu = +t
    MatrixXd backward;  // mu = -t
};

/// The phase function between nodes of one half range, same and opposite, as symmetric matrices sqrt(w_i) p sqrt(w_j).
struct Kernel {
    MatrixXd even;  // p(t, t') + p(t, -t')
    MatrixXd odd;
};

/// The largest of every second moment from `first` on, at least 0.
double largest_moment(const std::vector<double>& moments, std::size_t first) {
    double largest = 0;
    for (std::size_t l = first; l < moments.size(); l += 2) {
        largest = std::max(largest, moments[l]);
    }
    return largest;
}

/// A symmetric matrix with all eigenvalues brought down to `limit`.
MatrixXd limited(const MatrixXd& matrix, double limit) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(matrix);
    const VectorXd excess = (solver.eigenvalues().array() - limit).cwiseMax(0);
    return matrix - solver.eigenvectors() * excess.asDiagonal() * solver.eigenvectors().transpose();
}

MatrixXd legendre_table(const VectorXd& cosine, Eigen::Index count) {
    MatrixXd table(count, cosine.size());
    for (Eigen::Index j = 0; j < cosine.size(); ++j) {
        legendre_polynomials(cosine[j], {table.col(j).data(), static_cast<std::size_t>(count)});
    }
    return table;
}

Kernel make_kernel(const Nodes& nodes, const std::vector<double>& moments, const VectorXd& weights_of_moments) {
    const MatrixXd p = legendre_table(nodes.cosine, weights_of_moments.size());
    const VectorXd root = nodes.weight.cwiseSqrt();
    // P_l(-t) = (-1)^l P_l(t): even moments make the sum, odd ones the difference.
    VectorXd even = weights_of_moments, odd = weights_of_moments;
    for (Eigen::Index l = 0; l < even.size(); ++l) {
        (l % 2 == 0 ? odd : even)[l] = 0;
    }
    const MatrixXd scaled = p * root.asDiagonal();
    Kernel kernel;
    kernel.even = 2 * scaled.transpose() * even.asDiagonal() * scaled;
    kernel.odd = 2 * scaled.transpose() * odd.asDiagonal() * scaled;
    // Scattering conserves radiance on the nodes too: the smallest symmetric change that makes it so.
    const VectorXd missing = kernel.even * root - root;
    kernel.even -= missing * root.transpose() + root * missing.transpose();
    kernel.even += root.dot(missing) * root * root.transpose();
    // The eigenvalues of scattering are the moments. Few nodes confuse the high ones of a peaked phase function with
    // the low ones, and may add up to more than is scattered.
    const MatrixXd constant = root * root.transpose();
    kernel.even = constant + limited(kernel.even - constant, largest_moment(moments, 2));
    kernel.odd = limited(kernel.odd, largest_moment(moments, 1));
    return kernel;
}

/// The modes of albedo c < 1, longest first.
Basis eigenmodes(double c, const Nodes& nodes, const Kernel& kernel) {
    const Eigen::Index n = nodes.cosine.size();
    const VectorXd root = nodes.weight.cwiseSqrt();
    const VectorXd inverse = nodes.cosine.cwiseInverse();
    const MatrixXd identity = MatrixXd::Identity(n, n);
    const MatrixXd even = identity - c * kernel.even;
    const MatrixXd odd = identity - c * kernel.odd;
    // M^-1 odd M^-1 even s = s / v², s the sum of both directions: symmetric after a Cholesky factor.
    const MatrixXd lower = Eigen::LLT<MatrixXd>(inverse.asDiagonal() * odd * inverse.asDiagonal()).matrixL();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(lower.transpose() * even * lower);
    MatrixXd sum = lower * solver.eigenvectors();
    VectorXd length = solver.eigenvalues().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    MatrixXd difference = -(inverse.asDiagonal() * (even * sum)) * length.asDiagonal();

    // The longest one from the inverse problem, where the albedo's distance from 1 enters undiluted: the square roots
    // of the weights are an eigenvector of `even` to the eigenvalue 1 - c.
    const MatrixXd deflated_inverse = (even + c * root * root.transpose()).inverse();
    const MatrixXd even_inverse = deflated_inverse + (1 / (1 - c) - 1) * root * root.transpose();
    const MatrixXd odd_factor = Eigen::LLT<MatrixXd>(odd.inverse()).matrixL();
    const MatrixXd half = nodes.cosine.asDiagonal() * odd_factor;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> inverse_solver(half.transpose() * even_inverse * half);
    const VectorXd longest = inverse_solver.eigenvectors().col(n - 1);
    length[0] = std::sqrt(inverse_solver.eigenvalues()[n - 1]);
    sum.col(0) = even_inverse * (half * longest);
    difference.col(0) = -length[0] * (odd_factor * longest);

    const auto unscaled = root.cwiseInverse().asDiagonal();
    Basis basis{length, 0.5 * (unscaled * (sum + difference)), 0.5 * (unscaled * (sum - difference))};
    for (Eigen::Index k = 0; k < n; ++k) {
        // Each mode to unit size, its sum of weights positive where it has one.
        const double total = nodes.weight.dot(basis.forward.col(k) + basis.backward.col(k));
        const double size = basis.backward.col(k).cwiseAbs().maxCoeff();
        const double scale = (total < 0 ? -1 : 1) / size;
        basis.forward.col(k) *= scale;
        basis.backward.col(k) *= scale;
    }
    return basis;
}

/// Without absorption the longest mode is a constant.
void make_constant(Basis& basis) {
    basis.length[0] = std::numeric_limits<double>::infinity();
    basis.forward.col(0).setOnes();
    basis.backward.col(0).setOnes();
}

/// What a boundary does with radiance from inside at the nodes: what it reflects, node to node, and what leaves.
struct BoundaryAtNodes {
    MatrixXd reflection;
    VectorXd leaving;
};

BoundaryAtNodes at_nodes(const PlanarBoundary& boundary, const Nodes& nodes) {
    const Eigen::Index n = nodes.cosine.size();
    BoundaryAtNodes result{MatrixXd::Zero(n, n), VectorXd(n)};
    for (Eigen::Index j = 0; j < n; ++j) {
        const double t = nodes.cosine[j];
        result.leaving[j] = boundary.illumination_inside(t);
        if (!boundary.rough) {
            result.reflection(j, j) = boundary.reflectance(t);
            continue;
        }
        for (Eigen::Index i = 0; i < n; ++i) {
            result.reflection(j, i) = nodes.weight[i] * boundary.rough->reflection(t, nodes.cosine[i]);
        }
    }
    return result;
}

/// The coefficients: first those of the falling modes, then those of the growing ones.
VectorXd match_boundaries(const Basis& basis, const PlanarSlab& slab, const Nodes& nodes) {
    const Eigen::Index n = nodes.cosine.size();
    const BoundaryAtNodes near = at_nodes(slab.near, nodes);
    const MatrixXd near_falling = basis.backward - near.reflection * basis.forward;
    if (std::isinf(slab.thickness)) {
        return near_falling.fullPivLu().solve(near.leaving);
    }
    const BoundaryAtNodes far = at_nodes(slab.far, nodes);
    VectorXd through(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        through[k] = std::exp(-slab.thickness / basis.length[k]);
    }
    MatrixXd system(2 * n, 2 * n);
    system << near_falling, (basis.forward - near.reflection * basis.backward) * through.asDiagonal(),
        (basis.forward - far.reflection * basis.backward) * through.asDiagonal(),
        basis.backward - far.reflection * basis.forward;
    VectorXd right(2 * n);
    right << near.leaving, far.leaving;
    return system.fullPivLu().solve(right);
}

/// In a slab of little absorption the falling and the growing long mode almost cancel. Exponentials stay usable down to
/// this product of thickness and rate.
constexpr double least_decay = 1e-4;

bool are_moments(const std::vector<double>& moments) {
    return !moments.empty() && moments[0] == 1 &&
           std::all_of(moments.begin() + 1, moments.end(), [](double m) { return std::abs(m) < 1; });
}

bool is_index(double ior) {
    return ior >= 1 && std::isfinite(ior);
}

double usable_albedo(const PlanarProblem& problem) {
    if (std::isinf(problem.slab.thickness)) {
        return problem.albedo;
    }
    const double g = problem.moments.size() > 1 ? problem.moments[1] : 0;
    const double rate = least_decay / (problem.slab.thickness + 1.42 / (1 - g));
    return std::min(problem.albedo, 1 - rate * rate / (3 * (1 - g)));
}

}  // namespace

std::vector<double> henyey_greenstein_moments(double g, int count) {
    std::vector<double> moments;
    for (double power = 1; static_cast<int>(moments.size()) < count; power *= g) {
        moments.push_back(power);
    }
    return moments;
}

PlanarModes solve_planar(const PlanarProblem& problem) {
    const int count = problem.transients + 1;
    if (!(problem.albedo >= 0 && problem.albedo <= 1) || problem.transients < 0 || count > PlanarAdjoint::max_modes ||
        !are_moments(problem.moments) || !(problem.slab.thickness > 0) || !is_index(problem.slab.near.ior) ||
        !is_index(problem.slab.far.ior)) {
        throw std::invalid_argument("a planar problem with values out of range");
    }
    const Nodes nodes = choose_nodes(problem, count);
    const auto used = static_cast<Eigen::Index>(std::min<std::size_t>(problem.moments.size(), 2 * nodes.cosine.size()));
    VectorXd weights_of_moments(used);
    for (Eigen::Index l = 0; l < used; ++l) {
        weights_of_moments[l] = 0.5 * static_cast<double>(2 * l + 1) * problem.moments[static_cast<std::size_t>(l)];
    }
    const double albedo = usable_albedo(problem);
    const Kernel kernel = make_kernel(nodes, problem.moments, weights_of_moments);
    Basis basis = eigenmodes(std::min(albedo, 1 - 1e-15), nodes, kernel);
    if (albedo == 1) {
        make_constant(basis);
    }
    const VectorXd coefficients = match_boundaries(basis, problem.slab, nodes);

    const MatrixXd p = legendre_table(nodes.cosine, used);
    PlanarModes result;
    for (Eigen::Index k = 0; k < nodes.cosine.size(); ++k) {
        PlanarModes::Mode mode;
        mode.length = basis.length[k];
        mode.near = coefficients[k];
        mode.far = std::isinf(problem.slab.thickness) ? 0 : coefficients[nodes.cosine.size() + k];
        for (Eigen::Index l = 0; l < used; ++l) {
            const VectorXd both = basis.forward.col(k) + (l % 2 == 0 ? 1 : -1) * basis.backward.col(k);
            const double moment = nodes.weight.cwiseProduct(p.row(l).transpose()).dot(both);
            mode.shape.push_back(albedo * weights_of_moments[l] * moment);
        }
        result.modes.push_back(std::move(mode));
    }
    return result;
}

}  // namespace wend
