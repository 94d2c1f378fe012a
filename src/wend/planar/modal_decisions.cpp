#include <wend/planar/modal_decisions.h>

#include <wend/medium/averaged_phase.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace wend {

PlanarFlight ModalFlight::sample(const Site& from, double mu, Pcg32& random, Site& to) const {
    const PlanarAdjoint::Ray ray = adjoint_->ray(from, mu);
    const double radiance = ray.radiance();
    if (!(radiance > 0)) {
        // Nothing is expected from here; in case the adjoint is wrong, go on classically.
        const double s = -std::log1p(-random.uniform_double());
        if (!(s < ray.length)) {
            return {false, ray.length, 1};
        }
        at(from.depth + s * mu, to);
        return {true, s, 1};
    }
    if (random.uniform_double() * radiance < ray.pass * ray.arrival || !(ray.positive > 0)) {
        return {false, ray.length, ray.arrival / radiance};
    }
    for (;;) {
        const Stop stop = draw(ray, from.depth, random);
        at(stop.depth, to);
        const PlanarAdjoint::Source source = adjoint_->source(to, mu);
        if (adjoint_->all_positive() || random.uniform_double() * source.positive < source.value) {
            return {true, stop.length, source.value / radiance};
        }
    }
}

ModalFlight::Stop ModalFlight::draw(const PlanarAdjoint::Ray& ray, double depth, Pcg32& random) const {
    // The term, by its share of the positive ones.
    double u = random.uniform_double() * ray.positive;
    int chosen = 0;
    bool from_far = false;
    const auto choose = [&](const auto& shares, bool far) {
        for (int k = 0; k < adjoint_->modes() && u >= 0; ++k) {
            const double share = shares[static_cast<std::size_t>(k)];
            if (share > 0) {
                chosen = k;
                from_far = far;
                u -= share;
            }
        }
    };
    choose(ray.near, false);
    if (adjoint_->has_far()) {
        choose(ray.far, true);
    }
    // Its exponential over the way to the boundary. Where it grows, it is drawn as a falling one from the boundary
    // back.
    const double rate = 1 + (from_far != ray.deeper ? ray.cosine : -ray.cosine) * adjoint_->rate(chosen);
    const double v = random.uniform_double();
    const double z = std::abs(rate) * ray.length;
    const double s = z < 1e-8 ? v * ray.length : std::min(-std::log1p(v * std::expm1(-z)) / std::abs(rate), ray.length);
    const double signed_cosine = ray.deeper ? ray.cosine : -ray.cosine;
    const double boundary = ray.deeper ? adjoint_->slab().thickness : 0;
    if (rate < 0) {
        return {boundary - signed_cosine * s, ray.length - s};
    }
    const double to = depth + signed_cosine * s;
    return {ray.deeper ? std::min(to, boundary) : std::max(to, 0.0), s};
}

double ModalFlight::density_ratio(const Site& from, double mu, const PlanarFlight& outcome, const Site& to) const {
    const PlanarAdjoint::Ray ray = adjoint_->ray(from, mu);
    const double radiance = ray.radiance();
    if (!(radiance > 0)) {
        return 1;
    }
    return (outcome.scatters ? adjoint_->source(to, mu).value : ray.arrival) / radiance;
}

namespace {

// Resolution of the tables: isotropic scattering forgets the cosine before, and can afford more rows in depth.
constexpr ModalDirection::Resolution isotropic_rows{257, 1};
constexpr ModalDirection::Resolution anisotropic_rows{65, 129};
constexpr int cells = 64;
constexpr int resolution = 192;
/// Of the largest radiance at a depth: no direction is given up on.
constexpr double least_radiance = 1e-6;

/// Cosines where the radiance may jump: at 0 near a boundary, and where total reflection begins.
std::vector<double> radiance_breaks(const PlanarSlab& slab) {
    const auto critical = [](double ior) { return std::sqrt(1 - 1 / (ior * ior)); };
    std::vector<double> result = {-1};
    if (slab.near.ior > 1) {
        result.push_back(-critical(slab.near.ior));
    }
    result.push_back(0);
    if (!std::isinf(slab.thickness) && slab.far.ior > 1) {
        result.push_back(critical(slab.far.ior));
    }
    result.push_back(1);
    return result;
}

}  // namespace

ModalDirection::ModalDirection(double thickness, const Resolution& rows, std::vector<double> breaks, double g)
    : g_(g),
      thickness_(thickness),
      depth_rows_(rows.depths),
      cosine_rows_(rows.cosines),
      table_(std::move(breaks), cells, depth_rows_ * cosine_rows_) {
}

ModalDirection::ModalDirection(const PlanarAdjoint& adjoint, double g)
    : ModalDirection(adjoint, g, g == 0 ? isotropic_rows : anisotropic_rows) {
}

ModalDirection::ModalDirection(const PlanarAdjoint& adjoint, double g, const Resolution& rows)
    : ModalDirection(adjoint.slab().thickness, rows, radiance_breaks(adjoint.slab()), g) {
    // The last row of a half-space stands for all that lies deeper, where the longest mode alone is left.
    double deepest = 0;
    for (int k = 0; k < adjoint.modes(); ++k) {
        deepest = std::max(deepest, std::min(100 * adjoint.length(k), 1e6));
    }
    PlanarAdjoint::Site site;
    fill([&](double depth) {
        adjoint.at(std::isinf(thickness_) ? std::min(depth, deepest) : depth, site);
        return [&](double mu) { return adjoint.ray(site, mu).radiance(); };
    });
}

ModalDirection::ModalDirection(const std::function<double(double)>& radiance, double g)
    : ModalDirection(std::numeric_limits<double>::infinity(), {2, g == 0 ? 1 : anisotropic_rows.cosines}, {-1, 0, 1},
                     g) {
    fill([&](double /*depth*/) { return radiance; });
}

template <class Radiance>
void ModalDirection::fill(const Radiance& radiance_at) {
    std::vector<double> places;
    for (int piece = 0; piece < table_.pieces(); ++piece) {
        std::vector<double> some = table_.places(piece, resolution);
        // At the cosines where pieces meet, each piece sees its own side.
        const double nudge = 1e-9 * (some.back() - some.front());
        some.front() += nudge;
        some.back() -= nudge;
        places.insert(places.end(), some.begin(), some.end());
    }
    std::vector<std::vector<double>> phase(static_cast<std::size_t>(cosine_rows_));
    for (int j = 0; j < cosine_rows_; ++j) {
        const double before = cosine_rows_ == 1 ? 0 : std::cos(std::numbers::pi * j / (cosine_rows_ - 1));
        for (const double after : places) {
            phase[static_cast<std::size_t>(j)].push_back(averaged_henyey_greenstein(g_, before, after));
        }
    }
    std::vector<double> values(places.size()), density(places.size());
    for (int i = 0; i < depth_rows_; ++i) {
        const auto radiance = radiance_at(depth_at(static_cast<double>(i) / (depth_rows_ - 1)));
        double largest = 0;
        for (std::size_t p = 0; p < places.size(); ++p) {
            values[p] = radiance(places[p]);
            largest = std::max(largest, values[p]);
        }
        for (int j = 0; j < cosine_rows_; ++j) {
            for (std::size_t p = 0; p < places.size(); ++p) {
                const double f = phase[static_cast<std::size_t>(j)][p];
                density[p] = largest > 0 ? f * std::max(values[p] / largest, least_radiance) : f;
            }
            table_.set_row(i * cosine_rows_ + j, density, resolution);
        }
    }
}

// Rows are dense where the radiance changes fast: as the square root of the depth near a boundary.
double ModalDirection::position(double depth) const {
    const auto near = [](double x) {
        const double r = std::sqrt(std::max(x, 0.0));
        return r / (1 + r);
    };
    if (std::isinf(thickness_)) {
        return near(depth);
    }
    const double middle = near(0.5 * thickness_);
    return depth < 0.5 * thickness_ ? 0.5 * near(depth) / middle : 1 - 0.5 * near(thickness_ - depth) / middle;
}

double ModalDirection::depth_at(double position) const {
    const auto depth = [](double p) {
        const double r = p / std::max(1 - p, 1e-9);
        return r * r;
    };
    if (std::isinf(thickness_)) {
        return depth(position);
    }
    const double r = std::sqrt(0.5 * thickness_);
    const double middle = r / (1 + r);
    return position < 0.5 ? depth(2 * position * middle) : thickness_ - depth(2 * (1 - position) * middle);
}

QuantileTable::Blend ModalDirection::blend(double depth, double before) const {
    const double row = position(depth) * (depth_rows_ - 1);
    const int i = std::clamp(static_cast<int>(row), 0, depth_rows_ - 2);
    const double f = std::clamp(row - i, 0.0, 1.0);
    if (cosine_rows_ == 1) {
        return {{i, i + 1}, {1 - f, f}, 2};
    }
    const double column = std::acos(std::clamp(before, -1.0, 1.0)) * ((cosine_rows_ - 1) / std::numbers::pi);
    const int j = std::clamp(static_cast<int>(column), 0, cosine_rows_ - 2);
    const double h = column - j;
    const int first = i * cosine_rows_ + j, second = first + cosine_rows_;
    return {{first, first + 1, second, second + 1}, {(1 - f) * (1 - h), (1 - f) * h, f * (1 - h), f * h}, 4};
}

PlanarDirection ModalDirection::sample(double depth, double before, Pcg32& random) const {
    const QuantileTable::Sample s = table_.sample(blend(depth, before), random.uniform_double());
    return {s.value, s.density / averaged_henyey_greenstein(g_, before, s.value)};
}

double ModalDirection::density_ratio(double depth, double before, double after) const {
    return table_.density(blend(depth, before), after) / averaged_henyey_greenstein(g_, before, after);
}

}  // namespace wend
