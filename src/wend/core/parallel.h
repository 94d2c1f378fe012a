#pragma once

#include <cstddef>
#include <functional>

namespace wend {

/// Number of hardware threads, at least 1.
int hardware_threads();

/// How many threads of so many the system lets this process have at once, by trying it if they are more than
/// hardware_threads().
int startable_threads(int wanted);

/// Runs `body(i)` for every i in [0, count) on at most `threads` threads (0: all hardware threads). The order and the
/// assignment to threads are unspecified: bodies must not depend on them. An exception thrown by a body is rethrown
/// here.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

}  // namespace wend
