#include "evaluate/render/assignment.h"

#include <fmt/format.h>

#include "base/failures.h"

namespace duet {

std::pair<std::string, std::string> parse_assignment(const std::string& option,
                                                     const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError(fmt::format("{} needs NAME=VALUE, not \"{}\"", option, text));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace duet
