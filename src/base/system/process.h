// What the system knows of this process.
#pragma once

#include <string>

namespace duet {

/// The file of the program that is running, or "" if that cannot be found out.
std::string own_program();

/// The process's number, which no other process of this machine has.
int process_id();

/// Processor time that its threads have taken since it was started.
double process_cpu_seconds();

}  // namespace duet
