#include <wend/numeric/elliptic.h>

#include <wend/core/contracts.h>

#include <cmath>
#include <numbers>

namespace wend {

double elliptic_e(double m) {
    WEND_EXPECT(m >= 0 && m <= 1);
    if (m == 1) {
        return 1;  // the geometric mean with 0 is 0, and the means never meet
    }
    double arithmetic = 1;
    double geometric = std::sqrt(1 - m);
    double rest = 1 - m / 2;
    for (double weight = 1;; weight *= 2) {
        const double difference = (arithmetic - geometric) / 2;
        const double mean = (arithmetic + geometric) / 2;
        rest -= weight * difference * difference;
        if (!(difference >= 1e-6 * mean)) {  // also where m is not a number
            // The next difference is this one's square, and the next mean differs from this one by its half.
            return std::numbers::pi / 2 / (mean - difference * difference / (4 * mean)) * rest;
        }
        geometric = std::sqrt(arithmetic * geometric);
        arithmetic = mean;
    }
}

}  // namespace wend
