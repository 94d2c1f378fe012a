// The processes that render a picture together, as one of them talks to the others.
#pragma once

#include <wend/core/archive.h>
#include <wend/render/ranks.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace wend {

/// All ranks make the same calls in the same order. Without ranks a process is alone and agrees with itself.
class Team {
public:
    /// `ranks` may be null, and must outlive this.
    explicit Team(Ranks* ranks) : ranks_(ranks) {}

    bool is_alone() const { return !ranks_; }
    int rank() const { return ranks_ ? ranks_->rank() : 0; }
    int size() const { return ranks_ ? ranks_->size() : 1; }

    /// What each says, in the order of the ranks.
    std::vector<std::string> gather(const std::string& mine) {
        if (is_alone()) {
            return {mine};
        }
        using Clock = std::chrono::steady_clock;
        const Clock::time_point start = Clock::now();
        std::vector<std::string> all = ranks_->gather(mine);
        bytes_sent_ += mine.size();
        waiting_seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
        return all;
    }
    /// The same for values that archives take.
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
