#include "base/system/signals.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

namespace duet {

namespace {

// Handlers may use nothing but atomics without locks and async-signal-safe functions.
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);
std::atomic<bool> interrupted{false}, snapshot_wanted{false};
std::atomic<int> received{0};

extern "C" void on_stop(int signal) {
  if (received.exchange(signal) != 0) _exit(128 + signal);
  interrupted.store(true);
  constexpr std::string_view text = "duet: stopping; a second signal ends the program at once\n";
  // Where nobody reads there is nothing to do about it.
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

extern "C" void on_snapshot(int) {
  snapshot_wanted.store(true);
}

void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

}  // namespace

void install_signal_handlers() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    // Who started the program may have chosen to ignore it: a shell in the background, nohup.
    struct sigaction now {};
    if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler != SIG_IGN) handle(signal, on_stop);
  }
  handle(SIGUSR1, on_snapshot);
  handle(SIGPIPE, SIG_IGN);
}

void let_large_files_fail() {
  handle(SIGXFSZ, SIG_IGN);
}

const std::atomic<bool>& interrupt_flag() {
  return interrupted;
}
int interrupt_exit_code() {
  const int signal = received.load();
  return signal == 0 ? 0 : 128 + signal;
}
bool take_snapshot_request() {
  return snapshot_wanted.exchange(false);
}

bool is_stop_signal(int signal) {
  return signal == SIGHUP || signal == SIGINT || signal == SIGTERM;
}
bool is_kill_signal(int signal) {
  return signal == SIGKILL;
}

}  // namespace duet
