// The parameters of a scene file: `$name` in an attribute stands for a value.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mitsuba/report.h"

namespace duet {

class Substitution {
 public:
  explicit Substitution(const std::vector<std::pair<std::string, std::string>>& defines);

  /// A <default> of the scene. The first definition of a name wins, and those of the caller win
  /// over all of the scene's.
  void set_default(const std::string& name, const std::string& value);

  /// The text with all parameters replaced; values are not searched for parameters again. Where `$`
  /// is followed by the names of several parameters, the longest is meant. `\$` is a plain `$`.
  /// Nothing, with an error in `report`, if a name is not defined.
  std::optional<std::string> expand(std::string_view text, const SourceLocation& where,
                                    Report& report);

  /// The names that the scene defines or uses, in order of appearance, with their values.
  std::vector<std::pair<std::string, std::string>> scene_parameters() const;

 private:
  struct Parameter {
    std::string value;
    int order = -1;  ///< of appearance in the scene; −1 if only the caller knows it
  };
  using Parameters = std::map<std::string, Parameter, std::less<>>;
  /// The longest name with which the text begins.
  Parameters::iterator longest_prefix(std::string_view text);
  void mark(Parameter& p) {
    if (p.order < 0) p.order = next_order_++;
  }

  Parameters parameters_;
  int next_order_ = 0;
};

}  // namespace duet
