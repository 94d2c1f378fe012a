#include <wend/core/ranks.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

namespace wend {

std::vector<int> shares_of_ranks(const std::vector<std::uint64_t>& work, int ranks) {
    std::vector<std::size_t> order(work.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return work[a] > work[b]; });
    using Load = std::pair<std::uint64_t, int>;
    std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
    for (int rank = 0; rank < ranks; ++rank) {
        loads.emplace(0, rank);
    }
    std::vector<int> shares(work.size());
    for (const std::size_t piece : order) {
        auto [load, rank] = loads.top();
        loads.pop();
        shares[piece] = rank;
        // A piece costs something even where it was nothing so far.
        loads.emplace(load + work[piece] + 1, rank);
    }
    return shares;
}

}  // namespace wend
