#include "base/parallel.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "base/failures.h"
#include "base/thread_sanitizer.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace duet {

namespace {

constexpr auto kParallelism = tbb::global_control::max_allowed_parallelism;

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

/// The arena in which this thread's loops on so many threads run. All are kept, since loops may be
/// within others: to end one is to wait for its threads to leave it, which takes longer than a
/// small loop where other processes are at work, too.
tbb::task_arena& arena_of(int threads) {
  thread_local std::map<int, tbb::task_arena> arenas;
  return arenas.try_emplace(threads, threads).first->second;
}

/// See kThreadSanitizer.
[[maybe_unused]] void run_on_own_threads(size_t count, int threads,
                                         const std::function<void(size_t)>& work) {
  std::atomic<size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto take = [&] {
    const FlushDenormals mode;
    try {
      for (size_t i = next++; i < count; i = next++) work(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> others;
  while (int(others.size()) + 1 < threads) others.emplace_back(take);
  take();
  for (std::thread& t : others) t.join();
  if (failure) std::rethrow_exception(failure);
}

std::optional<int> wanted_threads() {
  const char* const text = std::getenv(kThreadsVariable);
  if (!text || *text == '\0') return std::nullopt;
  const std::string_view digits(text);
  int threads = 0;
  const auto [end, error] = std::from_chars(digits.begin(), digits.end(), threads);
  if (error != std::errc() || end != digits.end() || threads < 1 || threads > kMaxThreads)
    throw UsageError(fmt::format("{}: \"{}\" is not a whole number from 1 to {}", kThreadsVariable,
                                 text, kMaxThreads));
  return threads;
}

}  // namespace

int startable_threads(int threads) {
  std::mutex mutex;
  std::condition_variable released;
  bool enough = false;
  std::vector<std::thread> started;
  try {
    while (int(started.size()) + 1 < threads)
      started.emplace_back([&] {
        std::unique_lock lock(mutex);
        released.wait(lock, [&] { return enough; });
      });
  } catch (const std::system_error&) {
    // The limit is reached: what was started counts.
  }
  {
    const std::lock_guard lock(mutex);
    enough = true;
  }
  released.notify_all();
  for (std::thread& t : started) t.join();
  return int(started.size()) + 1;
}

struct HardwareThreads::Limit {
  explicit Limit(int threads) : control(kParallelism, size_t(threads)) {}
  tbb::global_control control;
};

HardwareThreads::HardwareThreads() {
  const int processors = std::max(1, tbb::this_task_arena::max_concurrency());
  count_ = startable_threads(wanted_threads().value_or(processors));
  // Such a limit holds when another one, such as Embree's, goes away.
  if (count_ < processors) limit_ = std::make_unique<Limit>(count_);
}
HardwareThreads::~HardwareThreads() = default;

void parallel_for(size_t count, int threads, const std::function<void(size_t)>& work) {
  const auto one_by_one = [&] {
    const FlushDenormals mode;
    for (size_t i = 0; i < count; ++i) work(i);
  };
  if (threads <= 1 || count <= 1) return one_by_one();
  if constexpr (kThreadSanitizer) return run_on_own_threads(count, threads, work);
  // Without this TBB starts no more threads than the machine has processors. The least of all such
  // limits holds, and Embree has one, too: to ask for more would make TBB print a warning. Limits
  // wake TBB's threads, which takes longer than a small loop.
  std::optional<tbb::global_control> limit;
  if (size_t(threads) > tbb::global_control::active_value(kParallelism))
    limit.emplace(kParallelism, size_t(threads));
  const int allowed =
      int(std::min(size_t(threads), tbb::global_control::active_value(kParallelism)));
  if (allowed <= 1) return one_by_one();
  arena_of(allowed).execute([&] {
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
