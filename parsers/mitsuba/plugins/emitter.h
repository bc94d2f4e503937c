// Makes a plugin of the vocabulary from the description of a light: light<CollimatedLight>().
#pragma once

#include "mitsuba/plugins/plugin.h"
#include "mitsuba/plugins/tables.h"

namespace duet::plugins {

/// What its fields say, where it stands, and what all lights that are no surfaces have.
template <class T>
void read_light(SceneReader& s, Properties& p, LightDescription& out) {
  read_model<T>(s, p, out);
  if constexpr (!std::is_same_v<T, ConstantLight>)
    out.to_world = p.transform("to_world", out.motion);
  read_weight(p, out);
  if (const Node* medium = p.child(PluginKind::medium)) out.medium = s.medium(*medium);
}

/// A warning if the transform of an environment also scales. In Mitsuba, rays that escape look up a
/// direction that is scaled, and light samples have one that is not of unit length: the two
/// disagree.
inline void warn_of_scales(SceneReader& s, Properties& p, const Matrix4& to_world) {
  if (to_world.is_rigid()) return;
  s.report().warning(
      p.where("to_world"),
      "the transform of {} also scales, which is left out: in Mitsuba, light samples "
      "and rays that escape do not agree about it",
      describe(p.node()));
}

inline constexpr Parameter kMovablePlace{"to_world", transform, "", kMovable};

/// A light whose place is its last parameter.
template <class T>
Plugin light(Plugin row = {}, const ParameterList& more = {}) {
  if (std::holds_alternative<std::monostate>(row.reader)) row.reader = &read_light<T>;
  return plugin_of<T, LightDescription>(std::move(row), {more, kMovablePlace});
}

}  // namespace duet::plugins
