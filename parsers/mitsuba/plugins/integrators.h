// What the files about integrators share.
#pragma once

#include "mitsuba/plugins/plugin.h"

namespace duet::plugins {

/// Methods that trace sub-paths from the lights, too (integrator_bidirectional.cpp).
std::vector<Plugin> bidirectional_integrators();
/// Integrators that another method stands in for (integrator_substitutes.cpp).
std::vector<Plugin> substituted_integrators();
/// Those that make layers of other integrators (integrator_layers.cpp).
Plugin aov();
Plugin moment();
Plugin field_integrator();
Plugin multichannel();

/// An error if a group would have too many pixels.
void check_pixel_group(Properties& p, int pixel_group);
/// Says that another method is run instead.
void note_substitute(SceneReader& s, const Properties& p, std::string_view method,
                     std::string_view why = "");
/// The kinds of layers that Mitsuba's plugin `aov` has.
const std::vector<std::string>& layer_kinds();
/// The integrator that stands in `p`; null after an error.
const Node* nested_integrator(Properties& p);

/// What its fields say; kCheck as for read_model().
template <class T, auto kCheck = nullptr>
void read_method(SceneReader& s, Properties& p, IntegratorDescription& out) {
  T method;
  read_values(s, p, method);
  if constexpr (requires { kCheck(s, p, method); }) kCheck(s, p, method);
  out.method = std::move(method);
}

/// A method by what its description says; `more` are parameters that change nothing.
template <class T, auto kCheck = nullptr>
Plugin method(Plugin row, const ParameterList& more = {}) {
  if (row.parameters.empty()) row.parameters = {parameters_of<T>(), more};
  if (std::holds_alternative<std::monostate>(row.reader)) row.reader = &read_method<T, kCheck>;
  return row;
}

/// A parameter with another default in 0.x files.
inline Parameter with_preset_0x(Parameter p, std::string_view preset) {
  p.preset_0x = preset;
  return p;
}

}  // namespace duet::plugins
