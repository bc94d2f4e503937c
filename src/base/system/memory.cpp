#include "base/system/memory.h"

#include <cstdlib>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <vector>

namespace duet {

namespace {

namespace fs = std::filesystem;

/// A place where a hierarchy of control groups is mounted, and what a limit's file is called there.
struct Hierarchy {
  fs::path mount;    ///< the folder
  fs::path top;      ///< the group that this folder is
  const char* file;  ///< with the limit
};

std::vector<std::string> words(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> all;
  for (std::string word; stream >> word;) all.push_back(word);
  return all;
}

bool has_item(const std::string& comma_separated, const std::string& item) {
  return ("," + comma_separated + ",").find("," + item + ",") != std::string::npos;
}

/// The hierarchy that a line of mountinfo describes, if it is one with limits of memory:
/// "id parent device top mount options … - type source super_options".
std::optional<Hierarchy> parse_mount(const std::string& line) {
  const std::vector<std::string> w = words(line);
  constexpr size_t kTop = 3, kMount = 4;
  size_t type = kMount;
  while (type < w.size() && w[type] != "-") ++type;
  if (++type + 2 >= w.size()) return std::nullopt;
  if (w[type] == "cgroup2") return Hierarchy{w[kMount], w[kTop], "memory.max"};
  if (w[type] == "cgroup" && has_item(w[type + 2], "memory"))
    return Hierarchy{w[kMount], w[kTop], "memory.limit_in_bytes"};
  return std::nullopt;
}

/// The group of this process in a hierarchy, as /proc/self/cgroup names it:
/// "number:controllers:path".
fs::path group_of_process(const fs::path& root, bool is_version_2) {
  std::ifstream file(root / "proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    const size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == line.npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (is_version_2 ? controllers.empty() : has_item(controllers, "memory"))
      return line.substr(second + 1);
  }
  return "/";
}

/// The number in a file; infinite if there is none, such as where it says "max".
double read_limit(const fs::path& path) {
  double limit = 0;
  return std::ifstream(path) >> limit ? limit : std::numeric_limits<double>::infinity();
}

void lower(MemoryLimit& limit, double bytes, const std::string& source) {
  if (bytes < limit.bytes) limit = {bytes, source};
}

/// Goes from the group of the process up to the top of what is mounted.
void lower_by_groups(const fs::path& root, const Hierarchy& h, MemoryLimit& limit) {
  const fs::path group = group_of_process(root, std::string(h.file) == "memory.max");
  fs::path below = group.lexically_relative(h.top);
  // A group outside of what is mounted, as in a container that does not see its own path.
  if (below.empty() || *below.begin() == "..") below = ".";
  for (fs::path at = below;; at = at.parent_path()) {
    const fs::path file = (h.mount / at / h.file).lexically_normal();
    lower(limit, read_limit(root / file.relative_path()), "control group, " + file.string());
    if (at.empty()) return;
  }
}

/// The number behind a name at the beginning of a line.
double number_of_line(const fs::path& path, const std::string& name) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::vector<std::string> w = words(line);
    if (w.size() >= 2 && w[0] == name) return std::strtod(w[1].c_str(), nullptr);
  }
  return 0;
}

}  // namespace

MemoryLimit system_memory_limit(const fs::path& root) {
  MemoryLimit limit{std::numeric_limits<double>::infinity(), "unknown"};
  const double physical = 1024 * number_of_line(root / "proc/meminfo", "MemTotal:");
  if (physical > 0) lower(limit, physical, "physical memory");
  std::ifstream mounts(root / "proc/self/mountinfo");
  for (std::string line; std::getline(mounts, line);)
    if (const auto hierarchy = parse_mount(line)) lower_by_groups(root, *hierarchy, limit);
  return limit;
}

double processes_out_of_memory(const fs::path& root) {
  return number_of_line(root / "proc/vmstat", "oom_kill");
}

double memory_in_use(const fs::path& root) {
  return 1024 * number_of_line(root / "proc/self/status", "VmRSS:");
}

double memory_peak(const fs::path& root) {
  return 1024 * number_of_line(root / "proc/self/status", "VmHWM:");
}

}  // namespace duet
