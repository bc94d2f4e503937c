#include "evaluate/raw/merge_files.h"

#include <fmt/ranges.h>

#include <stdexcept>

#include "base/failures.h"
#include "evaluate/raw/merge.h"
#include "evaluate/render/file_uses.h"
#include "evaluate/render/output.h"
#include "evaluate/report/render_report.h"
#include "evaluate/report/statistics.h"

namespace duet {

namespace {

/// Throws UsageError if a file that is to be written has another use.
void check_uses(const MergeRequest& r) {
  FileUses uses;
  for (const std::string& film : r.films) uses.read("the film", film);
  for (const std::string& path : r.outputs) uses.write("-o", path);
  uses.write("--raw", r.raw);
  uses.write("--stats", r.stats);
}

/// All files that are to be written; throws std::runtime_error if one cannot be.
std::vector<std::string> prepared_files(const MergeRequest& r) {
  std::vector<std::string> planned = r.outputs;
  for (const std::string& path : {r.raw, r.stats})
    if (!path.empty()) planned.push_back(path);
  for (const std::string& path : planned)
    if (const std::string why = prepare_file(path); !why.empty()) throw std::runtime_error(why);
  return planned;
}

/// Whether there are any.
bool report(const std::vector<std::string>& incomplete, Messages& messages) {
  for (const std::string& slice : incomplete) messages.error("{}", slice);
  return !incomplete.empty();
}

}  // namespace

bool merge_to_files(MergeRequest r, Messages& messages) {
  check_uses(r);
  const std::vector<std::string> planned = prepared_files(r);
  r.slices.leave_out_missing(r.films);
  if (r.films.empty()) {
    report(r.slices.incomplete({}), messages);
    throw std::runtime_error("none of the films is there");
  }
  const MergedFilms merged = merge_raw_films(r.films);
  if (merged.result.spp == 0) throw std::runtime_error("the films have no samples");
  check_formats(r.outputs, merged.image.contents.channels, r.files);
  for (const std::string& text : settings_without_effect(r.outputs, r.files))
    messages.warning("{}", text);
  RenderRecord record = record_of(merged);
  record.command_line = r.command_line;
  record.threads = r.threads;
  const std::string gaps = to_string(r.slices.gaps(merged));
  if (!gaps.empty()) messages.warning("samples are missing: {}", gaps);
  const HeaderFields header = header_of(merged, record, gaps);
  TryAll files;
  if (!r.raw.empty()) files.run([&] { write_raw_film(r.raw, merged.image, merged.state); });
  for (const std::string& path : r.outputs)
    files.run([&] { write_image(path, merged.result.image, merged.image.form, header, r.files); });
  if (!r.stats.empty())
    files.run([&] {
      StatisticsFile statistics(r.stats);
      statistics.add(record, merged.result, {.render = merged.result.seconds}, {});
      statistics.write(false);
    });
  files.finish();
  messages.info("{} films: {} -> {}", merged.films, describe(record, merged.result),
                fmt::join(planned, " "));
  return !report(r.slices.incomplete(merged.state.samples), messages);
}

}  // namespace duet
