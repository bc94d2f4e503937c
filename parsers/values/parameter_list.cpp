#include "values/parameter_list.h"

#include "values/text.h"

namespace duet {

ParameterList inert_parameters(ParameterType type, std::string_view names, FileVersions versions) {
  std::vector<Parameter> list;
  for (const std::string_view name : split_list(names))
    list.push_back({.name = name, .type = type, .versions = versions, .support = Support::inert});
  return list;
}

}  // namespace duet
