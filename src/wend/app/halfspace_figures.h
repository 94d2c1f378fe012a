// The pictures of the half-space experiment, each an SVG plot of plain data.
#pragma once

#include <wend/app/halfspace_table.h>
#include <wend/lab/lab.h>

#include <string>
#include <vector>

namespace wend {

struct NamedHistogram {
    std::string name;
    PlanarHistogram histogram;
};

struct NamedWalks {
    std::string name;
    std::vector<PlanarTrace> walks;
};

/// Depth of the first collision, and direction after it, of some samplers over the exact density.
std::string depth_svg(const std::vector<NamedHistogram>& samplers);
std::string direction_svg(const std::vector<NamedHistogram>& samplers);

/// Walks below the surface, a panel for each sampler, all to one scale.
std::string walks_svg(const std::vector<NamedWalks>& samplers);

/// Variance of `modes` over the number of modes, a line for each albedo, beside that of the samplers with less to go
/// by.
std::string variance_svg(const std::vector<HalfspaceRow>& rows);

}  // namespace wend
