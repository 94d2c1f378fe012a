// The processes that do one thing together, as one of them talks to the others.
#pragma once

#include <wend/core/archive.h>
#include <wend/core/ranks.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace wend {

/// All ranks make the same calls in the same order. Without ranks a process is alone and agrees with itself.
class Team {
    // Before its uses, which ask what it returns.
    template <class Talk>
    auto waiting(const Talk& talk) {
        using Clock = std::chrono::steady_clock;
        const Clock::time_point start = Clock::now();
        auto said = talk();
        waiting_seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
        return said;
    }

public:
    /// `ranks` may be null, and must outlive this.
    explicit Team(Ranks* ranks) : ranks_(ranks) {}

    bool is_alone() const { return !ranks_; }
    int rank() const { return ranks_ ? ranks_->rank() : 0; }
    int size() const { return ranks_ ? ranks_->size() : 1; }

    /// What each says, in the order of the ranks.
    std::vector<std::string> gather(std::string mine) {
        if (is_alone()) {
            return {std::move(mine)};
        }
        bytes_sent_ += mine.size();
        return waiting([&] { return ranks_->gather(std::move(mine)); });
    }
    /// What each says to this rank, where this one says `mine[i]` to the i-th.
    std::vector<std::string> exchange(std::vector<std::string> mine) {
        if (is_alone()) {
            return mine;
        }
        for (std::size_t other = 0; other < mine.size(); ++other) {
            bytes_sent_ += static_cast<int>(other) == rank() ? 0 : mine[other].size();
        }
        return waiting([&] { return ranks_->exchange(std::move(mine)); });
    }
    /// Over all ranks, number by number.
    std::vector<std::uint64_t> sum(std::vector<std::uint64_t> mine) {
        if (is_alone()) {
            return mine;
        }
        bytes_sent_ += mine.size() * sizeof mine[0];
        return waiting([&] { return ranks_->sum(std::move(mine)); });
    }
    /// gather() for values that archives take.
    template <class T>
    std::vector<T> all(const T& mine) {
        if (is_alone()) {
            return {mine};
        }
        ArchiveWriter bytes;
        bytes(mine);
        const std::vector<std::string> said = gather(bytes.take());
        std::vector<T> values(said.size());
        for (std::size_t rank = 0; rank < said.size(); ++rank) {
            ArchiveReader reader(said[rank]);
            reader(values[rank]);
        }
        return values;
    }
    /// What the first rank says.
    template <class T>
    T agreed(T mine) {
        if (!is_alone()) {
            ArchiveWriter bytes;
            bytes(mine);
            const std::string said = gather(bytes.take()).front();
            ArchiveReader reader(said);
            reader(mine);
        }
        return mine;
    }

    /// By this rank, so far.
    std::uint64_t bytes_sent() const { return bytes_sent_; }
    /// For all to have spoken, so far.
    double waiting_seconds() const { return waiting_seconds_; }

private:
    Ranks* ranks_;
    std::uint64_t bytes_sent_ = 0;
    double waiting_seconds_ = 0;
};

}  // namespace wend
