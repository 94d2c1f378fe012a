// A comparison to look at.
#pragma once

#include <wend/app/comparison.h>

#include <filesystem>
#include <string>
#include <vector>

namespace wend {

/// The page, pictures included.
std::string comparison_page(const Session& session, const std::vector<ComparisonRow>& rows, const Reference& reference,
                            double seconds, int seeds);

/// Writes pictures, error maps, what walks did (as layers) and index.html into a folder of make_report_folder().
void write_comparison(const std::filesystem::path& folder, const Session& session,
                      const std::vector<ComparisonRow>& rows, const Reference& reference, double seconds, int seeds);

}  // namespace wend
