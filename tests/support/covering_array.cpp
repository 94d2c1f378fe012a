#include <tests/support/covering_array.h>
#include <wend/core/random.h>

#include <set>
#include <utility>

namespace wend::test {
namespace {

using Row = std::vector<int>;
using Level = std::pair<std::size_t, int>;  // factor and level
using Pairs = std::set<std::pair<Level, Level>>;

Pairs pairs_in(const Row& row) {
    Pairs pairs;
    for (std::size_t i = 0; i < row.size(); ++i) {
        for (std::size_t k = i + 1; k < row.size(); ++k) {
            pairs.insert({{i, row[i]}, {k, row[k]}});
        }
    }
    return pairs;
}

Pairs all_pairs(const std::vector<int>& levels) {
    Pairs pairs;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        for (std::size_t k = i + 1; k < levels.size(); ++k) {
            for (int a = 0; a < levels[i]; ++a) {
                for (int b = 0; b < levels[k]; ++b) {
                    pairs.insert({{i, a}, {k, b}});
                }
            }
        }
    }
    return pairs;
}

}  // namespace

std::vector<std::vector<int>> covering_array(const std::vector<int>& levels) {
    Pcg32 random(1);
    std::vector<Row> rows;
    for (Pairs missing = all_pairs(levels); !missing.empty();) {
        // Of some rows that have the first pair that is missing, the one that has most of the others.
        constexpr int candidates = 100;
        Row best;
        std::size_t most = 0;
        for (int i = 0; i < candidates; ++i) {
            Row row;
            for (const int count : levels) {
                row.push_back(static_cast<int>(random.uniform() * static_cast<float>(count)));
            }
            for (const Level& level : {missing.begin()->first, missing.begin()->second}) {
                row[level.first] = level.second;
            }
            std::size_t found = 0;
            for (const auto& pair : pairs_in(row)) {
                found += missing.count(pair);
            }
            if (found > most) {
                most = found;
                best = row;
            }
        }
        for (const auto& pair : pairs_in(best)) {
            missing.erase(pair);
        }
        rows.push_back(best);
    }
    return rows;
}

}  // namespace wend::test
