#include "base/log.h"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <stdexcept>

namespace duet::log {

namespace {

struct State {
  Level level = Level::normal;
  void (*before_write)() = nullptr;
  std::shared_ptr<spdlog::sinks::sink> file;
  spdlog::logger terminal{"duet", std::make_shared<spdlog::sinks::stderr_sink_mt>()};
  State() { terminal.set_pattern("%v"); }
};

State& state() {
  static State s;
  return s;
}

}  // namespace

void set_level(Level level) {
  state().level = level;
}
Level level() {
  return state().level;
}
void set_before_write(void (*hook)()) {
  state().before_write = hook;
}

void open_file(const std::string& path) {
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(path, true);
    sink->set_pattern("%Y-%m-%d %H:%M:%S.%e %v");
    state().file = std::move(sink);
  } catch (const spdlog::spdlog_ex& e) {
    throw std::runtime_error(e.what());
  }
}

void write(Level needed, std::string_view line) {
  State& s = state();
  if (needed <= s.level) {
    if (s.before_write) s.before_write();
    s.terminal.log(spdlog::level::info, line);
    s.terminal.flush();
  }
  if (s.file) {
    s.file->log(spdlog::details::log_msg("duet", spdlog::level::info, line));
    s.file->flush();
  }
}

}  // namespace duet::log
