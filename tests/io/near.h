// Colours and points that are near others.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/vector.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wend::test {

inline void expect_near(const Rgb& a, const Rgb& b, float tolerance = 1e-5f) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(a[c], b[c], tolerance) << "channel " << c;
    }
}

/// By a tolerance that is relative where `b` is above one.
inline void expect_near_in_proportion(const Rgb& a, const Rgb& b, float tolerance = 1e-5f) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(a[c], b[c], tolerance * std::max(1.0f, std::abs(b[c]))) << "channel " << c;
    }
}

inline void expect_near(const Vec3& a, const Vec3& b) {
    EXPECT_LT(length(a - b), 1e-5f) << a << " and " << b;
}

}  // namespace wend::test
