#include "mitsuba/references.h"

#include "values/text.h"

namespace duet {

void References::add_id(Node& node, const SourceLocation& where) {
  const auto [entry, is_new] = ids_.try_emplace(node.id, &node);
  if (!is_new)
    report_.error(where, "the id {} is given twice, first at {}", in_quotes(node.id),
                  entry->second->where.to_string());
}

void References::add_alias(const std::string& name, const std::string& id,
                           const SourceLocation& where) {
  if (!aliases_.try_emplace(name, Alias{id, where}).second)
    report_.error(where, "the alias {} is given twice", in_quotes(name));
}

void References::add_reference(Node& user, const std::string& id, const SourceLocation& where) {
  references_.push_back({&user, user.properties.size() - 1, id, where});
}

const Node* References::find(const std::string& id, const SourceLocation& where) const {
  std::string name = id;
  for (size_t steps = 0; steps <= aliases_.size(); ++steps) {
    if (const auto node = ids_.find(name); node != ids_.end()) return node->second;
    const auto alias = aliases_.find(name);
    if (alias == aliases_.end()) break;
    name = alias->second.id;
  }
  report_.error(where, "nothing has the id {}{}", in_quotes(name),
                did_you_mean(name, report_.names_for_hint(ids_)));
  return nullptr;
}

void References::resolve() {
  for (const auto& [name, alias] : aliases_)
    if (const auto node = ids_.find(name); node != ids_.end())
      report_.error(alias.where, "the alias {} is already the id of {}", in_quotes(name),
                    describe(*node->second));
  for (const Reference& r : references_)
    if (const Node* node = find(r.id, r.where)) r.user->properties[r.property].value = node;
}

}  // namespace duet
