// What people are told about a render that has ended.
#pragma once

#include <string>

#include "evaluate/report/header.h"

namespace duet {

/// "64 spp in 1.2 s, relative standard error 3 %".
std::string describe(const RenderRecord& record, const RenderResult& result);

/// Why the error that was asked for has not been reached; empty if it has, or if none was asked
/// for.
std::string target_miss(const RenderRecord& record, const RenderResult& result);

}  // namespace duet
