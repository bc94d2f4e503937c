#include <functional>

#include "evaluate/batch/reports.h"

namespace duet::batch {

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
