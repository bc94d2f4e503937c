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
  // Who started the program in the background may have chosen to ignore Ctrl-C.
  for (const int signal : {SIGINT, SIGTERM})
    if (std::signal(signal, SIG_IGN) != SIG_IGN) std::signal(signal, on_signal);
  // A file that gets larger than the shell's limit is a failed write, not the end of the program.
  std::signal(SIGXFSZ, SIG_IGN);
}

const std::atomic<bool>& interrupt_flag() {
  return interrupted;
}
int interrupt_exit_code() {
  return received == 0 ? 0 : 128 + received;
}

}  // namespace duet
