#pragma once

#include <filesystem>

namespace wend {

/// Makes the folder of a report, to ask before long work. Throws InputError where that cannot be, or where index.html
/// cannot be written into it.
void make_report_folder(const std::filesystem::path& folder);

}  // namespace wend
