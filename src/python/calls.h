// Calls of which other Python threads need not wait for the end, but the interpreter does.
//
// A thread that asks for the GIL of an interpreter that is being finalized is ended by it, or
// hangs, wherever it is: within C++ that aborts the process. What happens here is called with the
// GIL held, which guards it.
#pragma once

#include <nanobind/nanobind.h>

namespace duet::python {

/// A call under way: end_calls() waits until it is gone.
class Call {
 public:
  Call();
  ~Call();
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

 private:
  const int process_;  ///< in which it began, counted by forks
};

/// Lets go of the GIL while it exists; but not once the interpreter ends, since it could not be had
/// back.
class OthersMayRun {
 public:
  OthersMayRun();
  ~OthersMayRun();
  OthersMayRun(const OthersMayRun&) = delete;
  OthersMayRun& operator=(const OthersMayRun&) = delete;

 private:
  const Call call_;
  PyThreadState* released_ = nullptr;
};

/// Whether the interpreter is about to end, for all threads but the one that ends it.
bool is_ending();

/// To be called when the interpreter is about to end: waits for all calls of other threads.
void end_calls();

/// To be called in a process that was forked: the threads of the calls are not there.
void forget_calls();

}  // namespace duet::python
