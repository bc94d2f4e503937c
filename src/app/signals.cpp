#include "app/signals.h"

#include <unistd.h>

#include <csignal>

namespace duet {

namespace {

std::atomic<bool> interrupted{false};
volatile std::sig_atomic_t received = 0;

extern "C" void on_signal(int signal) {
  if (received != 0) _exit(128 + signal);
  received = signal;
  interrupted.store(true);
}

}  // namespace

void install_signal_handlers() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

const std::atomic<bool>& interrupt_flag() {
  return interrupted;
}
int interrupt_exit_code() {
  return received == 0 ? 0 : 128 + received;
}

}  // namespace duet
