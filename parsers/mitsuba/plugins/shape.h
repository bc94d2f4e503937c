// Makes a plugin of the vocabulary from the description of a shape: surface<CubeShape>().
#pragma once

#include "mitsuba/plugins/plugin.h"

namespace duet::plugins {

/// What its fields say, and what all surfaces have.
template <class T>
void read_surface(SceneReader& s, Properties& p, ShapeDescription& out) {
  T geometry;
  read_values(s, p, geometry);
  out.geometry = std::move(geometry);
  s.attach_to_surface(p, out);
}

/// `more` are parameters that only files of Mitsuba know; they are listed last.
template <class T>
Plugin surface(const ParameterList& more) {
  return plugin_of<T, ShapeDescription>({.reader = &read_surface<T>}, more);
}

}  // namespace duet::plugins
