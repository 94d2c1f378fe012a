#include <wend/core/parallel.h>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <latch>
#include <system_error>
#include <thread>
#include <vector>

namespace wend {

int hardware_threads() {
    return std::max(1, tbb::info::default_concurrency());
}

int startable_threads(int wanted) {
    if (wanted <= hardware_threads()) {
        return wanted;
    }
    std::latch all_tried(1);
    std::vector<std::thread> threads;
    try {
        for (int i = 0; i < wanted; ++i) {
            threads.emplace_back([&all_tried] { all_tried.wait(); });
        }
    } catch (const std::system_error&) {
        // No more of them: what there are is the answer.
    }
    all_tried.count_down();
    for (std::thread& thread : threads) {
        thread.join();
    }
    return static_cast<int>(threads.size());
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
    // Of many more there is not even room to note them.
    constexpr int most_threads = 4096;
    const int concurrency = threads > 0 ? std::min(threads, most_threads) : hardware_threads();
    if (concurrency == 1) {
        for (std::size_t i = 0; i < count; ++i) {
            body(i);
        }
        return;
    }
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(concurrency));
    tbb::task_arena arena(concurrency);
    arena.execute([&] {
        tbb::parallel_for(
            std::size_t{0}, count, [&](std::size_t i) { body(i); }, tbb::simple_partitioner());
    });
}

}  // namespace wend
