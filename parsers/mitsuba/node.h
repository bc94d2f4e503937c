// A scene file as a tree of plugins with their properties: what XML says, before anybody asks what
// it means.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "mitsuba/vocabulary.h"
#include "xml/property_value.h"

namespace duet {

struct Property {
  std::string name;     ///< in snake_case; empty for a nested plugin without a name
  std::string written;  ///< as the file has it
  PropertyValue value;
  SourceLocation where;        ///< of the element
  SourceLocation value_where;  ///< of the attribute with the value
};

/// One plugin: <bsdf type="diffuse"> … </bsdf>.
struct Node {
  PluginKind kind{};
  /// Null if there is no such plugin, or none that is supported: that error is reported.
  const Plugin* plugin = nullptr;
  std::string type, id;
  FileVersion version;
  SourceLocation where;
  std::vector<Property> properties;
  /// An integrator in whose place another method is run: nothing is reported about it.
  bool replaced = false;
  /// Folders in which its files are looked for, first to last; shared by a file's nodes.
  std::shared_ptr<const std::vector<std::string>> folders;
};

/// All plugins of a scene with the files it includes. The first is the scene.
struct NodeTree {
  std::deque<Node> nodes;
  std::vector<std::pair<std::string, std::string>> parameters;
  /// Whether the scene's integrator does not matter, so that it may have none.
  bool integrator_replaced = false;
};

/// `<bsdf type="diffuse">`, for messages.
std::string describe(const Node& node);

}  // namespace duet
