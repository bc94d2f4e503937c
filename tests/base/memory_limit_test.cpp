#include "base/memory_limit.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/files.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr double kMB = 1024 * 1024;

/// A machine of 8 GB as its files show it.
class Machine {
 public:
  Machine() { write("proc/meminfo", "MemTotal:        8388608 kB\nMemFree:          123456 kB\n"); }
  void write(const std::string& path, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(root_.path(path)).parent_path());
    root_.write(path, text);
  }
  void version_2(const std::string& group, const std::string& top = "/") const {
    write("proc/self/mountinfo",
          "22 28 0:21 / /proc rw,nosuid - proc proc rw\n"
          "30 23 0:26 " +
              top + " /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n");
    write("proc/self/cgroup", "0::" + group + "\n");
  }
  MemoryLimit limit() const { return memory_limit(root_.path("")); }
  double in_use() const { return memory_in_use(root_.path("")); }
  double ended() const { return processes_out_of_memory(root_.path("")); }
  double peak() const { return memory_peak(root_.path("")); }

 private:
  TemporaryDirectory root_;
};

}  // namespace

TEST_CASE("without control groups the machine's memory is the limit") {
  const Machine machine;
  CHECK(machine.limit().bytes == 8192 * kMB);
  CHECK(machine.limit().source == "physical memory");
  // Groups without a limit, and one above the machine's memory, change nothing.
  machine.version_2("/user/job");
  CHECK(machine.limit().bytes == 8192 * kMB);
  machine.write("sys/fs/cgroup/user/job/memory.max", "max\n");
  machine.write("sys/fs/cgroup/user/memory.max", "9223372036854771712\n");
  CHECK(machine.limit().source == "physical memory");
}

TEST_CASE("the least limit among a group of version 2 and those around it holds") {
  const Machine machine;
  machine.version_2("/user/job");
  machine.write("sys/fs/cgroup/user/job/memory.max", "1073741824\n");
  CHECK(machine.limit().bytes == 1024 * kMB);
  CHECK(machine.limit().source == "control group, /sys/fs/cgroup/user/job/memory.max");
  machine.write("sys/fs/cgroup/user/memory.max", "536870912\n");
  CHECK(machine.limit().bytes == 512 * kMB);
  CHECK(machine.limit().source == "control group, /sys/fs/cgroup/user/memory.max");
  // Of a group in which the process is not.
  machine.write("sys/fs/cgroup/other/memory.max", "1\n");
  CHECK(machine.limit().bytes == 512 * kMB);
  // In a container with a namespace of its own, the top has a limit, too.
  machine.write("sys/fs/cgroup/memory.max", "268435456\n");
  CHECK(machine.limit().bytes == 256 * kMB);
}

TEST_CASE("what is mounted may be a part of the hierarchy") {
  const Machine machine;
  machine.write("sys/fs/cgroup/memory.max", "268435456\n");
  machine.write("sys/fs/cgroup/job/memory.max", "134217728\n");
  machine.version_2("/docker/1234/job", "/docker/1234");
  CHECK(machine.limit().bytes == 128 * kMB);
  // The path of the process is not what the container sees.
  machine.version_2("/docker/1234", "/docker/other");
  CHECK(machine.limit().bytes == 256 * kMB);
  machine.version_2("/../1234");
  CHECK(machine.limit().bytes == 256 * kMB);
}

TEST_CASE("version 1 has a hierarchy for memory alone, maybe beside version 2") {
  const Machine machine;
  machine.write("proc/self/mountinfo",
                "31 23 0:28 / /sys/fs/cgroup rw - tmpfs tmpfs rw,mode=755\n"
                "32 31 0:29 / /sys/fs/cgroup/cpu rw - cgroup cgroup rw,cpu\n"
                "35 31 0:32 / /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory\n"
                "41 31 0:38 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw\n");
  machine.write("proc/self/cgroup", "5:cpu:/small\n4:hugetlb,memory:/large/job\n0::/small\n");
  machine.write("sys/fs/cgroup/cpu/small/memory.limit_in_bytes", "1\n");
  machine.write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  machine.write("sys/fs/cgroup/memory/large/memory.limit_in_bytes", "2147483648\n");
  CHECK(machine.limit().bytes == 2048 * kMB);
  machine.write("sys/fs/cgroup/memory/large/job/memory.limit_in_bytes", "1073741824\n");
  CHECK(machine.limit().bytes == 1024 * kMB);
  CHECK(machine.limit().source ==
        "control group, /sys/fs/cgroup/memory/large/job/memory.limit_in_bytes");
  machine.write("sys/fs/cgroup/unified/small/memory.max", "536870912\n");
  CHECK(machine.limit().bytes == 512 * kMB);
}

TEST_CASE("files that say nothing set no limit") {
  const Machine machine;
  machine.write("proc/self/mountinfo", "31 23 0:28\n- cgroup2\n\n1 2 3 / /sys - cgroup2\n");
  machine.write("proc/self/cgroup", "nonsense\n0:\n");
  CHECK(machine.limit().bytes == 8192 * kMB);
  machine.write("proc/meminfo", "MemTotal:\n");
  CHECK(std::isinf(machine.limit().bytes));
  machine.write("proc/meminfo", "MemTotal: many kB\n");
  CHECK(std::isinf(machine.limit().bytes));
}

TEST_CASE("what the process has in use") {
  const Machine machine;
  CHECK(machine.in_use() == 0);
  machine.write("proc/self/status", "Name:\tduet\nVmHWM:\t    3072 kB\nVmRSS:\t    2048 kB\n");
  CHECK(machine.in_use() == 2 * kMB);
  CHECK(machine.peak() == 3 * kMB);
  // Of this program: at least what it has just written to.
  const std::vector<char> used(size_t(64 * kMB), 1);
  CHECK(memory_in_use() > double(used.size()));
  const double now = memory_in_use();  // the peak may grow afterwards
  CHECK(memory_peak() >= now);
  CHECK(memory_limit().bytes > memory_in_use());
}

TEST_CASE("memory for people") {
  CHECK(memory_text(512e6) == "512 MB");
  CHECK(memory_text(1.234e9) == "1.23 GB");
  CHECK(memory_text(12.34e9) == "12.3 GB");
  CHECK(memory_text(4.7e12) == "4700 GB");
}

TEST_CASE("the environment can lower the limit") {
  const Machine machine;
  setenv(kMemoryLimitVariable, "1048576", 1);
  CHECK(machine.limit().bytes == kMB);
  CHECK(machine.limit().source == "environment variable DUET_MEMORY_LIMIT");
  setenv(kMemoryLimitVariable, "1e15", 1);
  CHECK(machine.limit().source == "physical memory");
  for (const char* text : {"", "much", "-1", "0", "nan", "5 GB"}) {
    CAPTURE(text);
    setenv(kMemoryLimitVariable, text, 1);
    CHECK_THROWS_WITH_AS(machine.limit(), doctest::Contains("DUET_MEMORY_LIMIT"),
                         std::runtime_error);
  }
  unsetenv(kMemoryLimitVariable);
  CHECK(machine.limit().source == "physical memory");
}

TEST_CASE("the processes that the kernel has ended are counted") {
  const Machine machine;
  CHECK(machine.ended() == 0);
  machine.write("proc/vmstat", "oom_kill_other 7\noom_kill 3\npgfault 12\n");
  CHECK(machine.ended() == 3);
}
