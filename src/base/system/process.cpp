#include "base/system/process.h"

#include <sys/auxv.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>

namespace duet {

std::string own_program() {
  std::error_code error;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) return path.string();
  // A bare chroot has no /proc.
  const auto name = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
  return name ? std::filesystem::canonical(name, error).string() : "";
}

int process_id() {
  return getpid();
}

double process_cpu_seconds() {
  rusage u{};
  getrusage(RUSAGE_SELF, &u);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(u.ru_utime) + seconds(u.ru_stime);
}

}  // namespace duet
