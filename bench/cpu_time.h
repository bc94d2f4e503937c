// Processor time, for the benchmarks.
#pragma once

#include <ctime>

namespace duet {

/// What a clock of the processor shows, in seconds: CLOCK_PROCESS_CPUTIME_ID that of all threads of
/// the program, CLOCK_THREAD_CPUTIME_ID that of the caller.
inline double cpu_seconds(clockid_t clock = CLOCK_PROCESS_CPUTIME_ID) {
  timespec t;
  clock_gettime(clock, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

}  // namespace duet
