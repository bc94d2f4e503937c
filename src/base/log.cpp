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

#include "base/system/files.h"

namespace duet {

namespace {

/// Whether the whole line arrived where it should.
bool put(std::FILE* file, std::string_view text) {
  return std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0;
}

std::string with_time(std::string_view line) {
  using namespace std::chrono;
  const auto now = system_clock::now();
  const auto milliseconds = duration_cast<std::chrono::milliseconds>(now.time_since_epoch()) % 1000;
  const std::time_t seconds = system_clock::to_time_t(now);
  return fmt::format("{:%Y-%m-%d %H:%M:%S}.{:03} {}\n", fmt::localtime(seconds),
                     milliseconds.count(), line);
}

}  // namespace

struct Log::State {
  std::atomic<Level> level{Level::normal};
  std::mutex mutex;  ///< of all below
  std::function<void()> before_write;
  FileStream file;
  std::string path;
  std::optional<std::vector<std::string>> recording;
};

Log::Log() : state_(std::make_unique<State>()) {}
Log::~Log() = default;

void Log::write_to_file(std::string_view line) {
  State& s = *state_;
  if (put(s.file.get(), with_time(line))) return;
  const std::string reason = std::strerror(errno);
  s.file.reset();
  put(stderr, fmt::format("duet: warning: the log {} cannot be written: {}; going on without it\n",
                          s.path, reason));
}

void Log::set_level(Level level) {
  state_->level = level;
}
Log::Level Log::level() const {
  return state_->level;
}
void Log::set_before_write(std::function<void()> hook) {
  const std::scoped_lock lock(state_->mutex);
  state_->before_write = std::move(hook);
}

void Log::open_file(const std::string& path) {
  State& s = *state_;
  const std::scoped_lock lock(s.mutex);
  s.file = open_for_writing(path);
  s.path = path;
  if (!s.file)
    throw std::runtime_error(path + ": " +
                             (errno == ENXIO ? "nobody reads this pipe" : std::strerror(errno)));
}

void Log::write(Level needed, std::string_view line) noexcept {
  try {
    State& s = *state_;
    const std::scoped_lock lock(s.mutex);
    if (needed <= s.level) {
      if (s.before_write) s.before_write();
      put(stderr, std::string(line) + '\n');
    }
    if (s.recording && needed == Level::quiet) s.recording->emplace_back(line);
    if (s.file) write_to_file(line);
  } catch (const std::exception&) {
    // There is no memory for the message.
  }
}

Log::Recording::Recording(Log& log) : log_(log) {
  const std::scoped_lock lock(log_.state_->mutex);
  log_.state_->recording.emplace();
}

Log::Recording::~Recording() {
  const std::scoped_lock lock(log_.state_->mutex);
  log_.state_->recording.reset();
}

std::vector<std::string> Log::Recording::lines() const {
  const std::scoped_lock lock(log_.state_->mutex);
  return *log_.state_->recording;
}

}  // namespace duet
