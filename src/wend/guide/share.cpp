#include <wend/guide/share.h>

#include <algorithm>

namespace wend::guide {
namespace {

/// As effective records, what they assume unseen: of ways that only classical sampling finds, and that only the guide
/// does. For these parts the parabola below is least at ShareSums::unproven.
constexpr double prior_records = 32, found_by_classical = 1.0 / 16, found_by_guide = 9.0 / 16;

/// Where the parabola through three points at x - h, x and x + h, the middle one the lowest, is least.
double lowest(double x, double h, double left, double middle, double right) {
    const double bend = left - 2 * middle + right;
    return bend > 0 ? x + 0.5 * h * (left - right) / bend : x;
}

}  // namespace

void ShareSums::add(const Record& record) {
    const double c = record.classical_density, g = record.guided_density;
    if (!(c > 0 || g > 0)) {
        return;
    }
    const double value = static_cast<double>(record.scattered) / record.density;
    const double numerator = value * value * static_cast<double>(record.density);
    for (std::size_t k = 0; k < shares.size(); ++k) {
        moment[k] += numerator / (shares[k] * c + (1 - shares[k]) * g);
    }
    const double equal = numerator / (shares[half] * (c + g));
    square += equal * equal;
}

float ShareSums::best() const {
    if (!(moment[half] > 0)) {
        return static_cast<float>(unproven);
    }
    // What one record says, where they differ: the sum over their effective number.
    const double doubt = prior_records * square / moment[half];
    std::array<double, shares.size()> total = moment;
    for (std::size_t k = 0; k < shares.size(); ++k) {
        total[k] += doubt * (found_by_classical / shares[k] + found_by_guide / (1 - shares[k]));
    }
    const auto k = static_cast<std::size_t>(std::min_element(total.begin(), total.end()) - total.begin());
    if (k == 0 || k + 1 == shares.size()) {
        return static_cast<float>(shares[k]);
    }
    return static_cast<float>(lowest(shares[k], shares[k + 1] - shares[k], total[k - 1], total[k], total[k + 1]));
}

ShareSums ShareSums::scaled(double linear, double quadratic) const {
    ShareSums s = *this;
    for (double& m : s.moment) {
        m *= linear;
    }
    s.square *= quadratic;
    return s;
}

}  // namespace wend::guide
