// Processes that render one picture together, on one machine or many.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace wend {

/// What one of them needs to know of the others. Each has the whole film and all that is learned; each walks a share of
/// the tiles. All calls are made by all ranks, in the same order.
class Ranks {
public:
    virtual ~Ranks() = default;

    virtual int rank() const = 0;
    virtual int size() const = 0;
    /// What each rank says, in their order. Throws std::runtime_error where a rank is lost.
    virtual std::vector<std::string> gather(const std::string& mine) = 0;
};

/// Which rank walks each tile, given the work that each has been so far: the largest go first, each to the rank that
/// has least. All ranks come to the same answer.
std::vector<int> shares_of_ranks(const std::vector<std::uint64_t>& work, int ranks);

}  // namespace wend
