// Signals: the first that asks to stop gets the image as it is, the second ends the program at
// once; SIGUSR1 gets the image as it is and goes on.
//
// A handler gets nothing but the number of its signal, so what it sets is global: the only state of
// the program that is.
#pragma once

#include <atomic>

namespace duet {

/// Takes over SIGINT, SIGTERM and SIGHUP unless they are ignored (as nohup does it), and SIGUSR1.
/// Writes to a terminal or pipe that has gone fail rather than kill.
void install_signal_handlers();
/// The same of writes beyond the largest size that a file may have (`ulimit -f`).
void let_large_files_fail();
/// Becomes true at the first signal to stop.
const std::atomic<bool>& interrupt_flag();
/// 0, or the exit code for the signal that arrived (129, 130 or 143).
int interrupt_exit_code();
/// Whether SIGUSR1 has arrived since the last call.
bool take_snapshot_request();

/// Whether a signal asks a program to stop: SIGINT, SIGTERM or SIGHUP.
bool is_stop_signal(int signal);
/// Whether it is the one that ends a program without asking, as the kernel does when memory is out.
bool is_kill_signal(int signal);

}  // namespace duet
