#pragma once

#include <string>
#include <vector>

namespace wend {

/// A table as text: columns as wide as their widest cell, the first `left_columns` aligned to the left and the others
/// to the right. A row without cells is an empty line.
std::string text_table(const std::vector<std::vector<std::string>>& rows, std::size_t left_columns = 1);

/// The same as CSV (RFC 4180), but for line ends: cells with commas, quotes or line breaks are quoted.
std::string csv_text(const std::vector<std::vector<std::string>>& rows);

}  // namespace wend
