#include "app/compare_options.h"

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <limits>

#include "app/arguments.h"
#include "app/commands.h"
#include "base/diagnostics.h"
#include "base/log.h"
#include "evaluate/render/output_checks.h"
#include "evaluate/report/image_file.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

bool is_directory_of_images(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

std::optional<double> samples(const std::string& option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  return parse_amount(option, text, {{"", 1}}, 1e-3, 1e15);
}

}  // namespace

Requirement parse_requirement(const std::string& text) {
  const size_t at = text.find_first_of("<>");
  if (at == std::string::npos || at == 0)
    throw UsageError(fmt::format("--require \"{}\" is not like rmse<0.02", text));
  Requirement r;
  r.text = text;
  r.figure = text.substr(0, at);
  r.less = text[at] == '<';
  r.limit = parse_amount("--require " + text, text.substr(at + 1), {{"", 1}},
                         -std::numeric_limits<double>::max(), std::numeric_limits<double>::max());
  std::vector<std::string> known;
  for (const Figure& f : figures({})) known.push_back(f.name);
  if (std::find(known.begin(), known.end(), r.figure) == known.end())
    throw UsageError(fmt::format("--require: there is no figure \"{}\"{}; there are {}", r.figure,
                                 did_you_mean(r.figure, known), fmt::join(known, " ")));
  return r;
}

CompareOptionParser::CompareOptionParser(CLI::App& c) {
  CompareOptions& o = options_;
  CompareSettings& s = o.settings;
  c.add_option("image", s.image, "The image a, or a directory of images")->required();
  c.add_option("reference", s.reference,
               "The reference b, of the same size, or a directory with images of the same names")
      ->required();
  c.add_option("--variance", s.variance,
               "Variance of one sample of the reference, per pixel (or a directory of them)");
  c.add_option("--spp", spp_, "Samples per pixel of the image (default: from its header)");
  c.add_option("--reference-spp", reference_spp_,
               "Samples per pixel of the reference (default: from its header)");
  c.add_flag("--batches", o.batches,
             "Both operands mean several independent images (a pattern in quotes, a directory, or "
             "names with commas), whose spread tells bias from noise");
  add_outputs(c);
  c.add_option("--require", require_,
               "FIGURE<LIMIT or FIGURE>LIMIT; a miss exits with 3; repeatable")
      ->allow_extra_args(false);
  c.add_flag("--require-complete", s.require_complete,
             "Of two directories: a file that only one of them has exits with 3, too");
  c.add_flag("--json", o.json, "Print the figures as JSON");
}

void CompareOptionParser::add_outputs(CLI::App& c) {
  DifferencePaths& d = options_.settings.differences;
  c.add_option("--diff", d.diff,
               "Write a .png or .jpg: red where a is brighter, blue where darker");
  c.add_option("--false-colour,--false-color", d.false_colour,
               "Write a .png or .jpg: |a - b| / (b + 0.01 mean(b)) of luminances, black 0 to "
               "yellow 1");
  c.add_option("--flip-map", d.flip_map,
               "Write a .png or .jpg: FLIP, of the exposures if there is more than black");
  c.add_option(
      "--html", options_.html,
      "Write a report that opens in a browser, with a viewer to toggle between the images");
  c.add_option("--junit", options_.junit, "Write the outcome as JUnit XML");
}

/// Finds out before comparing what would be a pity to find out afterwards.
void CompareOptionParser::check_files() const {
  const DifferencePaths& d = options_.settings.differences;
  const std::pair<const char*, const std::string*> pictures[] = {
      {"--diff", &d.diff}, {"--false-colour", &d.false_colour}, {"--flip-map", &d.flip_map}};
  for (const auto& [option, path] : pictures)
    if (!path->empty() && !is_display_format(*path))
      throw UsageError(
          fmt::format("{} {}: differences are written as .png or .jpg", option, *path));
  FileUses uses = read_files();
  for (const auto& [option, path] : pictures) uses.write(option, *path);
  uses.write("--html", options_.html);
  uses.write("--junit", options_.junit);
  for (const auto& [option, path] : pictures) check_writable(option, *path);
  check_writable("--html", options_.html);
  check_writable("--junit", options_.junit);
}

FileUses CompareOptionParser::read_files() const {
  const CompareSettings& s = options_.settings;
  FileUses uses;
  const auto read = [&](const char* use, const std::string& operand) {
    for (const std::string& path :
         options_.batches ? images_of_set(operand) : std::vector<std::string>{operand})
      uses.read(use, path);
  };
  read("the image", s.image);
  read("the reference", s.reference);
  uses.read("--variance", s.variance);
  return uses;
}

/// A figure that needs another option cannot be required without it.
void CompareOptionParser::check_available(const Requirement& required) const {
  const CompareOptions& o = options_;
  for (const Figure& f : figures({}))
    if (f.name == required.figure && !f.needs.empty() &&
        !(o.batches ? f.needs.ends_with("--batches")
                    : f.needs.starts_with("--variance") && !o.settings.variance.empty()))
      throw UsageError(fmt::format("--require \"{}\" needs {}", required.text, f.needs));
}

void CompareOptionParser::check() const {
  const CompareOptions& o = options_;
  const CompareSettings& s = o.settings;
  const DifferencePaths& d = s.differences;
  if (o.batches && !s.variance.empty())
    throw UsageError("--batches tells noise from bias by itself: --variance has no use with it");
  if (s.require_complete && !o.directories)
    throw UsageError("--require-complete is for two directories");
  if (o.directories && (!d.diff.empty() || !d.false_colour.empty() || !d.flip_map.empty()))
    throw UsageError("--diff, --false-colour and --flip-map are for one image; --html shows all");
  if (o.directories && !s.variance.empty() && !is_directory_of_images(s.variance))
    throw UsageError("--variance: for two directories it is a directory, too");
  check_files();
}

CompareOptions CompareOptionParser::finish(int threads) {
  CompareOptions& o = options_;
  CompareSettings& s = o.settings;
  o.directories =
      !o.batches && is_directory_of_images(s.image) && is_directory_of_images(s.reference);
  for (const std::string& text : require_) {
    s.requirements.push_back(parse_requirement(text));
    check_available(s.requirements.back());
  }
  check();
  // Without a variance nobody asks for the samples.
  if (!s.variance.empty()) {
    s.spp = samples("--spp", spp_);
    s.reference_spp = samples("--reference-spp", reference_spp_);
  }
  s.for_page = !o.html.empty();
  s.threads = threads;
  return std::move(options_);
}

}  // namespace duet
