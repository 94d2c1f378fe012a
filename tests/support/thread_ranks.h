// Ranks that are threads of one process.
#pragma once

#include <wend/core/ranks.h>

#include <barrier>
#include <cstddef>
#include <cstdint>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

namespace wend::test {

class ThreadRanks : public Ranks {
public:
    /// What all of them see.
    struct Table {
        explicit Table(int size)
            : said(static_cast<std::size_t>(size)), sent(said.size()), numbers(said.size()), barrier(size) {}
        std::vector<std::string> said;
        std::vector<std::vector<std::string>> sent;
        std::vector<std::vector<std::uint64_t>> numbers;
        std::barrier<> barrier;
    };

    ThreadRanks(Table& table, int rank) : table_(table), rank_(rank) {}

    int rank() const override { return rank_; }
    int size() const override { return static_cast<int>(table_.said.size()); }
    std::vector<std::string> gather(std::string mine) override {
        return after_all([&] { own(table_.said) = std::move(mine); }, [&] { return table_.said; });
    }
    std::vector<std::string> exchange(std::vector<std::string> mine) override {
        return after_all([&] { own(table_.sent) = std::move(mine); },
                         [&] {
                             std::vector<std::string> all;
                             for (const std::vector<std::string>& sent : table_.sent) {
                                 all.push_back(sent[static_cast<std::size_t>(rank_)]);
                             }
                             return all;
                         });
    }
    std::vector<std::uint64_t> sum(std::vector<std::uint64_t> mine) override {
        return after_all([&] { own(table_.numbers) = mine; },
                         [&] {
                             std::vector<std::uint64_t> sums(mine.size(), 0);
                             for (const std::vector<std::uint64_t>& numbers : table_.numbers) {
                                 for (std::size_t i = 0; i < sums.size(); ++i) {
                                     sums[i] += numbers[i];
                                 }
                             }
                             return sums;
                         });
    }

private:
    template <class T>
    T& own(std::vector<T>& all) const {
        return all[static_cast<std::size_t>(rank_)];
    }
    template <class Say, class Hear>
    std::invoke_result_t<Hear> after_all(const Say& say, const Hear& hear) {
        say();
        table_.barrier.arrive_and_wait();
        auto heard = hear();
        table_.barrier.arrive_and_wait();
        return heard;
    }

    Table& table_;
    int rank_;
};

/// `work(ranks)` by each of so many ranks; none may throw.
template <class Work>
void by_thread_ranks(int count, const Work& work) {
    ThreadRanks::Table table(count);
    std::vector<std::thread> threads;
    for (int rank = 0; rank < count; ++rank) {
        threads.emplace_back([&, rank] {
            ThreadRanks ranks(table, rank);
            work(ranks);
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
}

}  // namespace wend::test
