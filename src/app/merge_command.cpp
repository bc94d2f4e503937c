// duet merge: raw films in, one image out.
#include <CLI/CLI.hpp>

#include "app/arguments.h"
#include "app/commands.h"
#include "app/file_options.h"
#include "app/program.h"
#include "base/diagnostics.h"
#include "evaluate/raw/expected_slices.h"
#include "evaluate/raw/merge.h"
#include "evaluate/render/output.h"
#include "evaluate/report/render_report.h"
#include "evaluate/report/statistics.h"

namespace duet {

namespace {

struct MergeOptions {
  std::vector<std::string> films, outputs;
  std::string png, raw, stats, slices, spp, slice_command;
  FileOptions files;
  bool quiet = false;
};

/// What --slices says of the films.
ExpectedSlices expected_slices(const MergeOptions& o) {
  if (o.slices.empty() != o.spp.empty())
    throw UsageError("merge: --slices and --spp belong together");
  if (o.slices.empty() && !o.slice_command.empty())
    throw UsageError("--slice-command: there is no --slices");
  if (o.slices.empty()) return {};
  const auto spp = uint32_t(parse_whole("--spp", o.spp, 1, 1u << 30));
  return {uint32_t(parse_whole("--slices", o.slices, 1, spp)), spp, o.slice_command};
}

/// Whether there are any.
bool report(const std::vector<std::string>& incomplete, Log& log) {
  for (const std::string& slice : incomplete) log.error("{}", slice);
  return !incomplete.empty();
}

int merge(MergeOptions o, Program& program) {
  if (o.quiet) program.log.set_level(Log::Level::quiet);
  if (!o.png.empty()) o.outputs.push_back(o.png);
  const FileSettings files = parse_file_settings(o.files);
  if (o.outputs.empty() && o.raw.empty())
    throw UsageError("merge: -o, --png or --raw has to name a file");
  for (const std::string& path : o.outputs) {
    if (image_format(path).empty())
      throw UsageError(fmt::format("-o {}: images are written as .exr, .png or .jpg", path));
  }
  const ExpectedSlices slices = expected_slices(o);
  std::vector<std::string> planned = o.outputs;
  for (const std::string& path : {o.raw, o.stats})
    if (!path.empty()) planned.push_back(path);
  for (const std::string& path : planned)
    if (const std::string why = prepare_file(path); !why.empty())
      throw std::runtime_error(fmt::format("cannot write {}: {}", path, why));

  slices.leave_out_missing(o.films);
  if (o.films.empty()) {
    report(slices.incomplete({}), program.log);
    throw std::runtime_error("none of the films is there");
  }
  const MergedFilms merged = merge_raw_films(o.films);
  if (merged.result.spp == 0) throw std::runtime_error("the films have no samples");
  check_formats(o.outputs, merged.image.contents.channels, files);
  RenderRecord record = record_of(merged);
  record.command_line = program.command_line;
  record.threads = program.threads();
  const std::string gaps = to_string(slices.gaps(merged));
  if (!gaps.empty()) program.log.warning("samples are missing: {}", gaps);
  if (!o.raw.empty()) write_raw_film(o.raw, merged.image, merged.state);
  const HeaderFields header = header_of(merged, record, gaps);
  for (const std::string& path : o.outputs)
    write_image(path, merged.result.image, merged.image.form, header, files);
  if (!o.stats.empty()) {
    StatisticsFile statistics(o.stats);
    statistics.add(record, merged.result, {.render = merged.result.seconds}, {});
    statistics.write(false);
  }
  program.log.info("{} films: {} -> {}", merged.films, describe(record, merged.result),
                   fmt::join(planned, " "));
  return report(slices.incomplete(merged.state.samples), program.log) ? kSceneFailed : kSuccess;
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
  add_file_options(*c, o->files);
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
