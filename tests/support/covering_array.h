// Few combinations of many factors.
#pragma once

#include <cstddef>
#include <vector>

namespace wend::test {

/// Rows of levels, one for each factor, in which each pair of levels of any two factors meets at least once: most
/// faults need no more than two conditions to show (kuhn2004). `levels`: how many each factor has. The same rows every
/// time.
std::vector<std::vector<int>> covering_array(const std::vector<int>& levels);

/// Which of the rows are needed for each pair that meets in any of them, one flag a row: from the last one on, those
/// are left out of which others have all pairs.
std::vector<bool> needed_rows(const std::vector<std::vector<int>>& rows);

}  // namespace wend::test
