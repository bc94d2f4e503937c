// What the system knows of memory: of the machine and of this process.
#pragma once

#include <filesystem>
#include <string>

namespace duet {

struct MemoryLimit {
  double bytes = 0;    ///< infinite if nothing is known
  std::string source;  ///< for people: what sets the limit
};

/// The least of the machine's physical memory (/proc/meminfo) and of what the control groups of the
/// process, or those around them, allow: memory.max of version 2, memory.limit_in_bytes of version
/// 1. Source: cgroups(7), proc(5), and cgroup-v2 and cgroup-v1/memory in the documentation of
/// Linux. Files are looked for under `root`.
MemoryLimit system_memory_limit(const std::filesystem::path& root = "/");

/// How many processes the kernel has ended for lack of memory since the machine was started
/// (oom_kill of /proc/vmstat); 0 if that is not known.
double processes_out_of_memory(const std::filesystem::path& root = "/");

/// Memory that this process has in use, in bytes; 0 if that is not known.
double memory_in_use(const std::filesystem::path& root = "/");
/// The most that it has had in use, likewise. (What getrusage() says goes on from the program that
/// started this one.)
double memory_peak(const std::filesystem::path& root = "/");

}  // namespace duet
