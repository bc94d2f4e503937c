// Loops over independent pieces of work on a given number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace duet {

/// Number of threads the machine runs at once, at least 1.
int hardware_threads();

/// Calls `work(i)` for every i in [0, count), each once, on up to `threads` threads; returns when
/// all are done. Denormal numbers are flushed to zero in all of them. An exception thrown by `work`
/// is thrown again here.
void parallel_for(size_t count, int threads, const std::function<void(size_t)>& work);

}  // namespace duet
