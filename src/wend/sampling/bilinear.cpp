#include <wend/sampling/bilinear.h>

#include <cmath>

namespace wend {
namespace {

/// Where the integral of the linear function from `begin` to `end` over [0, 1] reaches `target`; within [0, 1].
double invert_linear(double begin, double end, double target) {
    // The stable one of the two forms of the solution, which also takes functions that are even.
    const double root = std::sqrt(std::max(begin * begin + 2 * target * (end - begin), 0.0));
    const double sum = begin + root;
    return sum > 0 ? std::clamp(2 * target / sum, 0.0, 1.0) : 0.0;
}

double integral_of_linear(double begin, double end, double to) {
    return to * (begin + 0.5 * to * (end - begin));
}

/// The last of the cells of `entries` whose integral up to it, which does not decrease, is not above `target`.
template <class Integral>
std::size_t cell_of(std::size_t entries, double target, const Integral& integral) {
    std::size_t low = 0, high = entries - 1;
    while (high - low > 1) {
        const std::size_t middle = low + (high - low) / 2;
        (integral(middle) <= target ? low : high) = middle;
    }
    return low;
}

}  // namespace

BilinearDensity::BilinearDensity(BilinearTable<float> table) : table_(std::move(table)) {
    const std::size_t width = table_.width, height = table_.height, slice_size = width * height;
    columns_.resize(table_.values.size());
    rows_.resize(table_.slices() * height);
    for (std::size_t s = 0; s < table_.slices(); ++s) {
        float* const values = &table_.values[s * slice_size];
        double* const columns = &columns_[s * slice_size];
        double* const rows = &rows_[s * height];
        const auto integrate = [&] {
            for (std::size_t row = 0; row < height; ++row) {
                for (std::size_t column = 1; column < width; ++column) {
                    const float* const v = &values[row * width + column];
                    columns[row * width + column] =
                        columns[row * width + column - 1] + 0.5 * (double{v[-1]} + double{v[0]}) / double(width - 1);
                }
            }
            for (std::size_t row = 1; row < height; ++row) {
                rows[row] = rows[row - 1] +
                            0.5 * (columns[row * width - 1] + columns[(row + 1) * width - 1]) / double(height - 1);
            }
            return rows[height - 1];
        };
        double total = integrate();
        if (!(total > 0)) {
            std::fill_n(values, slice_size, 1.0f);
            total = integrate();
        }
        for (std::size_t i = 0; i < slice_size; ++i) {
            values[i] = static_cast<float>(values[i] / total);
        }
        integrate();
    }
}

double BilinearDensity::to_column(const SliceBlend& blend, std::size_t column, std::size_t row) const {
    return blend.mixed([&](std::size_t s) { return columns_[(s * table_.height + row) * table_.width + column]; });
}

double BilinearDensity::to_row(const SliceBlend& blend, std::size_t row) const {
    return blend.mixed([&](std::size_t s) { return rows_[s * table_.height + row]; });
}

double BilinearDensity::value(const SliceBlend& blend, std::size_t column, std::size_t row) const {
    return blend.mixed([&](std::size_t s) { return double{table_.entry(s, column, row)}; });
}

BilinearDensity::Point BilinearDensity::sample(const SliceBlend& blend, const Vec2& u) const {
    const std::size_t width = table_.width, height = table_.height;
    // Slices have integrals of 1 but for rounding.
    const double row_target = double{u.y} * to_row(blend, height - 1);
    const std::size_t row = cell_of(height, row_target, [&](std::size_t r) { return to_row(blend, r); });
    const double low = to_column(blend, width - 1, row), high = to_column(blend, width - 1, row + 1);
    const double y = invert_linear(low, high, (row_target - to_row(blend, row)) * double(height - 1));
    const auto up_to = [&](std::size_t column) {
        return std::lerp(to_column(blend, column, row), to_column(blend, column, row + 1), y);
    };
    const double column_target = double{u.x} * up_to(width - 1);
    const std::size_t column = cell_of(width, column_target, up_to);
    const double begin = std::lerp(value(blend, column, row), value(blend, column, row + 1), y);
    const double end = std::lerp(value(blend, column + 1, row), value(blend, column + 1, row + 1), y);
    const double x = invert_linear(begin, end, (column_target - up_to(column)) * double(width - 1));
    const Vec2 position(static_cast<float>((double(column) + x) / double(width - 1)),
                        static_cast<float>((double(row) + y) / double(height - 1)));
    return {position, static_cast<float>(std::lerp(begin, end, x))};
}

BilinearDensity::Point BilinearDensity::invert(const SliceBlend& blend, const Vec2& p) const {
    const std::size_t width = table_.width, height = table_.height;
    const BilinearCell c(p, width, height);
    const double x = double{c.x}, y = double{c.y};
    const double begin = std::lerp(value(blend, c.column, c.row), value(blend, c.column, c.row + 1), y);
    const double end = std::lerp(value(blend, c.column + 1, c.row), value(blend, c.column + 1, c.row + 1), y);
    const auto up_to = [&](std::size_t column) {
        return std::lerp(to_column(blend, column, c.row), to_column(blend, column, c.row + 1), y);
    };
    const double all = up_to(width - 1);
    const double along = up_to(c.column) + integral_of_linear(begin, end, x) / double(width - 1);
    const double low = to_column(blend, width - 1, c.row), high = to_column(blend, width - 1, c.row + 1);
    const double upwards = to_row(blend, c.row) + integral_of_linear(low, high, y) / double(height - 1);
    const Vec2 u(all > 0 ? static_cast<float>(along / all) : 0.5f,
                 static_cast<float>(upwards / to_row(blend, height - 1)));
    return {u, static_cast<float>(std::lerp(begin, end, x))};
}

}  // namespace wend
