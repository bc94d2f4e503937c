// The materials of an OBJ file's library, as plugins that the scene could have written itself.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "mesh/mtl.h"
#include "mitsuba/mitsuba.h"
#include "mitsuba/node.h"
#include "values/report.h"

namespace duet {

/// What Mitsuba 0.6 makes of a material follows from `illum`: 2 is "phong" (or "diffuse" if Ks or
/// Ns is zero), 4, 6, 7 and 9 are "dielectric", 5 and 8 an aluminium "conductor", all others
/// "diffuse". `bump` and an opacity put "bumpmap" and "mask" around that. Colours are sRGB; images
/// are decoded as the files say, but for `bump`, whose are linear.
class MaterialLibrary {
 public:
  /// `folders` are searched for images, first to last; the nodes have `version`, which must be 0.x.
  MaterialLibrary(const std::string& file, const std::vector<MtlMaterial>& materials,
                  std::vector<std::string> folders, const FileVersion& version);

  /// The material of that name (the last one of several); null if there is none. Images that are
  /// not found are black, with a warning. The node lives as long as the library.
  const Node* find(const std::string& name, const FileAccess& files, Report& report);

 private:
  using Value = MtlMaterial::Value;
  Node& add(PluginKind kind, const char* type, int line);
  const Node* make(const MtlMaterial& m, const FileAccess& files, Report& report);
  SourceLocation place(int line) const { return {file_, line, 1}; }
  void set(Node& node, const std::string& name, PropertyValue value, int line) const;
  /// A texture, or what its absence leaves: black.
  PropertyValue image(const Value& v, bool linear, const FileAccess& files, Report& report);
  PropertyValue color(const Value& v, const FileAccess& files, Report& report);

  std::shared_ptr<const std::string> file_;
  std::shared_ptr<const std::vector<std::string>> folders_;
  FileVersion version_;
  std::map<std::string, MtlMaterial> materials_;
  std::map<std::string, const Node*> made_;
  std::map<std::pair<std::string, bool>, PropertyValue> images_;
  std::deque<Node> nodes_;
};

}  // namespace duet
