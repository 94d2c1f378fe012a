#include <wend/core/parallel.h>

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace wend {
namespace {

TEST(ParallelFor, VisitsEachIndexOnce) {
    for (const int threads : {0, 1, 2, 7}) {
        std::vector<std::atomic<int>> visits(10007);
        parallel_for(visits.size(), threads, [&](std::size_t i) { ++visits[i]; });
        for (const auto& n : visits) {
            ASSERT_EQ(n, 1) << threads << " threads";
        }
    }
}

TEST(ParallelFor, NothingToDoIsFine) {
    parallel_for(0, 2, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, RunsAtMostTheGivenThreads) {
    constexpr int limit = 2;
    std::atomic<int> running = 0, most = 0;
    parallel_for(200, limit, [&](std::size_t) {
        const int now = ++running;
        int seen = most;
        while (now > seen && !most.compare_exchange_weak(seen, now)) {
        }
        std::this_thread::yield();
        --running;
    });
    EXPECT_GE(most, 1);
    EXPECT_LE(most, limit);
}

TEST(ParallelFor, RethrowsWhatABodyThrows) {
    for (const int threads : {1, 2}) {
        EXPECT_THROW(parallel_for(100, threads,
                                  [](std::size_t i) {
                                      if (i == 57) {
                                          throw std::runtime_error("57");
                                      }
                                  }),
                     std::runtime_error);
    }
}

TEST(HardwareThreads, ThereIsOne) {
    EXPECT_GE(hardware_threads(), 1);
}

}  // namespace
}  // namespace wend
