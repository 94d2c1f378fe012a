#include <wend/sampling/discrete.h>

#include <wend/core/contracts.h>

#include <algorithm>
#include <numeric>

namespace wend {

AliasTable::AliasTable(std::span<const float> weights) : entries_(weights.size()) {
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const std::size_t n = weights.size();
    std::vector<double> scaled(n);
    std::vector<std::size_t> small;
    std::vector<std::size_t> large;
    for (std::size_t i = 0; i < n; ++i) {
        const double p = total > 0 ? weights[i] / total : 1.0 / static_cast<double>(n);
        entries_[i].probability = static_cast<float>(p);
        entries_[i].alias = static_cast<int>(i);
        scaled[i] = p * static_cast<double>(n);
        (scaled[i] < 1 ? small : large).push_back(i);
    }
    while (!small.empty() && !large.empty()) {
        const std::size_t poor = small.back();
        small.pop_back();
        const std::size_t rich = large.back();
        entries_[poor].threshold = static_cast<float>(scaled[poor]);
        entries_[poor].alias = static_cast<int>(rich);
        scaled[rich] -= 1 - scaled[poor];
        if (scaled[rich] < 1) {
            large.pop_back();
            small.push_back(rich);
        }
    }
    for (const auto& rest : {small, large}) {
        for (const std::size_t i : rest) {
            // Rounding leaves cells of one: but never let an impossible index own one.
            entries_[i].threshold = entries_[i].probability > 0 ? 1.0f : 0.0f;
        }
    }
}

int AliasTable::sample(float u) const {
    WEND_EXPECT(!entries_.empty());
    const float scaled = u * static_cast<float>(entries_.size());
    const int i = std::min(static_cast<int>(scaled), size() - 1);
    const Entry& entry = entries_[static_cast<std::size_t>(i)];
    return scaled - static_cast<float>(i) < entry.threshold ? i : entry.alias;
}

namespace {

/// Cumulative distribution of weights into out[0..n], ending at exactly 1; returns the sum of the weights.
double accumulate_cdf(std::span<const float> weights, float* out) {
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const double n = static_cast<double>(weights.size());
    double sum = 0;
    out[0] = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += total > 0 ? weights[i] / total : 1 / n;
        out[i + 1] = static_cast<float>(sum);
    }
    out[weights.size()] = 1;
    return total;
}

/// The cell whose share of the cumulative distribution holds u.
int find_cell(const float* cdf, int n, float u) {
    const int i = static_cast<int>(std::upper_bound(cdf, cdf + n + 1, u) - cdf) - 1;
    return std::clamp(i, 0, n - 1);
}

}  // namespace

PiecewiseConstant2D::PiecewiseConstant2D(std::span<const float> weights, int width, int height)
    : width_(width),
      height_(height),
      rows_(static_cast<std::size_t>(height) + 1),
      columns_(static_cast<std::size_t>(height) * (static_cast<std::size_t>(width) + 1)) {
    WEND_EXPECT(weights.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    std::vector<float> row_sums(static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y) {
        const auto row = weights.subspan(static_cast<std::size_t>(y) * width, static_cast<std::size_t>(width));
        row_sums[static_cast<std::size_t>(y)] =
            static_cast<float>(accumulate_cdf(row, &columns_[static_cast<std::size_t>(y) * (width + 1)]));
    }
    accumulate_cdf(row_sums, rows_.data());
}

PiecewiseConstant2D::Sample PiecewiseConstant2D::sample(const Vec2& u) const {
    const int y = find_cell(rows_.data(), height_, u.y);
    const float* row = &columns_[static_cast<std::size_t>(y) * (width_ + 1)];
    const int x = find_cell(row, width_, u.x);
    const float py = rows_[y + 1] - rows_[y];
    const float px = row[x + 1] - row[x];
    const float fx = px > 0 ? std::min((u.x - row[x]) / px, one_minus_epsilon) : 0.5f;
    const float fy = py > 0 ? std::min((u.y - rows_[y]) / py, one_minus_epsilon) : 0.5f;
    return {{(x + fx) / width_, (y + fy) / height_},
            px * py * static_cast<float>(width_) * static_cast<float>(height_)};
}

float PiecewiseConstant2D::density(const Vec2& point) const {
    const int x = std::clamp(static_cast<int>(point.x * width_), 0, width_ - 1);
    const int y = std::clamp(static_cast<int>(point.y * height_), 0, height_ - 1);
    const float* row = &columns_[static_cast<std::size_t>(y) * (width_ + 1)];
    return (rows_[y + 1] - rows_[y]) * (row[x + 1] - row[x]) * static_cast<float>(width_) * static_cast<float>(height_);
}

}  // namespace wend
