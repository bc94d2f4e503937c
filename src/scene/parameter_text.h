// Parameters in words, and how one is found by its name.
#pragma once

#include <optional>
#include <string_view>

#include "scene/parameter.h"

namespace duet {

/// What the list of plugins and messages call it.
std::string_view type_name(ParameterType type);

/// What a number must be, unlike this one: "positive". Nothing if it lies in the range.
std::optional<std::string_view> broken_rule(NumberRange range, double value);

/// Whether `name` is one of the words of `words`, which are separated by spaces.
bool has_word(std::string_view words, std::string_view name);

/// Whether it has that name or alias.
inline bool is_called(const Parameter& p, std::string_view name) {
  return p.name == name || has_word(p.aliases, name);
}

}  // namespace duet
