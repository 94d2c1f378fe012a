#include <wend/scene/bsdf/bsdf.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

Vec3 incident(float degrees, float side = 1) {
    const float angle = degrees * pi / 180;
    return {std::sin(angle), 0, side * std::cos(angle)};
}

/// ∫ min(p, q) dω of the lobes and of the BSDF, both normalized: 1 where they are the same, 0 where nothing is common.
/// The grid is fine around the lobes' axis.
double overlap(const Bsdf& bsdf, const Vec3& wo, const AxialLobes& lobes) {
    constexpr int angles = 400, azimuths = 64;
    const Vec3 axis = lobes.axis();
    const Vec3 side = normalize(std::abs(axis.x) < 0.9f ? cross(axis, Vec3(1, 0, 0)) : cross(axis, Vec3(0, 1, 0)));
    const Vec3 other = cross(axis, side);
    double total = 0, lobes_total = 0;
    std::vector<double> p, q, areas;
    for (int i = 0; i < angles; ++i) {
        const auto angle_at = [](double u) { return pi * u * u * u; };
        const double a0 = angle_at(static_cast<double>(i) / angles), a1 = angle_at((i + 1.0) / angles);
        const double area = 2 * pi * (std::cos(a0) - std::cos(a1)) / azimuths;
        const auto a = static_cast<float>((a0 + a1) / 2);
        for (int j = 0; j < azimuths; ++j) {
            const float phi = 2 * pi * (static_cast<float>(j) + 0.5f) / azimuths;
            const Vec3 w = axis * std::cos(a) + (side * std::cos(phi) + other * std::sin(phi)) * std::sin(a);
            const Rgb value = std::visit([&](const auto& b) { return b.evaluate(wo, w); }, bsdf);
            p.push_back(static_cast<double>(mean_value(value)));
            q.push_back(static_cast<double>(lobes.density(w)));
            areas.push_back(area);
            total += area * p.back();
            lobes_total += area * q.back();
        }
    }
    EXPECT_NEAR(lobes_total, 1, 0.01);
    double common = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        common += areas[i] * std::min(p[i] / total, q[i]);
    }
    return common;
}

Bsdf conductor(float alpha) {
    return ConductorBsdf{Rgb(0.2f), Rgb(3.9f), alpha, alpha};
}

TEST(BsdfLobes, ADiffuseSurfaceIsItsCosine) {
    for (const float side : {1.0f, -1.0f}) {
        const Bsdf bsdf = LambertBsdf{Rgb(0.7f)};
        EXPECT_GT(overlap(bsdf, incident(30, side), lobes_of(bsdf, incident(30, side))), 0.85);
        EXPECT_LT(overlap(bsdf, incident(30, side), lobes_of(bsdf, incident(30, -side))), 0.3);
    }
}

TEST(BsdfLobes, ARoughConductorIsAPeakAroundTheMirrorDirection) {
    for (const float alpha : {0.02f, 0.1f, 0.25f}) {
        for (const float degrees : {0.0f, 30.0f, 60.0f}) {
            for (const float side : {1.0f, -1.0f}) {
                const Vec3 wo = incident(degrees, side);
                EXPECT_GT(overlap(conductor(alpha), wo, lobes_of(conductor(alpha), wo)), degrees > 45 ? 0.7 : 0.85)
                    << "alpha " << alpha << ", incidence " << degrees;
            }
        }
    }
}

TEST(BsdfLobes, LobesOfAnotherRoughnessAreToldApart) {
    EXPECT_LT(overlap(conductor(0.1f), incident(30), lobes_of(conductor(0.25f), incident(30))), 0.6);
    EXPECT_LT(overlap(conductor(0.1f), incident(30), lobes_of(conductor(0.1f), incident(45))), 0.6);
}

TEST(BsdfLobes, WhatHasNoAxisIsNotPictured) {
    EXPECT_TRUE(is_pictured_by_lobes(LambertBsdf{Rgb(1.0f)}));
    EXPECT_TRUE(is_pictured_by_lobes(conductor(0.1f)));
    CoatedBsdf coated;
    coated.base = LambertBsdf{Rgb(0.5f)};
    EXPECT_TRUE(is_pictured_by_lobes(coated));
    EXPECT_TRUE(is_pictured_by_lobes(DiffuseTransmissionBsdf{Rgb(0.5f), Rgb(0.2f)}));
    EXPECT_FALSE(is_pictured_by_lobes(ThinDielectricBsdf{}));
    EXPECT_FALSE(is_pictured_by_lobes(conductor(0)));
    EXPECT_FALSE(is_pictured_by_lobes(DielectricBsdf{1.5f, 0.3f, 0.3f}));
    EXPECT_EQ(lobes_of(conductor(0), incident(0)).kappa(0), 0);
    EXPECT_EQ(lobes_of(DielectricBsdf{1.5f, 0.3f, 0.3f}, incident(0)).kappa(0), 0);
}

TEST(BsdfLobes, GrazingViewsStayFinite) {
    for (const float z : {0.0f, 1e-6f, -1e-6f}) {
        const AxialLobes lobes = lobes_of(conductor(0.002f), normalize(Vec3(1, 0, z)));
        for (int j = 0; j < lobes.size(); ++j) {
            EXPECT_TRUE(std::isfinite(lobes.amplitude(j)) && std::isfinite(lobes.kappa(j)));
        }
    }
}

}  // namespace
}  // namespace wend
