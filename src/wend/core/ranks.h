// Processes that do one thing together, on one machine or many.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace wend {

/// What one of them needs to know of the others. All calls are made by all ranks, in the same order. Each throws
/// std::runtime_error where a rank is lost.
class Ranks {
public:
    virtual ~Ranks() = default;

    virtual int rank() const = 0;
    virtual int size() const = 0;
    /// What each rank says, in their order.
    virtual std::vector<std::string> gather(std::string mine) = 0;
    /// What each rank says to this one, in their order, where this one says `mine[i]` to the i-th.
    virtual std::vector<std::string> exchange(std::vector<std::string> mine) = 0;
    /// Over all ranks, number by number; all give as many.
    virtual std::vector<std::uint64_t> sum(std::vector<std::uint64_t> mine) = 0;
};

/// Which rank does each of several pieces, given how much work each is: the largest go first, each to the rank that has
/// least. All ranks come to the same answer.
std::vector<int> shares_of_ranks(const std::vector<std::uint64_t>& work, int ranks);

}  // namespace wend
