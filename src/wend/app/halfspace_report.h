// `wend halfspace --table`: the table, plots and a page that shows them.
#pragma once

#include <wend/app/options.h>
#include <wend/lab/lab.h>

#include <filesystem>

namespace wend {

/// Runs all samplers at the albedos of the table, with all else as in `base`. The table goes to standard output or
/// JSON; depth.svg, direction.svg, walks.svg, variance.svg and index.html into the folder.
void report_halfspace_table(const PlanarExperiment& base, const PlanarRun& run, const std::filesystem::path& folder,
                            const CommonOptions& common, const Streams& streams);

}  // namespace wend
