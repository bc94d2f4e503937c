// Loops over independent pieces of work on a given number of threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace duet {

/// How many of `threads` threads, the calling one among them, the system lets this process have: a
/// limit on processes or memory may be in the way. At least 1.
int startable_threads(int threads);

inline constexpr int kMaxThreads = 1024;
/// Environment variable with a number of threads instead of all that the machine runs at once.
inline constexpr const char* kThreadsVariable = "DUET_THREADS";

/// Finds out how many threads the machine runs at once, or kThreadsVariable asks for, and lets this
/// process have, and keeps TBB to so many while it exists: TBB ends the program if it cannot start
/// a thread, which it may try at any time. One for the whole of a program is enough.
class HardwareThreads {
 public:
  /// Throws UsageError if kThreadsVariable is not a number from 1 to kMaxThreads.
  HardwareThreads();
  ~HardwareThreads();
  HardwareThreads(const HardwareThreads&) = delete;
  HardwareThreads& operator=(const HardwareThreads&) = delete;
  /// At least 1.
  int count() const { return count_; }

 private:
  struct Limit;
  int count_;
  std::unique_ptr<Limit> limit_;  ///< null if the machine's processors are the limit
};

/// Calls `work(i)` for every i in [0, count), each once, on up to `threads` threads; returns when
/// all are done. Denormal numbers are flushed to zero in all of them. An exception thrown by `work`
/// is thrown again here.
void parallel_for(size_t count, int threads, const std::function<void(size_t)>& work);

/// What `work(i, values)` appends to `values` for every i in [0, count), in the order of i whatever
/// the number of threads; `block` of them follow each other on one thread.
template <class T, class Work>
std::vector<T> parallel_append(size_t count, size_t block, int threads, const Work& work) {
  std::vector<std::vector<T>> blocks((count + block - 1) / block);
  parallel_for(blocks.size(), threads, [&](size_t b) {
    for (size_t i = b * block; i < std::min((b + 1) * block, count); ++i) work(i, blocks[b]);
  });
  std::vector<T> all;
  for (const std::vector<T>& b : blocks) all.insert(all.end(), b.begin(), b.end());
  return all;
}

}  // namespace duet
