// A job of `duet batch`: a scene, and how it is to be rendered.
#pragma once

#include <string>
#include <vector>

#include "base/diagnostics.h"

namespace duet::batch {

/// What an option of `duet render` takes.
enum class OptionKind {
  flag,            ///< nothing: it is there or not
  single,          ///< one value
  optional_value,  ///< one value or none
  repeatable,      ///< one value each time that it is given
};

/// An option of `duet render` by its long name without dashes.
struct RenderOption {
  std::string name;
  OptionKind kind = OptionKind::single;
};

/// An option with its values; without, it is given alone.
struct JobOption {
  std::string name;
  std::vector<std::string> values;
};

struct Job {
  SourceLocation where;  ///< in the manifest; of a folder, the scene file
  std::string scene;
  std::vector<std::string> outputs;
  std::vector<JobOption> options;

  /// Null if the job does not have it.
  const JobOption* find(const std::string& name) const {
    for (const JobOption& option : options)
      if (option.name == name) return &option;
    return nullptr;
  }
  /// The value of an option that has one, or "".
  std::string value(const std::string& name) const {
    const JobOption* option = find(name);
    return option && !option->values.empty() ? option->values[0] : "";
  }
};

/// The jobs with what is given for all of them: an option of the job takes the place of one for
/// all; of repeatable ones it has both, its own last.
void add_to_all(std::vector<Job>& jobs, const std::vector<JobOption>& for_all,
                const std::vector<RenderOption>& known);

}  // namespace duet::batch
