#include "base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <thread>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace duet {

namespace {

/// Denormals cost a hundred cycles each and say nothing; restores the mode when it goes away.
class FlushDenormals {
 public:
#if defined(__SSE2__)
  FlushDenormals() : saved_(_mm_getcsr()) {
    _mm_setcsr(saved_ | 0x8040u);
  }
  ~FlushDenormals() {
    _mm_setcsr(saved_);
  }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
#endif
};

}  // namespace

int hardware_threads() {
  return std::max(1, tbb::this_task_arena::max_concurrency());
}

void parallel_for(size_t count, int threads, const std::function<void(size_t)>& work) {
  if (threads <= 1) {
    const FlushDenormals mode;
    for (size_t i = 0; i < count; ++i) work(i);
    return;
  }
  // Without this TBB starts no more threads than the machine has processors.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, size_t(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<size_t>(0, count, 1),
        [&](const tbb::blocked_range<size_t>& range) {
          const FlushDenormals mode;
          for (size_t i = range.begin(); i != range.end(); ++i) work(i);
        },
        tbb::simple_partitioner());
  });
}

}  // namespace duet
