#include <functional>

#include "evaluate/batch/reports.h"
#include "evaluate/render/file_uses.h"
#include "evaluate/render/output.h"
#include "evaluate/render/output_checks.h"

namespace duet::batch {

void check_files(const std::string& list, const std::vector<Job>& jobs, const ReportPaths& paths,
                 Diagnostics& diagnostics) {
  FileUses uses;
  uses.read("the list", list);
  for (const Job& job : jobs) {
    uses.read("the scene", job.scene);
    for (const std::string& output : job.outputs) {
      uses.read("the image", output);  // that two jobs write it is known already
      if (const std::string why = prepare_file(output); !why.empty())
        diagnostics.error(job.where, "{}", why);
    }
  }
  const std::pair<const char*, const std::string&> reports[] = {
      {"--report", paths.page}, {"--junit", paths.junit}, {"--csv", paths.csv}};
  for (const auto& [option, path] : reports) {
    if (path.empty()) continue;
    uses.write(option, path);
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
