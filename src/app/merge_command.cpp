// duet merge: raw films in, one image out.
#include <CLI/CLI.hpp>

#include "app/arguments.h"
#include "app/commands.h"
#include "app/file_options.h"
#include "app/program.h"
#include "evaluate/raw/merge_files.h"
#include "evaluate/render/output.h"

namespace duet {

namespace {

struct MergeOptions {
  MergeRequest request;
  std::string png, slices, spp, slice_command;
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

int merge(MergeOptions o, Program& program) {
  if (o.quiet) program.log.set_level(Log::Level::quiet);
  MergeRequest& request = o.request;
  if (!o.png.empty()) request.outputs.push_back(o.png);
  request.files = parse_file_settings(o.files);
  if (request.outputs.empty() && request.raw.empty())
    throw UsageError("merge: -o, --png or --raw has to name a file");
  for (const std::string& path : request.outputs) {
    if (image_format(path).empty())
      throw UsageError(fmt::format("-o {}: images are written as .exr, .png or .jpg", path));
  }
  request.slices = expected_slices(o);
  request.command_line = program.command_line;
  request.threads = program.threads();
  return merge_to_files(std::move(request), program.log) ? kSuccess : kSceneFailed;
}

}  // namespace

void add_merge_command(CLI::App& app, Program& program) {
  CLI::App* c = app.add_subcommand("merge", "Add up raw films to one image");
  const auto o = std::make_shared<MergeOptions>();
  c->add_option("films", o->request.films, "Raw films of one image, with different samples")
      ->required();
  c->add_option("-o,--output", o->request.outputs, "Image: .exr, .png or .jpg; repeatable")
      ->allow_extra_args(false);
  c->add_option("--png", o->png, "Image for display");
  c->add_option("--raw", o->request.raw, "All of them as one raw film, to go on from");
  add_file_options(*c, o->files);
  c->add_option("--stats", o->request.stats, "Write statistics as JSON to this file");
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
