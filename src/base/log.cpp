#include "base/log.h"

#include <fmt/chrono.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>

namespace duet::log {

namespace {

struct CloseFile {
  void operator()(std::FILE* f) const { std::fclose(f); }
};

struct State {
  std::atomic<Level> level{Level::normal};
  std::atomic<void (*)()> before_write{nullptr};
  std::mutex mutex;  ///< of all below
  std::unique_ptr<std::FILE, CloseFile> file;
  std::string path;
  std::optional<std::vector<std::string>> recording;
};

State& state() {
  static State s;
  return s;
}

/// Whether the whole line arrived where it should.
bool put(std::FILE* file, std::string_view text) {
  return std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0;
}

std::string with_time(std::string_view line) {
  using namespace std::chrono;
  const auto now = system_clock::now();
  const auto milliseconds = duration_cast<std::chrono::milliseconds>(now.time_since_epoch()) % 1000;
  const std::time_t seconds = system_clock::to_time_t(now);
  std::tm local{};
  localtime_r(&seconds, &local);
  return fmt::format("{:%Y-%m-%d %H:%M:%S}.{:03} {}\n", local, milliseconds.count(), line);
}

void write_to_file(State& s, std::string_view line) {
  if (put(s.file.get(), with_time(line))) return;
  const std::string reason = std::strerror(errno);
  s.file.reset();
  put(stderr, fmt::format("duet: warning: the log {} cannot be written: {}; going on without it\n",
                          s.path, reason));
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
  State& s = state();
  const std::scoped_lock lock(s.mutex);
  s.file.reset(std::fopen(path.c_str(), "we"));
  s.path = path;
  if (!s.file) throw std::runtime_error(path + ": " + std::strerror(errno));
}

void write(Level needed, std::string_view line) noexcept {
  try {
    State& s = state();
    const std::scoped_lock lock(s.mutex);
    if (needed <= s.level) {
      if (const auto hook = s.before_write.load()) hook();
      put(stderr, std::string(line) + '\n');
    }
    if (s.recording && needed == Level::quiet) s.recording->emplace_back(line);
    if (s.file) write_to_file(s, line);
  } catch (const std::exception&) {
    // There is no memory for the message.
  }
}

Recording::Recording() {
  const std::scoped_lock lock(state().mutex);
  state().recording.emplace();
}

Recording::~Recording() {
  const std::scoped_lock lock(state().mutex);
  state().recording.reset();
}

std::vector<std::string> Recording::lines() const {
  const std::scoped_lock lock(state().mutex);
  return *state().recording;
}

}  // namespace duet::log
