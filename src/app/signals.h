// Ctrl-C and SIGTERM: the first asks for the image as it is, the second ends the program.
#pragma once

#include <atomic>

namespace duet {

/// Takes over SIGINT and SIGTERM, and makes writes beyond a size limit fail rather than kill.
void install_signal_handlers();
/// Becomes true at the first signal.
const std::atomic<bool>& interrupt_flag();
/// 0, or the exit code for the signal that arrived (130 or 143).
int interrupt_exit_code();

}  // namespace duet
