// The files that a comparison leaves.
#pragma once

#include <wend/app/comparison.h>

#include <filesystem>
#include <span>

namespace wend {

/// Writes into a folder of make_report_folder(): index.html, the tables of write_tables(), and of each way of sampling
/// its picture (WAY.exr, with what walks did as layers, and WAY.png) and its errors: WAY-error.png in false colours,
/// and WAY-error.exr with the numbers.
void write_comparison(const std::filesystem::path& folder, const Comparison& comparison);

/// The numbers of comparisons: rows.csv, runs.csv, curves.csv.
void write_tables(const std::filesystem::path& folder, std::span<const Comparison> comparisons);

/// The errors of a row pixel by pixel, as means over its runs. The colours are squared errors, (I − a)(I − b), in which
/// the noise of two halves cancels, so that single values may be negative. Layers: `relative_squared`, whose mean is
/// the mean relMSE of the runs; `relative`, whose mean is their MAPE; `bias`, the mean of I − R.
Picture error_picture(const ComparisonRow& row);

}  // namespace wend
