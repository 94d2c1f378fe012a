#include <wend/stats/moments.h>

#include <cmath>

namespace wend {

void Moments::add(double value) {
    ++count_;
    const double delta = value - mean_;
    mean_ += delta / static_cast<double>(count_);
    squared_deviations_ += delta * (value - mean_);
}

void Moments::merge(const Moments& other) {
    if (other.count_ == 0) {
        return;
    }
    const auto ours = static_cast<double>(count_);
    const auto theirs = static_cast<double>(other.count_);
    const double delta = other.mean_ - mean_;
    count_ += other.count_;
    mean_ += delta * theirs / (ours + theirs);
    squared_deviations_ += other.squared_deviations_ + delta * delta * ours * theirs / (ours + theirs);
}

double Moments::variance() const {
    return count_ < 2 ? 0.0 : squared_deviations_ / static_cast<double>(count_ - 1);
}

double Moments::standard_error() const {
    return count_ < 2 ? 0.0 : std::sqrt(variance() / static_cast<double>(count_));
}

double Moments::relative_error() const {
    const double error = standard_error();
    return error == 0 ? 0.0 : error / std::abs(mean_);
}

}  // namespace wend
