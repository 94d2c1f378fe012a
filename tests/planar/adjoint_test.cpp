#include <wend/medium/fresnel.h>
#include <wend/numeric/quadrature.h>
#include <wend/planar/adjoint.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace wend {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double sky(double cosine) {
    return 0.3 + cosine;
}

/// Modes as of a solution, but of no particular one. Those of a slab grow, too.
PlanarModes some_modes(bool directional, bool grow) {
    PlanarModes modes;
    for (const double length : {4.0, 0.9, 0.31, 0.02}) {
        PlanarModes::Mode mode;
        mode.length = length;
        mode.near = 0.5 * std::sqrt(length);
        mode.far = grow ? 0.2 * length : 0;
        mode.shape = directional ? std::vector<double>{0.9, 0.15 * length, -0.1} : std::vector<double>{0.9};
        modes.modes.push_back(mode);
    }
    return modes;
}

struct Layer {
    std::string name;
    PlanarModes modes;
    PlanarSlab slab;
};

std::vector<Layer> layers() {
    std::vector<Layer> result;
    for (const bool directional : {false, true}) {
        for (const double thickness : {infinity, 3.0, 1e-4}) {
            for (const double ior : {1.0, 1.4}) {
                Layer layer;
                layer.name = (directional ? "directional, index " : "isotropic, index ") + std::to_string(ior) +
                             ", thickness " + std::to_string(thickness);
                layer.modes = some_modes(directional, std::isfinite(thickness));
                layer.slab.thickness = thickness;
                layer.slab.near = {ior, sky, nullptr};
                // The far side differs.
                layer.slab.far = {ior == 1 ? 1.2 : 1, [](double /*cosine*/) { return 0.7; }, nullptr};
                result.push_back(layer);
            }
        }
    }
    Layer rough = result[1];
    rough.name = "rough";
    rough.slab.near.rough = std::make_shared<RoughBoundary>(1.4, 0.3);
    result.push_back(rough);
    rough.slab.thickness = 2;
    rough.modes = some_modes(true, true);
    rough.name = "rough slab";
    result.push_back(rough);
    return result;
}

double source_at(const PlanarAdjoint& adjoint, double depth, double mu) {
    PlanarAdjoint::Site site;
    adjoint.at(depth, site);
    return adjoint.source(site, mu).value;
}

/// The source from its definition.
double defined_source(const Layer& layer, double depth, double mu) {
    double sum = 0;
    for (const PlanarModes::Mode& mode : layer.modes.modes) {
        const auto q = [&](double x) {
            return mode.shape[0] +
                   (mode.shape.size() > 1 ? mode.shape[1] * x + mode.shape[2] * (1.5 * x * x - 0.5) : 0);
        };
        sum += mode.near * q(mu) * std::exp(-depth / mode.length);
        if (std::isfinite(layer.slab.thickness)) {
            sum += mode.far * q(-mu) * std::exp(-(layer.slab.thickness - depth) / mode.length);
        }
    }
    return sum;
}

/// The radiance by numerical integration along the ray.
double integrated(const PlanarAdjoint& adjoint, double depth, double mu) {
    const bool deeper = mu > 0;
    const double length = (deeper ? adjoint.slab().thickness - depth : depth) / std::abs(mu);
    const double reach = std::min(length, 60.0);
    static const Quadrature rule = gauss_legendre(12);
    double sum = 0;
    constexpr int panels = 400;
    for (int i = 0; i < panels; ++i) {
        // Panels dense at both ends, where short modes live.
        const auto end = [&](int k) {
            const double u = static_cast<double>(k) / panels;
            return reach * u * u * u * (10 + u * (6 * u - 15));
        };
        for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
            const double s = end(i) + (end(i + 1) - end(i)) * rule.nodes[j];
            sum += rule.weights[j] * (end(i + 1) - end(i)) * std::exp(-s) * source_at(adjoint, depth + s * mu, mu);
        }
    }
    return sum + (std::isinf(length) ? 0 : std::exp(-length) * adjoint.arrival(deeper, std::abs(mu)));
}

TEST(PlanarAdjoint, HasTheSourceItWasGiven) {
    for (const Layer& layer : layers()) {
        const PlanarAdjoint adjoint(layer.modes, layer.slab);
        for (const double part : {0.0, 0.2, 0.7, 1.0}) {
            const double depth = part * std::min(layer.slab.thickness, 9.0);
            for (const double mu : {-1.0, -0.4, 0.0, 0.37, 1.0}) {
                // Directions are interpolated.
                EXPECT_NEAR(source_at(adjoint, depth, mu), defined_source(layer, depth, mu), 1e-5) << layer.name;
            }
        }
    }
}

TEST(PlanarAdjoint, RadianceIsTheSourceAndTheBoundaryCarriedAlongTheRay) {
    for (const Layer& layer : layers()) {
        const PlanarAdjoint adjoint(layer.modes, layer.slab);
        for (const double part : {0.0, 0.003, 0.4, 1.0}) {
            const double depth = part * std::min(layer.slab.thickness, 9.0);
            for (const double mu : {-1.0, -0.77, -0.31, -0.02, 0.05, 0.31, 0.9, 1.0}) {
                const double expected = integrated(adjoint, depth, mu);
                EXPECT_NEAR(adjoint.radiance(depth, mu), expected, 2e-9 * expected)
                    << layer.name << ", depth " << depth << ", mu " << mu;
            }
        }
    }
}

TEST(PlanarAdjoint, ContributionsOfTermsAddUp) {
    for (const Layer& layer : layers()) {
        const PlanarAdjoint adjoint(layer.modes, layer.slab);
        PlanarAdjoint::Site site;
        adjoint.at(0.3 * std::min(layer.slab.thickness, 9.0), site);
        for (const double mu : {-0.6, 0.6}) {
            const PlanarAdjoint::Ray ray = adjoint.ray(site, mu);
            double sum = 0, positive = 0;
            for (std::size_t k = 0; k < layer.modes.modes.size(); ++k) {
                sum += ray.near[k] + (adjoint.has_far() ? ray.far[k] : 0);
                positive += std::max(ray.near[k], 0.0) + (adjoint.has_far() ? std::max(ray.far[k], 0.0) : 0);
            }
            EXPECT_NEAR(ray.scattered, sum, 1e-14);
            EXPECT_NEAR(ray.positive, positive, 1e-14);
            EXPECT_EQ(ray.deeper, mu > 0);
            EXPECT_NEAR(ray.pass, std::exp(-ray.length), 1e-15);
        }
    }
}

TEST(PlanarAdjoint, IsContinuousWhereARayDecaysAsAMode) {
    // The attenuation of a mode and that of the ray cancel in the quotient.
    for (const Layer& layer : layers()) {
        const PlanarAdjoint adjoint(layer.modes, layer.slab);
        const double depth = 0.6 * std::min(layer.slab.thickness, 9.0);
        for (const double length : {0.9, 0.31, 0.02}) {
            for (const double off : {0.0, 1e-15, 1e-12, -1e-12, 1e-9, -1e-7, 1e-5, -1e-4, 4e-4}) {
                for (const double sign : {-1.0, 1.0}) {
                    const double mu = sign * length * (1 + off);
                    const double expected = integrated(adjoint, depth, mu);
                    EXPECT_NEAR(adjoint.radiance(depth, mu), expected, 2e-9 * expected) << layer.name << ", mu " << mu;
                }
            }
        }
    }
}

TEST(PlanarAdjoint, ArrivalsAreWhatLeavesAndWhatIsReflected) {
    for (const Layer& layer : layers()) {
        const PlanarAdjoint adjoint(layer.modes, layer.slab);
        for (const bool far : {false, true}) {
            if (far && std::isinf(layer.slab.thickness)) {
                continue;
            }
            const PlanarBoundary& boundary = far ? layer.slab.far : layer.slab.near;
            const auto inward = [&](double t) {
                return far ? adjoint.radiance(layer.slab.thickness, -t) : adjoint.radiance(0, t);
            };
            // Nodes of the table where the boundary is rough.
            for (const double t : {0.125, 0.5, 0.75, 1.0}) {
                double expected = boundary.illumination_inside(t);
                if (boundary.rough) {
                    const Quadrature rule = gauss_legendre(64);
                    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
                        expected +=
                            rule.weights[i] * boundary.rough->reflection(t, rule.nodes[i]) * inward(rule.nodes[i]);
                    }
                } else {
                    expected += boundary.reflectance(t) * inward(t);
                }
                EXPECT_NEAR(adjoint.arrival(far, t), expected, (boundary.rough ? 2e-3 : 1e-12) * expected)
                    << layer.name << ", cosine " << t;
            }
        }
    }
}

TEST(PlanarBoundary, FollowsFresnelAndSnellius) {
    const PlanarBoundary matched{1, sky, nullptr};
    EXPECT_EQ(matched.reflectance(0.2), 0);
    EXPECT_EQ(matched.illumination_inside(0.2), sky(0.2));
    EXPECT_EQ(PlanarBoundary().illumination_inside(0.2), 0);
    const PlanarBoundary refractive{1.5, sky, nullptr};
    EXPECT_NEAR(refractive.reflectance(1), 0.04, 1e-15);
    EXPECT_EQ(refractive.reflectance(0.7), 1);  // beyond the critical angle
    EXPECT_EQ(refractive.illumination_inside(0.7), 0);
    const double outside = 0.6, inside = std::sqrt(1 - (1 - outside * outside) / 2.25);
    EXPECT_NEAR(refractive.illumination_inside(inside), (1 - fresnel_dielectric(outside, 1.5)) * sky(outside), 1e-14);
}

TEST(PlanarAdjoint, StaysFiniteAtAnyDepthAndAngle) {
    for (const double thickness : {1e-4, 1.0, 600.0, infinity}) {
        PlanarModes modes = some_modes(true, std::isfinite(thickness));
        modes.modes.push_back({1e-7, 0.1, 0.1, {1}});
        modes.modes.push_back({infinity, 0.1, 0, {1}});
        PlanarSlab slab;
        slab.thickness = thickness;
        slab.near = {1.3, sky, nullptr};
        const PlanarAdjoint adjoint(modes, slab);
        for (double depth : {0.0, 1e-300, 1e-12, 0.5, 1.0, 1e5}) {
            depth = std::min(depth, thickness);
            for (const double mu : {0.0, 1e-300, 1e-12, 1e-7, 0.3, 1.0}) {
                for (const double sign : {-1.0, 1.0}) {
                    const double radiance = adjoint.radiance(depth, sign * mu);
                    EXPECT_TRUE(radiance >= 0 && radiance < 100) << radiance << " at " << depth << ", " << sign * mu;
                }
            }
        }
    }
}

TEST(PlanarAdjoint, GrazingRaysSeeTheSourceAround) {
    const Layer layer = layers()[7];
    const PlanarAdjoint adjoint(layer.modes, layer.slab);
    for (const double mu : {-1e-12, 1e-12}) {
        EXPECT_NEAR(adjoint.radiance(1, mu), source_at(adjoint, 1, mu), 1e-10);
    }
}

/// The least part of the positive terms that is left of the source, at depths and directions of no table.
double least_part(const PlanarAdjoint& adjoint) {
    double least = 1;
    const double thickness = adjoint.slab().thickness;
    for (int i = 0; i < 300; ++i) {
        const double near = std::pow(10.0, -6 + 9.7 * i / 300) - 1e-6;
        for (const double depth :
             {std::min(near, thickness), std::isinf(thickness) ? near : thickness - std::min(near, thickness)}) {
            PlanarAdjoint::Site site;
            adjoint.at(depth, site);
            for (int j = 0; j <= 40; ++j) {
                const PlanarAdjoint::Source source = adjoint.source(site, std::cos(j * std::acos(-1.0) / 40));
                if (source.positive > 0) {
                    least = std::min(least, source.value / source.positive);
                }
            }
        }
    }
    return least;
}

TEST(KeepPositive, LeavesGoodGuidesAlone) {
    for (const Layer& layer : layers()) {
        PlanarAdjoint adjoint(layer.modes, layer.slab);
        const double before = adjoint.radiance(0, 0.4);
        EXPECT_EQ(adjoint.keep_positive(), 1) << layer.name;
        EXPECT_EQ(adjoint.radiance(0, 0.4), before);
    }
    // Negative terms alone are no reason.
    PlanarModes modes = some_modes(false, false);
    modes.modes[1].near = -0.1;
    PlanarAdjoint adjoint(modes, {});
    EXPECT_FALSE(adjoint.all_positive());
    EXPECT_EQ(adjoint.keep_positive(), 1);
}

TEST(KeepPositive, LowersNegativeTermsUntilTheSourceIsPositive) {
    for (const bool directional : {false, true}) {
        for (const double thickness : {infinity, 3.0}) {
            PlanarModes modes = some_modes(directional, std::isfinite(thickness));
            modes.modes[1].near = -2.5;
            modes.modes[2].far = -0.8;
            PlanarSlab slab;
            slab.thickness = thickness;
            PlanarAdjoint adjoint(modes, slab);
            EXPECT_LT(least_part(adjoint), 0);
            const double factor = adjoint.keep_positive();
            EXPECT_LT(factor, 1);
            EXPECT_GT(factor, 0.1);
            EXPECT_GE(least_part(adjoint), 0.9e-3);
        }
    }
}

TEST(KeepPositive, MakesTheLongestModePositiveInAllDirections) {
    // As the truncated polynomial of a peaked phase function: no other mode could make up for it in the depth.
    PlanarModes modes = some_modes(true, false);
    modes.modes[0].shape = {0.5, 1.5, 0.9, 0.4};
    PlanarAdjoint adjoint(modes, {});
    EXPECT_LT(source_at(adjoint, 40, -0.7), 0);
    const double forward = source_at(adjoint, 40, 1);
    adjoint.keep_positive();
    EXPECT_GT(source_at(adjoint, 40, -0.7), 0);
    EXPECT_LT(source_at(adjoint, 40, -0.7), 0.01 * forward);
    EXPECT_EQ(source_at(adjoint, 40, 1), forward);
    EXPECT_LT(adjoint.radiance(0, 0.5), 10);
    EXPECT_GE(least_part(adjoint), 0.9e-3);
}

TEST(PlanarAdjoint, RefusesWhatIsNotFinite) {
    const auto refuses = [](const auto& change) {
        PlanarModes modes = some_modes(true, true);
        change(modes);
        EXPECT_THROW(PlanarAdjoint(modes, {}), std::invalid_argument);
    };
    refuses([](PlanarModes& m) { m.modes[0].near = nan; });
    refuses([](PlanarModes& m) { m.modes[1].far = infinity; });
    refuses([](PlanarModes& m) { m.modes[2].length = 0; });
    refuses([](PlanarModes& m) { m.modes[2].length = nan; });
    refuses([](PlanarModes& m) { m.modes[2].shape[1] = nan; });
    refuses([](PlanarModes& m) { m.modes.resize(PlanarAdjoint::max_modes + 1, m.modes[0]); });
    EXPECT_EQ(PlanarAdjoint({}, {}).radiance(1, 0.5), 0);
}

}  // namespace
}  // namespace wend
