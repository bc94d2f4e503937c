// The names in a scene: ids, aliases, and the references that are resolved when all files are read.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "mitsuba/node.h"
#include "values/report.h"

namespace duet {

class References {
 public:
  explicit References(Report& report) : report_(report) {}

  /// Gives `node` its id; an error if another plugin has it.
  void add_id(Node& node, const SourceLocation& where);
  void add_alias(const std::string& name, const std::string& id, const SourceLocation& where);
  /// The last property of `user` refers to the plugin with that id.
  void add_reference(Node& user, const std::string& id, const SourceLocation& where);

  /// Puts the plugins in the place of the references. An id that nothing has is an error.
  void resolve();

 private:
  struct Reference {
    Node* user;
    size_t property;
    std::string id;
    SourceLocation where;
  };
  struct Alias {
    std::string id;
    SourceLocation where;
  };
  /// The plugin with an id or alias; null after an error.
  const Node* find(const std::string& id, const SourceLocation& where) const;

  Report& report_;
  std::unordered_map<std::string, Node*> ids_;
  std::unordered_map<std::string, Alias> aliases_;
  std::vector<Reference> references_;
};

}  // namespace duet
