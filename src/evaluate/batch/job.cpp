#include "evaluate/batch/job.h"

#include <algorithm>
#include <filesystem>
#include <map>

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

void check_outputs_differ(const std::vector<Job>& jobs, Diagnostics& diagnostics) {
  std::map<std::string, const Job*> writers;
  for (const Job& job : jobs)
    for (const std::string& output : job.outputs) {
      std::error_code ignored;
      const std::string path =
          std::filesystem::absolute(output, ignored).lexically_normal().string();
      const auto [writer, is_new] = writers.try_emplace(path, &job);
      if (!is_new)
        diagnostics.error(job.where,
                          "{} is written by two jobs, the other is {}; a template with {{scene}}, "
                          "{{folder}} or the name of an option tells them apart",
                          output, writer->second->where.to_string());
    }
}

}  // namespace duet::batch
