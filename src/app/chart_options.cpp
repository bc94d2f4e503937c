#include "app/chart_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <set>

#include "app/arguments.h"
#include "app/commands.h"
#include "app/read_options.h"
#include "base/parallel.h"
#include "evaluate/render/assignment.h"
#include "evaluate/render/output.h"
#include "evaluate/render/scene_operand.h"

namespace duet {

namespace {

/// One value stands for all scenes if it has placeholders or if there is one scene.
void check_count(const char* option, const std::vector<std::string>& given, size_t scenes) {
  const bool template_of_all = given.size() == 1 && given[0].find('{') != std::string::npos;
  if (!given.empty() && !template_of_all && given.size() != scenes)
    throw UsageError(fmt::format(
        "{} was given {} times for {} scene{}: give it once for each, or once with {{scene}} or "
        "{{folder}}",
        option, given.size(), scenes, scenes == 1 ? "" : "s"));
}

void check_names(const ChartOptions& o) {
  std::set<std::string> names;
  for (const ChartMethod& m : o.methods)
    if (!names.insert(m.name).second)
      throw UsageError(fmt::format("-i: \"{}\" was given twice", m.name));
  for (const auto& [name, command] : o.external)
    if (!names.insert(name).second)
      throw UsageError(fmt::format("--external: there are two lines called \"{}\"", name));
}

}  // namespace

std::vector<ChartMethod> parse_methods(const std::string& text) {
  std::vector<ChartMethod> methods;
  for (size_t from = 0; from <= text.size();) {
    const size_t to = std::min(text.find(',', from), text.size());
    std::string part = text.substr(from, to - from);
    from = to + 1;
    const size_t colon = part.find(':');
    if (colon == std::string::npos && part.find('=') != std::string::npos) {
      if (methods.empty() || methods.back().name.find(':') == std::string::npos)
        throw UsageError(fmt::format(
            "-i {}: \"{}\" is a parameter of no method; write METHOD:NAME=VALUE", text, part));
      methods.back().name += "," + part;
      methods.back().integrator.parameters.push_back(parse_assignment("-i", part));
      continue;
    }
    ChartMethod m;
    m.name = part;
    m.integrator.name = part.substr(0, colon);
    if (m.integrator.name.empty())
      throw UsageError(fmt::format("-i {}: the name of a method is missing", text));
    if (colon != std::string::npos)
      m.integrator.parameters.push_back(parse_assignment("-i", part.substr(colon + 1)));
    methods.push_back(std::move(m));
  }
  return methods;
}

std::vector<std::string> chart_names(const std::vector<std::string>& scene_files) {
  std::vector<std::string> names;
  for (const std::string& file : scene_files) {
    names.push_back(output_names(file).scene);
    if (std::count(names.begin(), names.end(), names.back()) > 1)
      throw UsageError(fmt::format("there are two scenes called \"{}\"", names.back()));
  }
  return names;
}

ChartOptionParser::ChartOptionParser(CLI::App& c) {
  ChartOptions& o = options_;
  add_read_options(c, o.read);
  c.add_option("-o,--output", o.directory,
               "Directory for chart.csv, chart.svg, chart-spp.svg and index.html; it is made if "
               "there is none (default: chart)");
  c.add_option("-i,--integrator", methods_,
               "Methods with commas between them, each with its parameters after a colon, as in "
               "path,vcm:radius=0.01,alpha=0.7; repeatable (default: path,bdpt,vcm)")
      ->allow_extra_args(false);
  c.add_option("-I,--parameter", parameters_,
               "NAME=VALUE for all methods, such as max_depth=8; repeatable")
      ->allow_extra_args(false);
  c.add_option("--time", time_,
               "Time for each scene, which its methods share equally: 90s, 10m, 2h (default: 60s)");
  c.add_option("--reference", o.references,
               "The image that is right; once for each scene, or once with {scene} or {folder}; "
               "without it, one is made in half the time")
      ->allow_extra_args(false);
  c.add_option("--variance", o.variances,
               "Variance of one sample of the reference, per pixel, to be subtracted from the "
               "errors; given as --reference is")
      ->allow_extra_args(false);
  c.add_option("--reference-spp", reference_spp_,
               "Samples per pixel of the reference (default: from its header)");
  c.add_option("--reference-integrator", o.reference_integrator,
               "Method for a reference that has to be made (default: bdpt if it is among those "
               "compared, else the first without bias)");
  c.add_option(
       "--external", external_,
       "NAME=COMMAND of another renderer, with {spp} {out} and, if it likes, {scene} {seed} "
       "{width} {height}; run for 1, 2, 4, … spp and timed as a whole; repeatable")
      ->allow_extra_args(false);
  c.add_option("--size", size_, "Image size WxH (default: the reference's, or the scene's)");
  c.add_option("-s,--sensor", sensor_, "Which of the scene's sensors, counting from 0");
  c.add_option("--seed", seed_,
               "Seed of the random numbers, another than that of the reference (default: 1000)");
  c.add_option("-t,--threads", threads_, "Number of threads (default: all)");
  c.add_flag("-q,--quiet", o.quiet, "Errors and warnings only");
}

ChartOptions ChartOptionParser::finish(int threads) {
  ChartOptions& o = options_;
  if (methods_.empty() && external_.empty()) methods_ = {"path,bdpt,vcm"};
  for (const std::string& text : methods_)
    for (ChartMethod& m : parse_methods(text)) o.methods.push_back(std::move(m));
  for (const ChartMethod& m : o.methods) o.read.methods.push_back(m.integrator.name);
  for (ChartMethod& m : o.methods)
    for (size_t i = 0; i < parameters_.size(); ++i)
      m.integrator.parameters.insert(m.integrator.parameters.begin() + std::ptrdiff_t(i),
                                     parse_assignment("-I", parameters_[i]));
  for (const std::string& text : external_) {
    o.external.push_back(parse_assignment("--external", text));
    for (const char* needed : {"{spp}", "{out}"})
      if (o.external.back().second.find(needed) == std::string::npos)
        throw UsageError(fmt::format("--external {}: the command needs {}", text, needed));
    if (std::count(o.read.scenes.begin(), o.read.scenes.end(), kStandardInput) > 0)
      throw UsageError(fmt::format("--external {}: a scene from standard input is no file", text));
  }
  check_names(o);
  if (!time_.empty()) o.seconds = parse_seconds("--time", time_);
  if (!reference_spp_.empty())
    o.reference_spp = parse_amount("--reference-spp", reference_spp_, {{"", 1}}, 1e-3, 1e15);
  if (!size_.empty()) o.size = parse_size("--size", size_, 8);
  if (!sensor_.empty())
    o.sensor = parse_whole("--sensor", sensor_, 0, std::numeric_limits<uint32_t>::max());
  if (!seed_.empty())
    o.seed = parse_whole("--seed", seed_, 0, std::numeric_limits<uint64_t>::max());
  o.threads = threads_.empty() ? threads : int(parse_whole("--threads", threads_, 1, kMaxThreads));
  check_count("--reference", o.references, o.read.scenes.size());
  check_count("--variance", o.variances, o.read.scenes.size());
  if (!o.variances.empty() && o.references.empty())
    throw UsageError("--variance is that of a --reference");
  return std::move(options_);
}

}  // namespace duet
