// Makes a plugin of the vocabulary from the description of a BSDF.
//
// What its fields say needs no code: bsdf<UberMaterial>({.note = "Duet's own"}). Where not every
// combination of values makes sense, a function checks them: bsdf<HairMaterial, check_hair>(). A
// plugin that means more by its parameters has a function that reads it, with read_values() and
// read_nested().
#pragma once

#include "mitsuba/plugins/plugin.h"

namespace duet::plugins {

/// The parameters of T without those of the roughness that its interface may have.
template <class T>
std::vector<Parameter> smooth_parameters() {
  std::vector<Parameter> list = parameters_of<T>();
  const T initial{};
  for_each_field(initial, [&]<class M>(const FieldFacts& facts, const M&) {
    if constexpr (std::is_same_v<M, std::optional<Roughness>>)
      std::erase_if(list, [&](const Parameter& p) { return facts.has_parameter(p.name); });
  });
  return list;
}

/// As plugin_of(). Where the interface may be rough, it is smooth.
template <class T, auto kCheck = nullptr>
Plugin bsdf(Plugin row = {}) {
  if (row.parameters.empty()) row.parameters = smooth_parameters<T>();
  return plugin_of<T, MaterialDescription, kCheck>(std::move(row));
}

/// The same for the plugin with a rough interface, whose name must be given.
template <class T, auto kCheck = nullptr>
Plugin rough_bsdf(Plugin row) {
  return plugin_of<T, MaterialDescription, kCheck>(std::move(row));
}

}  // namespace duet::plugins
