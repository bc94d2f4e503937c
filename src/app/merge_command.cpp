// duet merge: raw films in, one image out.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "app/arguments.h"
#include "app/commands.h"
#include "app/display_options.h"
#include "app/output.h"
#include "app/program.h"
#include "base/diagnostics.h"
#include "evaluate/raw/merge.h"
#include "evaluate/raw/slices.h"
#include "evaluate/report/render_report.h"
#include "evaluate/report/statistics.h"

namespace duet {

namespace {

struct MergeOptions {
  std::vector<std::string> films, outputs;
  std::string png, raw, stats, exposure = "0", tone_map, slices, spp, slice_command;
  bool quiet = false;
};

/// The films as slices of all samples.
class ExpectedSlices {
 public:
  explicit ExpectedSlices(const MergeOptions& o) : command_(o.slice_command) {
    if (o.slices.empty() != o.spp.empty())
      throw UsageError("merge: --slices and --spp belong together");
    if (o.slices.empty() && !command_.empty())
      throw UsageError("--slice-command: there is no --slices");
    if (o.slices.empty()) return;
    spp_ = uint32_t(parse_whole("--spp", o.spp, 1, 1u << 30));
    count_ = uint32_t(parse_whole("--slices", o.slices, 1, spp_));
  }
  bool are_known() const { return count_ > 0; }

  /// Films that are not there are slices that are lost.
  void leave_out_missing(std::vector<std::string>& films) const {
    std::error_code ignored;
    if (are_known())
      std::erase_if(films,
                    [&](const auto& path) { return !std::filesystem::exists(path, ignored); });
  }
  /// The samples that no film has, of those that are expected.
  std::vector<SampleInterval> gaps(const MergedFilms& merged) const {
    if (!are_known()) return merged.gaps;
    if (merged.state.films.size() > 1)
      throw std::runtime_error("--slices: a render with --target-error has none");
    return merged.state.samples.missing_from({0, spp_});
  }
  /// Names those that are not complete; returns whether there are any.
  bool report_incomplete(const SampleIntervals& samples, Log& log) const {
    const std::vector<IncompleteSlice> lost = incomplete_slices(samples, spp_, count_);
    for (const auto& [number, missing] : lost) {
      std::string how = command_;
      for (size_t at = 0; (at = how.find("{slice}", at)) != std::string::npos;)
        how.replace(at, 7, std::to_string(number));
      log.error("slice {}/{} lacks the samples {}{}{}", number, count_, to_string(missing),
                how.empty() ? "" : "; render them with: ", how);
    }
    return !lost.empty();
  }

 private:
  uint32_t spp_ = 0, count_ = 0;  ///< of slices; 0 if they are not known
  std::string command_;
};

int merge(MergeOptions o, Program& program) {
  if (o.quiet) program.log.set_level(Log::Level::quiet);
  if (!o.png.empty()) o.outputs.push_back(o.png);
  const DisplaySettings display = parse_display(o.exposure, o.tone_map);
  if (o.outputs.empty() && o.raw.empty())
    throw UsageError("merge: -o, --png or --raw has to name a file");
  for (const std::string& path : o.outputs) {
    if (image_format(path).empty())
      throw UsageError(fmt::format("-o {}: images are written as .exr, .png or .jpg", path));
  }
  const ExpectedSlices slices(o);
  std::vector<std::string> planned = o.outputs;
  for (const std::string& path : {o.raw, o.stats})
    if (!path.empty()) planned.push_back(path);
  for (const std::string& path : planned)
    if (const std::string why = prepare_file(path); !why.empty())
      throw std::runtime_error(fmt::format("cannot write {}: {}", path, why));

  slices.leave_out_missing(o.films);
  if (o.films.empty()) {
    slices.report_incomplete({}, program.log);
    throw std::runtime_error("none of the films is there");
  }
  const MergedFilms merged = merge_raw_films(o.films);
  if (merged.result.spp == 0) throw std::runtime_error("the films have no samples");
  check_formats(o.outputs, merged.image.contents.channels);
  RenderRecord record = record_of(merged);
  record.command_line = program.command_line;
  record.threads = program.threads();
  const std::string gaps = to_string(slices.gaps(merged));
  if (!gaps.empty()) program.log.warning("samples are missing: {}", gaps);
  if (!o.raw.empty()) write_raw_film(o.raw, merged.image, merged.state);
  const HeaderFields header = header_of(merged, record, gaps);
  for (const std::string& path : o.outputs)
    write_image(path, merged.result.image, merged.image.form, header, display);
  if (!o.stats.empty()) {
    StatisticsFile statistics(o.stats);
    statistics.add(record, merged.result, {.render = merged.result.seconds}, {});
    statistics.write(false);
  }
  program.log.info("{} films: {} -> {}", merged.films, describe(record, merged.result),
                   fmt::join(planned, " "));
  return slices.report_incomplete(merged.state.samples, program.log) ? kSceneFailed : kSuccess;
}

}  // namespace

void add_merge_command(CLI::App& app, Program& program) {
  CLI::App* c = app.add_subcommand("merge", "Add up raw films to one image");
  const auto o = std::make_shared<MergeOptions>();
  c->add_option("films", o->films, "Raw films of one image, with different samples")->required();
  c->add_option("-o,--output", o->outputs, "Image: .exr, .png or .jpg; repeatable")
      ->allow_extra_args(false);
  c->add_option("--png", o->png, "Image for display");
  c->add_option("--raw", o->raw, "All of them as one raw film, to go on from");
  add_display_options(*c, o->exposure, o->tone_map);
  c->add_option("--stats", o->stats, "Write statistics as JSON to this file");
  c->add_option("--slices", o->slices,
                "The films are this many slices, as of duet render --slice, of all samples; those "
                "that are lost or lack samples are named");
  c->add_option("--spp", o->spp, "With --slices: the samples per pixel of all of them");
  c->add_option("--slice-command", o->slice_command,
                "With --slices: a command that renders a slice, with {slice} for its number; it is "
                "printed for each that is not complete");
  c->add_flag("-q,--quiet", o->quiet, "Errors and warnings only");
  c->footer(
      "The sums are exact: the image is the same, bit for bit, as that of one render with all the "
      "samples. Gaps are reported, and the image is the mean of what is there.\n"
      "Examples:\n"
      "  duet room.xml --slice 1/2 --raw a.exr; duet room.xml --slice 2/2 --raw b.exr\n"
      "  duet merge a.exr b.exr -o room.exr --png room.png\n"
      "  duet merge slice-*.exr --slices 16 --spp 256 -o room.exr\n"
      "Exit codes: 0; 1 a film is damaged or does not go with the others, one of --slices is not "
      "complete, or a file cannot be written; 2 wrong usage.");
  c->callback([o, &program] { program.exit_code = merge(*o, program); });
}

}  // namespace duet
