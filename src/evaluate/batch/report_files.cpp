#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <set>

#include "base/failures.h"
#include "evaluate/batch/reports.h"
#include "evaluate/render/output.h"
#include "evaluate/render/output_checks.h"

namespace duet::batch {

namespace fs = std::filesystem;

void check_files(const std::string& list, const std::vector<Job>& jobs, const ReportPaths& paths,
                 Diagnostics& diagnostics) {
  std::error_code ignored;
  std::set<std::string> taken{fs::weakly_canonical(list, ignored)};
  for (const Job& job : jobs)
    for (const std::string& output : job.outputs) {
      taken.insert(fs::weakly_canonical(output, ignored));
      if (const std::string why = prepare_file(output); !why.empty())
        diagnostics.error(job.where, "{}", why);
    }
  const std::pair<const char*, const std::string&> reports[] = {
      {"--report", paths.page}, {"--junit", paths.junit}, {"--csv", paths.csv}};
  for (const auto& [option, path] : reports) {
    if (path.empty()) continue;
    if (!taken.insert(fs::weakly_canonical(path, ignored)).second)
      throw UsageError(fmt::format("{} {}: this file has another use in this call", option, path));
    check_writable(option, path);
  }
}

bool write_reports(const BatchOutcome& batch, const ReportPaths& paths, Messages& messages) {
  const auto write = [&](const char* option, const std::string& path,
                         const std::function<void(AtomicFile&)>& contents) {
    if (path.empty()) return true;
    try {
      AtomicFile file(path);
      contents(file);
      file.commit();
      return true;
    } catch (const std::exception& e) {
      messages.error("{}: {}", option, e.what());
      return false;
    }
  };
  bool good = write("--csv", paths.csv, [&](AtomicFile& f) { f.write(outcome_csv(batch)); });
  good &= write("--junit", paths.junit, [&](AtomicFile& f) { f.write(outcome_junit(batch)); });
  good &= write("--report", paths.page, [&](AtomicFile& f) { write_outcome_page(batch, f); });
  return good;
}

}  // namespace duet::batch
