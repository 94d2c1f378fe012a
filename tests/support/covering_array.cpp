#include <tests/support/covering_array.h>
#include <wend/core/random.h>

#include <algorithm>
#include <array>
#include <map>

namespace wend::test {
namespace {

using Row = std::vector<int>;

/// The pairs of levels of two factors that have not met yet.
class MissingPairs {
public:
    explicit MissingPairs(const std::vector<int>& levels) {
        for (std::size_t factor = 0; factor < levels.size(); ++factor) {
            first_.push_back(factors_.size());
            factors_.insert(factors_.end(), static_cast<std::size_t>(levels[factor]), factor);
        }
        missing_.resize(factors_.size() * factors_.size());
        for (std::size_t a = 0; a < factors_.size(); ++a) {
            for (std::size_t b = a; b < factors_.size(); ++b) {
                missing_[a * factors_.size() + b] = factors_[a] != factors_[b];
            }
        }
    }

    bool empty() {
        next_ = static_cast<std::size_t>(
            std::find(missing_.begin() + static_cast<std::ptrdiff_t>(next_), missing_.end(), true) - missing_.begin());
        return next_ == missing_.size();
    }
    /// Gives a row the levels of the first pair that is missing. There must be one.
    void put_first(Row& row) const {
        for (const std::size_t level : {next_ / factors_.size(), next_ % factors_.size()}) {
            row[factors_[level]] = static_cast<int>(level - first_[factors_[level]]);
        }
    }
    std::size_t count_in(const Row& row) const {
        std::size_t count = 0;
        for_each_pair(row, [&](std::size_t pair) { count += missing_[pair]; });
        return count;
    }
    void remove(const Row& row) {
        for_each_pair(row, [&](std::size_t pair) { missing_[pair] = false; });
    }

private:
    template <class Visit>
    void for_each_pair(const Row& row, const Visit& visit) const {
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::size_t a = first_[i] + static_cast<std::size_t>(row[i]);
            for (std::size_t k = i + 1; k < row.size(); ++k) {
                visit(a * factors_.size() + first_[k] + static_cast<std::size_t>(row[k]));
            }
        }
    }

    std::vector<std::size_t> first_, factors_;  ///< the first level of each factor; of each level its factor
    std::vector<char> missing_;                 ///< by the first level and the second
    std::size_t next_ = 0;
};

/// Factor and level of each of two.
std::vector<std::array<int, 4>> pairs_of(const Row& row) {
    std::vector<std::array<int, 4>> pairs;
    for (std::size_t i = 0; i < row.size(); ++i) {
        for (std::size_t k = i + 1; k < row.size(); ++k) {
            pairs.push_back({static_cast<int>(i), row[i], static_cast<int>(k), row[k]});
        }
    }
    return pairs;
}

}  // namespace

std::vector<std::vector<int>> covering_array(const std::vector<int>& levels) {
    Pcg32 random(1);
    std::vector<Row> rows;
    for (MissingPairs missing(levels); !missing.empty();) {
        // Of some rows that have the first pair that is missing, the one that has most of the others.
        constexpr int candidates = 100;
        Row best;
        std::size_t most = 0;
        for (int i = 0; i < candidates; ++i) {
            Row row;
            for (const int count : levels) {
                row.push_back(static_cast<int>(random.uniform() * static_cast<float>(count)));
            }
            missing.put_first(row);
            const std::size_t found = missing.count_in(row);
            if (found > most) {
                most = found;
                best = row;
            }
        }
        missing.remove(best);
        rows.push_back(best);
    }
    return rows;
}

std::vector<bool> needed_rows(const std::vector<std::vector<int>>& rows) {
    std::map<std::array<int, 4>, int> counts;
    const auto all_in_others = [&](const Row& row) {
        return std::ranges::all_of(pairs_of(row), [&](const auto& pair) { return counts.at(pair) > 1; });
    };
    for (const Row& row : rows) {
        for (const auto& pair : pairs_of(row)) {
            ++counts[pair];
        }
    }
    std::vector<bool> needed(rows.size(), true);
    for (std::size_t i = rows.size(); i-- > 0;) {
        if (all_in_others(rows[i])) {
            needed[i] = false;
            for (const auto& pair : pairs_of(rows[i])) {
                --counts[pair];
            }
        }
    }
    return needed;
}

}  // namespace wend::test
