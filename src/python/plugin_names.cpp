#include "python/plugin_names.h"

#include "mitsuba/vocabulary.h"

namespace duet::python {

std::vector<std::string> plugin_kinds(const std::string& type, const std::string& outer) {
  const auto outer_kind = kind_of_tag(outer);
  std::vector<std::string> tags;
  for (int i = 0; i < kPluginKinds; ++i) {
    const auto kind = PluginKind(i);
    if (outer_kind && may_contain(*outer_kind, kind) && Vocabulary::built_in().find(kind, type))
      tags.emplace_back(tag_of(kind));
  }
  return tags;
}

std::string parameter_type(const std::string& element, const std::string& type,
                           const std::string& name) {
  const auto kind = kind_of_tag(element);
  const Plugin* plugin = kind ? Vocabulary::built_in().find(*kind, type) : nullptr;
  const Parameter* parameter = plugin ? find_parameter(*kind, *plugin, name) : nullptr;
  return parameter ? std::string(type_name(parameter->type)) : "";
}

}  // namespace duet::python
