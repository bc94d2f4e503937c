#include "base/parallel.h"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <vector>

using namespace duet;

TEST_CASE("every piece of work is done once, whatever number of threads is asked for") {
  for (const int threads : {-1, 0, 1, 2, 64, 1000}) {
    CAPTURE(threads);
    std::vector<std::atomic<int>> done(1000);
    parallel_for(done.size(), threads, [&](size_t i) { ++done[i]; });
    for (const std::atomic<int>& n : done) CHECK(n == 1);
  }
}

TEST_CASE("threads that cannot be started are not counted") {
  CHECK(startable_threads(1) == 1);
  CHECK(startable_threads(5) == 5);
  CHECK(startable_threads(0) == 1);
  const pid_t child = fork();
  if (child == 0) {
    // The limit does not hold for root.
    constexpr uid_t kNobody = 65534;
    if (geteuid() == 0 && setuid(kNobody) != 0) _exit(100);
    const rlimit limit{1, 1};
    setrlimit(RLIMIT_NPROC, &limit);
    _exit(startable_threads(5));
  }
  int status = 0;
  waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 1);
}
