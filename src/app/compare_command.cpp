// duet compare: how far images are from their references.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/compare.h"
#include "app/compare_verdict.h"
#include "app/output.h"
#include "base/parallel.h"
#include "base/percent.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

bool is_directory(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

void print_figures(const Comparison& c) {
  const ImageMetrics& m = c.measurements.metrics;
  for (const Figure& f : figures(c.measurements)) {
    if (f.name == "ratio")
      fmt::print("{:10} {:.6f} {:.6f} {:.6f}\n", "mean ratio", m.mean_ratio[0], m.mean_ratio[1],
                 m.mean_ratio[2]);
    if (f.name == "bias" && m.bias)
      fmt::print("{:10} {:+.2f}\n", f.name, *m.bias);
    else if (f.value)
      fmt::print("{:10} {:.6g}\n", f.name, *f.value);
    else if (f.needs.starts_with("--variance") && !c.measurements.tiles)
      fmt::print("{:10} not available (no --variance)\n", f.name);
  }
  if (c.measurements.bias_test) fmt::print("{}", bias_test_text(*c.measurements.bias_test));
  if (!c.measurements.tiles) return;
  const TileComparison& t = *c.measurements.tiles;
  fmt::print(
      "tile test  {} of {} tiles differ, mean z^2 {:.2f}, least p {:.3g}, worst ratio {:.5f}\n",
      t.rejected, t.tiles, t.mean_z2, t.least_p, t.worst_ratio);
  fmt::print("mean       {:.6f} +- {:.6f} times the reference's\n", t.ratio, t.ratio_error);
  fmt::print(
      "power      a bias of {} of half the tiles, or {} of any, would have been "
      "noticed "
      "with a probability of 80 %\n",
      percent(t.visible_bias), percent(t.visible_bias_worst));
}

std::vector<std::string> texts(const std::vector<Requirement>& requirements) {
  std::vector<std::string> list;
  for (const Requirement& r : requirements) list.push_back(r.text);
  return list;
}

nlohmann::ordered_json to_json(const CompareOptions& o, const Comparison& c) {
  nlohmann::ordered_json j;
  if (!c.compared()) {
    if (!c.only_in.empty()) j["only_in"] = c.only_in;
    j["error"] = absence(o, c);
    j["verdict"] = outcome_name(c);
    return j;
  }
  const ImageMetrics& m = c.measurements.metrics;
  for (const Figure& f : figures(c.measurements))
    j[f.name] = f.value ? nlohmann::ordered_json(*f.value) : nullptr;
  if (m.bias) j["bias"] = *m.bias;
  j["mean_ratio"] = m.mean_ratio;
  if (const auto& t = c.measurements.tiles)
    j["tile_test"] = {{"p", t->p},
                      {"significance", kTileSignificance},
                      {"tile_p", t->tile_p},
                      {"z2_p", t->z2_p},
                      {"mean_p", t->mean_p},
                      {"tiles", t->tiles},
                      {"rejected", t->rejected},
                      {"mean_z2", t->mean_z2},
                      {"least_p", t->least_p},
                      {"worst_ratio", t->worst_ratio},
                      {"ratio", t->ratio},
                      {"ratio_error", t->ratio_error},
                      {"visible_bias", t->visible_bias},
                      {"visible_bias_worst", t->visible_bias_worst}};
  if (const auto& t = c.measurements.bias_test) j["bias_test"] = to_json(*t);
  if (!c.warning.empty()) j["warning"] = c.warning;
  j["missed"] = texts(c.missed);
  j["verdict"] = name_of(c.verdict);
  j["known"] = known_text(c);
  return j;
}

void print_one(const CompareOptions& o, const Comparison& c) {
  if (o.json) {
    fmt::print("{}\n", to_json(o, c).dump(2));
    return;
  }
  print_figures(c);
  for (const Requirement& r : c.missed) fmt::print("missed     {}\n", r.text);
  fmt::print("verdict    {}\n", verdict_text(c));
}

void print_all(const CompareOptions& o, const std::vector<Comparison>& all) {
  if (o.json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Comparison& c : all) {
      nlohmann::ordered_json j{{"name", c.name}};
      j.update(to_json(o, c));
      list.push_back(j);
    }
    fmt::print("{}\n", list.dump(2));
    return;
  }
  size_t width = 5, verdict_width = 7;
  for (const Comparison& c : all) {
    width = std::max(width, c.name.size());
    verdict_width = std::max(verdict_width, outcome_name(c).size());
  }
  fmt::print("{:{}}  {:{}}  relrmse   trimmed   flip      hdrflip\n", "image", width, "verdict",
             verdict_width);
  for (const Comparison& c : all) {
    const Measurements& m = c.measurements;
    fmt::print("{:{}}  {:{}}  ", c.name, width, outcome_name(c), verdict_width);
    if (!c.compared()) {
      fmt::print("{}\n", absence(o, c));
      continue;
    }
    fmt::print("{:<8.4g}  {:<8.4g}  {:<8.4g}  {:8}", m.metrics.relative_rmse,
               m.metrics.relmse_trimmed, m.flip.value_or(NAN),
               m.hdr_flip ? fmt::format("{:.4g}", *m.hdr_flip) : "-");
    if (!c.missed.empty()) fmt::print("  missed: {}", fmt::join(texts(c.missed), " "));
    fmt::print("\n");
  }
  fmt::print("{}\n", summary_of(o, all));
}

void check_writable(const char* option, const std::string& path) {
  if (path.empty()) return;
  if (const std::string why = prepare_file(path); !why.empty())
    throw UsageError(fmt::format("{}: cannot write {}: {}", option, path, why));
}

/// Finds out before comparing what would be a pity to find out afterwards.
void check_files(const CompareOptions& o) {
  const std::pair<const char*, const std::string*> pictures[] = {
      {"--diff", &o.diff}, {"--false-colour", &o.false_colour}, {"--flip-map", &o.flip_map}};
  for (const auto& [option, path] : pictures)
    if (!path->empty() && !is_display_format(*path))
      throw UsageError(
          fmt::format("{} {}: differences are written as .png or .jpg", option, *path));
  for (const auto& [option, path] : pictures) check_writable(option, *path);
  check_writable("--html", o.html);
  check_writable("--junit", o.junit);
}

void check_options(CompareOptions& o, bool directories) {
  for (const std::string& text : o.require) {
    o.requirements.push_back(parse_requirement(text));
    for (const Figure& f : figures({}))
      if (f.name == o.requirements.back().figure && !f.needs.empty() &&
          !(o.batches ? f.needs.ends_with("--batches")
                      : f.needs.starts_with("--variance") && !o.variance.empty()))
        throw UsageError(fmt::format("--require \"{}\" needs {}", text, f.needs));
  }
  if (o.batches && !o.variance.empty())
    throw UsageError("--batches tells noise from bias by itself: --variance has no use with it");
  if (o.require_complete && !directories)
    throw UsageError("--require-complete is for two directories");
  if (directories && (!o.diff.empty() || !o.false_colour.empty() || !o.flip_map.empty()))
    throw UsageError("--diff, --false-colour and --flip-map are for one image; --html shows all");
  if (directories && !o.variance.empty() && !is_directory(o.variance))
    throw UsageError("--variance: for two directories it is a directory, too");
  check_files(o);
}

int compare(CompareOptions o) {
  const bool directories = !o.batches && is_directory(o.image) && is_directory(o.reference);
  check_options(o, directories);
  std::vector<Comparison> all;
  if (directories)
    all = compare_directories(o);
  else
    all.push_back(o.batches ? compare_batches(o)
                            : compare_pair(o, o.html.empty() ? 0 : kLongestOfOne));
  if (directories)
    print_all(o, all);
  else
    print_one(o, all[0]);
  if (!o.html.empty()) write_text(o.html, compare_page(o, all));
  if (!o.junit.empty()) write_text(o.junit, junit_report(o, all));
  for (const Comparison& c : all)
    if (!c.failure.empty()) return kSceneFailed;
  for (const Comparison& c : all)
    if (!c.met(o)) return kThresholdMissed;
  if (std::none_of(all.begin(), all.end(), [](const Comparison& c) { return c.compared(); }))
    throw std::runtime_error(
        fmt::format("{} and {} have no image of the same name", o.image, o.reference));
  return kSuccess;
}

}  // namespace

void add_compare_command(CLI::App& app, int& exit_code) {
  CLI::App* c = app.add_subcommand("compare", "Compare images with references");
  const auto o = std::make_shared<CompareOptions>();
  c->add_option("image", o->image, "The image a, or a directory of images")->required();
  c->add_option("reference", o->reference,
                "The reference b, of the same size, or a directory with images of the same names")
      ->required();
  c->add_option("--variance", o->variance,
                "Variance of one sample of the reference, per pixel (or a directory of them)");
  c->add_option("--spp", o->spp, "Samples per pixel of the image (default: from its header)");
  c->add_option("--reference-spp", o->reference_spp,
                "Samples per pixel of the reference (default: from its header)");
  c->add_flag("--batches", o->batches,
              "Both operands mean several independent images (a pattern in quotes, a directory, or "
              "names with commas), whose spread tells bias from noise");
  c->add_option("--diff", o->diff,
                "Write a .png or .jpg: red where a is brighter, blue where darker");
  c->add_option("--false-colour,--false-color", o->false_colour,
                "Write a .png or .jpg: |a - b| / (b + 0.01 mean(b)) of luminances, black 0 to "
                "yellow 1");
  c->add_option("--flip-map", o->flip_map,
                "Write a .png or .jpg: FLIP, of the exposures if there is more than black");
  c->add_option(
      "--html", o->html,
      "Write a report that opens in a browser, with a viewer to toggle between the images");
  c->add_option("--junit", o->junit, "Write the outcome as JUnit XML");
  c->add_option("--require", o->require,
                "FIGURE<LIMIT or FIGURE>LIMIT; a miss exits with 3; repeatable")
      ->allow_extra_args(false);
  c->add_flag("--require-complete", o->require_complete,
              "Of two directories: a file that only one of them has exits with 3, too");
  c->add_flag("--json", o->json, "Print the figures as JSON");
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
  c->callback([o, &exit_code] {
    o->threads = hardware_threads();
    exit_code = compare(*o);
  });
}

}  // namespace duet
