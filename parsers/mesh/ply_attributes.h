// Which further properties of a PLY element make up which mesh attribute, by Mitsuba's naming
// rules.
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh_file.h"
#include "mesh/ply_header.h"

namespace duet {

/// An attribute and the properties that hold its channels.
struct PlyAttribute {
  std::string name;
  std::vector<int> properties;  ///< 1 or 3 indices into the element's properties
  bool is_color = false;        ///< r g b or red green blue without a prefix
};

/// Mitsuba's rules: r, g, b or red, green, blue are "color"; otherwise properties that follow each
/// other and are called name_x name_y name_z (or _r _g _b, which makes "name_color", or _0 _1 _2,
/// or _1 _2 _3), or one of them alone, are the attribute "name". Each gets `prefix` before its
/// name. Groups of two or four, an alpha beside r g b, lists, properties listed in `used` and those
/// with other names are left out, as they cannot be asked for in Mitsuba either.
std::vector<PlyAttribute> group_attributes(const PlyElement& element, const std::string& prefix,
                                           const std::vector<int>& used, MeshDialect dialect);

}  // namespace duet
