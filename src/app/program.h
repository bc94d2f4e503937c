// What the commands of the program share: made by main, and passed to whatever needs it.
#pragma once

#include <optional>
#include <string>

#include "base/log.h"
#include "base/parallel.h"

namespace duet {

struct Program {
  Log log;
  std::string command_line;  ///< as it was typed, for the header of images
  int exit_code = 0;         ///< of the command that was run

  /// All threads that the process may have.
  int threads() {
    if (!threads_) threads_.emplace();
    return threads_->count();
  }

 private:
  std::optional<HardwareThreads> threads_;
};

/// Of what -q and -v say.
inline Log::Level message_level(bool quiet, bool verbose) {
  return quiet ? Log::Level::quiet : verbose ? Log::Level::verbose : Log::Level::normal;
}

}  // namespace duet
