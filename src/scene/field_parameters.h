// The parameters of a description's fields, with their defaults: those are the values with which
// its members begin.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "scene/description_base.h"
#include "scene/field.h"

namespace duet {

/// The initial value of a field as the text of a default; empty for one that is absent.
template <class M>
std::string initial_text(const FieldFacts& facts, const M& value) {
  if constexpr (std::is_same_v<M, bool>)
    return value ? "true" : "false";
  else if constexpr (std::is_same_v<M, std::string>)
    return value;
  else if constexpr (std::is_arithmetic_v<M>)
    return fmt::format("{}", value);
  else if constexpr (std::is_same_v<M, Spectrum>)
    return fmt::format("{}", value.r);
  else if constexpr (std::is_enum_v<M>)
    return size_t(value) < facts.words.size() ? std::string(facts.words[size_t(value)]) : "";
  else if constexpr (requires { std::variant_size<M>::value; })  // or a texture, or a volume
    return initial_text(facts, std::get<0>(value));
  else if constexpr (requires { value.has_value(); })
    return value ? initial_text(facts, *value) : "";
  else
    return "";
}

/// The parameters of T's fields, one after the other, with kInitial replaced.
template <HasFields T>
const std::vector<Parameter>& parameters_of() {
  struct Table {
    std::vector<Parameter> parameters;
    std::deque<std::string> texts;  // which the parameters refer to
  };
  static const Table table = [] {
    Table t;
    const T initial{};
    for_each_field(initial, [&](const FieldFacts& facts, const auto& value) {
      for (Parameter p : facts.parameters) {
        if (p.preset == kInitial) p.preset = t.texts.emplace_back(initial_text(facts, value));
        t.parameters.push_back(p);
      }
    });
    return t;
  }();
  return table.parameters;
}

/// The parameter of that name of T's fields; throws if there is none.
template <HasFields T>
const Parameter& parameter(std::string_view name) {
  for (const Parameter& p : parameters_of<T>())
    if (p.name == name) return p;
  throw std::out_of_range("no field has this parameter");
}

/// Those of them whose names are listed, separated by spaces, in that order; throws
/// std::out_of_range where there is none.
template <HasFields T>
std::vector<Parameter> parameters_of(std::string_view names) {
  std::vector<Parameter> list;
  while (!names.empty()) {
    const size_t end = std::min(names.find(' '), names.size());
    list.push_back(parameter<T>(names.substr(0, end)));
    names.remove_prefix(std::min(end + 1, names.size()));
  }
  return list;
}

}  // namespace duet
