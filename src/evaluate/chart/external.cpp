// Another renderer as a child process.
#include <fmt/format.h>

#include <filesystem>

#include "base/file_names.h"
#include "base/system/run_program.h"
#include "evaluate/chart/renderers.h"
#include "evaluate/compare/linear_image.h"
#include "evaluate/render/placeholders.h"

namespace duet {

namespace {

/// A file that is there neither before nor after, whatever a renderer does and whenever it is
/// stopped.
struct RemovedFile {
  const std::string path;
  explicit RemovedFile(std::string file) : path(std::move(file)) { remove(); }
  ~RemovedFile() { remove(); }
  void remove() const {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

}  // namespace

bool ExternalRenderer::finished() const {
  // The next run takes about twice as long as the last one.
  return !line.failure.empty() || used_ + 2 * last_ > budget_;
}

void ExternalRenderer::fail(const std::string& why) {
  line.failure = fmt::format("at {} spp: {}", task_.run.spp, why);
}

void ExternalRenderer::slice(double) {
  const RemovedFile output{task_.run.output};
  ExternalRun& next = task_.run;
  const CommandEnd r = run_timed(task_.command(next), budget_ - used_, *task_.cancel);
  used_ += r.seconds;
  last_ = r.seconds;
  if (task_.cancel->load()) return;
  if (!r.started) return fail("it cannot be started");
  if (r.stopped) {
    // A run that was expected to fit and did not is no failure if there are others before it.
    used_ = budget_;
    if (line.points.empty()) fail("it did not end within its share of the time");
    return;
  }
  if (r.signal != 0) return fail(fmt::format("it was ended by signal {}", r.signal));
  if (r.exit_code != 0) return fail(fmt::format("it ended with exit code {}", r.exit_code));
  try {
    LinearImage image = load_linear(next.output);
    record(r.seconds, r.cpu_seconds, next.spp, std::move(image.image));
  } catch (const std::exception& e) {
    return fail(e.what());
  }
  next.spp *= 2;
}

ExternalCommand external_command(const std::string& pattern) {
  return [pattern](const ExternalRun& run) {
    return fill_in("--external", pattern,
                   {{"spp", fmt::to_string(run.spp)},
                    {"out", as_operand(run.output)},
                    {"scene", as_operand(run.scene)},
                    {"seed", fmt::to_string(run.seed)},
                    {"width", fmt::to_string(run.width)},
                    {"height", fmt::to_string(run.height)}});
  };
}

}  // namespace duet
