// duet compare: how far images are from their references.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/compare_options.h"
#include "app/program.h"
#include "base/system/atomic_file.h"
#include "evaluate/compare/json.h"
#include "evaluate/compare/text.h"

namespace duet {

namespace {

void print(const CompareOptions& o, const std::vector<Comparison>& all) {
  if (o.json)
    fmt::print("{}\n", (o.directories ? comparisons_json(o.settings, all)
                                      : comparison_json(o.settings, all[0]))
                           .dump(2));
  else
    fmt::print("{}", o.directories ? table_text(o.settings, all) : comparison_text(all[0]));
}

/// What is said about a comparison as soon as it has been made.
void warn(const CompareOptions& o, const std::string& path, const Comparison& c, Log& log) {
  if (!c.only_in.empty()) log.warning("{}: {}", c.name, absence(o.settings, c));
  if (!c.warning.empty()) log.warning("{}: {}", path, c.warning);
}

std::vector<Comparison> compare_all(const CompareOptions& o, Log& log) {
  const CompareSettings& settings = o.settings;
  if (o.directories)
    return compare_directories(settings, [&](const Comparison& c) {
      warn(o, (std::filesystem::path(settings.image) / c.name).string(), c, log);
    });
  std::vector<std::string> images, references;
  if (o.batches) {
    images = set_of_images(settings.image, "image", log);
    references = set_of_images(settings.reference, "reference", log);
  }
  std::vector<Comparison> one;
  one.push_back(o.batches ? compare_sets(settings, images, references) : compare_pair(settings));
  warn(o, settings.image, one[0], log);
  return one;
}

int exit_code_of(const CompareSettings& settings, const std::vector<Comparison>& all) {
  for (const Comparison& c : all)
    if (!c.failure.empty()) return kSceneFailed;
  for (const Comparison& c : all)
    if (!c.met(settings)) return kThresholdMissed;
  if (std::none_of(all.begin(), all.end(), [](const Comparison& c) { return c.compared(); }))
    throw std::runtime_error(fmt::format("{} and {} have no image of the same name", settings.image,
                                         settings.reference));
  return kSuccess;
}

int compare(const CompareOptions& o, Program& program) {
  std::vector<Comparison> all;
  try {
    all = compare_all(o, program.log);
  } catch (const UnknownSamples& e) {
    throw UsageError(fmt::format(
        "--variance also needs {}: the header of {} does not say how many samples it has",
        e.of() == UnknownSamples::Of::image ? "--spp" : "--reference-spp", e.path()));
  }
  print(o, all);
  if (!o.html.empty())
    write_file_atomically(o.html, compare_page(o.settings, all, program.command_line));
  if (!o.junit.empty()) write_file_atomically(o.junit, junit_report(o.settings, all));
  return exit_code_of(o.settings, all);
}

}  // namespace

void add_compare_command(CLI::App& app, Program& program) {
  CLI::App* c = app.add_subcommand("compare", "Compare images with references");
  const auto parser = std::make_shared<CompareOptionParser>(*c);
  c->footer(
      figures_help() +
      "Of two directories, a file that only one of them has is a row with the verdict MISSING. One "
      "without an image misses every --require; one without a reference is only counted. With "
      "--require-complete both are failures.\n"
      "Exit codes: 0, also without --require whatever the verdict; 1 an image cannot be read, the "
      "sizes differ, or two directories have no name in common; 2 wrong usage; 3 a --require or "
      "--require-complete is missed.\n"
      "Examples:\n"
      "  duet compare a.exr mean.exr --variance variance.exr --require 'relrmse<0.05' --require "
      "'p>0.01'\n"
      "  duet compare a.png b.png --require 'flip<0.05' --flip-map flip.png\n"
      "  duet compare renders/ references/ --html report.html --junit report.xml --require "
      "'trimmed<0.01'\n"
      "  duet compare --batches 'a-*.exr' 'b-*.exr' --require 'relrmse<0.05'");
  c->callback([parser, &program] {
    program.exit_code = compare(parser->finish(program.threads()), program);
  });
}

}  // namespace duet
