#include "evaluate/render/placeholders.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/failures.h"

namespace duet {

std::string fill_in(const std::string& option, const std::string& pattern,
                    const Placeholders& names) {
  std::string out;
  for (size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] != '{') {
      out += pattern[i];
      continue;
    }
    if (pattern.compare(i, 2, "{{") == 0) {
      out += pattern[i++];
      continue;
    }
    const size_t end = pattern.find('}', i);
    const std::string key = end == std::string::npos ? "" : pattern.substr(i + 1, end - i - 1);
    const auto meant =
        std::find_if(names.begin(), names.end(), [&](const auto& n) { return n.first == key; });
    if (meant == names.end()) {
      std::string known;
      for (const auto& n : names)
        known += (known.empty()         ? ""
                  : &n == &names.back() ? " and "
                                        : ", ") +
                 ("{" + n.first + "}");
      throw UsageError(
          fmt::format("{} {}: only {} are filled in; {{{{ means a brace", option, pattern, known));
    }
    out += meant->second;
    i = end;
  }
  return out;
}

std::string as_pattern(const std::string& text) {
  std::string pattern;
  for (const char c : text) pattern += c == '{' ? "{{" : std::string(1, c);
  return pattern;
}

}  // namespace duet
