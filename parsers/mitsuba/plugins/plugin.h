// Makes a plugin of the vocabulary from a description that states its fields.
#pragma once

#include "mitsuba/read_fields.h"
#include "mitsuba/vocabulary.h"
#include "scene/field_parameters.h"

namespace duet::plugins {

using namespace parameter_words;

/// What `row` leaves open follows from T: its name, its parameters and how it is read into a
/// Description, if that has a model; kCheck is that of read_model(). `more` are parameters that
/// only files of Mitsuba know; they are listed last.
template <class T, class Description, auto kCheck = nullptr>
Plugin plugin_of(Plugin row, const ParameterList& more = {}) {
  if (row.name.empty()) row.name = T{}.name();
  if (row.parameters.empty()) row.parameters = ParameterList(parameters_of<T>(), more);
  if constexpr (requires(Description & d, T model) { d.model = model; })
    if (std::holds_alternative<std::monostate>(row.reader))
      row.reader = &read_model<T, kCheck, Description>;
  return row;
}

template <class T, auto kCheck = nullptr>
Plugin texture(Plugin row = {}, const ParameterList& more = {}) {
  return plugin_of<T, TextureDescription, kCheck>(std::move(row), more);
}

}  // namespace duet::plugins
