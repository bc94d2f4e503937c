// The parameters of a scene file: `$name` in an attribute stands for a value.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "values/report.h"

namespace duet {

/// A text with its parameters replaced.
struct Expansion {
  std::string text;
  /// The first definition of the caller's that it contains, as "name=value"; "" if there is none.
  std::string define;
};

class Substitution {
 public:
  explicit Substitution(const std::vector<std::pair<std::string, std::string>>& defines);

  /// A <default> of the scene, whose value may contain a definition of the caller's. The first
  /// definition of a name wins, and those of the caller win over all of the scene's.
  void set_default(const std::string& name, const Expansion& value);

  /// Whether `$name[` stands for itself, as in the annotations of films of 0.x.
  void keep_annotations(bool keep) { annotations_ = keep; }
  bool keeps_annotations() const { return annotations_; }

  /// The text with all parameters replaced; values are not searched for parameters again. Where `$`
  /// is followed by the names of several parameters, the longest is meant. `\$` is a plain `$`.
  /// Nothing, with an error in `report`, if a name is not defined.
  std::optional<Expansion> expand(std::string_view text, const SourceLocation& where,
                                  Report& report);

  /// The names that the scene defines or uses, in order of appearance, with their values.
  std::vector<std::pair<std::string, std::string>> scene_parameters() const;

 private:
  struct Parameter {
    Expansion value;
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
  bool annotations_ = false;
};

}  // namespace duet
