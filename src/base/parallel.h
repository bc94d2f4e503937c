// Loops over independent pieces of work on a given number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace duet {

/// How many of `threads` threads, the calling one among them, the system lets this process have: a
/// limit on processes or memory may be in the way. At least 1.
int startable_threads(int threads);

/// Number of threads the machine runs at once and lets this process have, at least 1.
int hardware_threads();

/// Calls `work(i)` for every i in [0, count), each once, on up to `threads` threads; returns when
/// all are done. Denormal numbers are flushed to zero in all of them. An exception thrown by `work`
/// is thrown again here.
void parallel_for(size_t count, int threads, const std::function<void(size_t)>& work);

}  // namespace duet
