#include <wend/stats/significance.h>

#include <wend/core/contracts.h>

#include <cmath>

namespace wend {

bool agrees(double mean, double standard_error, double reference, double z, double rounding) {
    return std::abs(mean - reference) <= z * standard_error + rounding * std::abs(reference);
}

bool agrees(const Moments& moments, double reference, double z, double rounding) {
    return agrees(moments.mean(), moments.standard_error(), reference, z, rounding);
}

double two_sided_p_value(double z) {
    return std::erfc(std::abs(z) / std::sqrt(2.0));
}

double sidak(double significance, int tests) {
    WEND_EXPECT(significance > 0 && significance < 1 && tests >= 1);
    return -std::expm1(std::log1p(-significance) / tests);
}

}  // namespace wend
