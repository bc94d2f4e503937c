#include "python/calls.h"

#include <chrono>
#include <optional>
#include <thread>

namespace duet::python {

namespace {

struct Calls {
  int process = 0;
  int under_way = 0;
  std::optional<std::thread::id> ended_by;
};

Calls& calls() {
  static Calls all;
  return all;
}

/// The thread of a call never lets go of what it refers to, if the interpreter ends before it or if
/// it is not there. nanobind would warn of that.
void expect_leaks() {
  if (calls().under_way > 0) nanobind::set_leak_warnings(false);
}

}  // namespace

Call::Call() : process_(calls().process) {
  ++calls().under_way;
}

Call::~Call() {
  if (process_ == calls().process) --calls().under_way;
}

bool is_ending() {
  const auto& ended_by = calls().ended_by;
  return ended_by && *ended_by != std::this_thread::get_id();
}

OthersMayRun::OthersMayRun() {
  if (!is_ending()) released_ = PyEval_SaveThread();
}

OthersMayRun::~OthersMayRun() {
  if (released_) PyEval_RestoreThread(released_);
}

void end_calls() {
  calls().ended_by = std::this_thread::get_id();
  expect_leaks();
  while (calls().under_way > 0) {
    PyThreadState* const own = PyEval_SaveThread();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    PyEval_RestoreThread(own);
  }
}

void forget_calls() {
  expect_leaks();
  calls() = {calls().process + 1, 0, std::nullopt};
}

}  // namespace duet::python
