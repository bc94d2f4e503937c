#include "evaluate/batch/job.h"

#include <algorithm>

namespace duet::batch {

void add_to_all(std::vector<Job>& jobs, const std::vector<JobOption>& for_all,
                const std::vector<RenderOption>& known) {
  const auto is_repeatable = [&](const std::string& name) {
    return std::any_of(known.begin(), known.end(), [&](const RenderOption& o) {
      return o.name == name && o.kind == OptionKind::repeatable;
    });
  };
  for (Job& job : jobs)
    for (const JobOption& option : for_all) {
      const auto own = std::find_if(job.options.begin(), job.options.end(),
                                    [&](const JobOption& o) { return o.name == option.name; });
      if (own == job.options.end())
        job.options.push_back(option);
      else if (is_repeatable(option.name))
        own->values.insert(own->values.begin(), option.values.begin(), option.values.end());
    }
}

}  // namespace duet::batch
