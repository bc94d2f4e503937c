// Messages to the user: all go to standard error, and to a file if one is set.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/messages.h"

namespace duet {

class Log final : public Messages {
 public:
  Log();
  ~Log() override;
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  void set_level(Level level);
  Level level() const override;
  /// Messages of every level also go to this file. Throws std::runtime_error if it cannot be
  /// opened. If it cannot be written later on (the disk is full), a warning says so once and the
  /// program goes on without it.
  void open_file(const std::string& path);

  void write(Level needed, std::string_view line) noexcept override;

  /// Keeps the errors and warnings that are written while it exists. One at a time.
  class Recording {
   public:
    explicit Recording(Log& log);
    ~Recording();
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;
    std::vector<std::string> lines() const;

   private:
    Log& log_;
  };

  /// Called when something is about to be written to standard error: whoever draws a progress bar
  /// there removes it first. Null for nothing.
  void set_before_write(std::function<void()> hook);

 private:
  struct State;
  void write_to_file(std::string_view line);
  std::unique_ptr<State> state_;
};

}  // namespace duet
