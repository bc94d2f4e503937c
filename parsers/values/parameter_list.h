// Parameters in the order in which they are listed.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "scene/parameter_text.h"

namespace duet {

/// The parameters of a plugin, in the order in which they are listed. Copies share them.
class ParameterList {
 public:
  ParameterList() = default;
  /// Of single parameters and of lists of them.
  template <class... Parts>
  ParameterList(const Parts&... parts) {
    std::vector<Parameter> list;
    (add(list, parts), ...);
    list_ = std::make_shared<const std::vector<Parameter>>(std::move(list));
  }
  const Parameter* begin() const { return list_ ? list_->data() : nullptr; }
  const Parameter* end() const { return list_ ? list_->data() + list_->size() : nullptr; }
  bool empty() const { return begin() == end(); }

 private:
  static void add(std::vector<Parameter>& list, const Parameter& p) { list.push_back(p); }
  template <class List>
  static void add(std::vector<Parameter>& list, const List& more) {
    list.insert(list.end(), std::begin(more), std::end(more));
  }
  std::shared_ptr<const std::vector<Parameter>> list_;
};

/// Parameters that change nothing, by their names, which are separated by spaces.
ParameterList inert_parameters(ParameterType type, std::string_view names,
                               FileVersions versions = FileVersions::all);

}  // namespace duet
