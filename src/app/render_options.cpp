#include "app/render_options.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "app/commands.h"
#include "app/output.h"
#include "base/parallel.h"

namespace duet {

namespace {

constexpr int kMaxThreads = 1024;

/// A number followed by one of the given units; the whole text must be used up.
double parse_with_unit(const std::string& option, const std::string& text,
                       const std::vector<std::pair<std::string, double>>& units) {
  size_t used = 0;
  double value = 0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  const std::string unit = text.substr(used);
  for (const auto& [name, factor] : units)
    if (used > 0 && unit == name && std::isfinite(value) && value > 0) return value * factor;
  throw UsageError(fmt::format("{}: \"{}\" is not a positive amount", option, text));
}

std::vector<int> parse_integers(const std::string& option, std::string text, size_t count,
                                const char* form) {
  std::replace(text.begin(), text.end(), 'x', ',');
  std::vector<int> values;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) {
    size_t used = 0;
    try {
      values.push_back(std::stoi(part, &used));
    } catch (const std::exception&) {
      used = std::string::npos;
    }
    if (used != part.size()) values.clear(), used = 0;
    if (values.empty()) break;
  }
  if (values.size() != count)
    throw UsageError(fmt::format("{}: \"{}\" is not of the form {}", option, text, form));
  return values;
}

}  // namespace

RenderOptionParser::RenderOptionParser(CLI::App& c) {
  RenderOptions& o = options_;
  c.add_option("scene", o.scenes, "Scene files; each is rendered to an image of its own")
      ->required();
  c.add_option(
      "-o,--output", o.outputs,
      "File, directory or template with {scene} {integrator} {spp} {seed}; .exr is linear, "
      ".png and .jpg are for display. May be repeated (default: SCENE.exr here)");
  c.add_option("-i,--integrator", o.integrator.name,
               "Method instead of the scene's: path, direct, depth or aov");
  c.add_option("-I", integrator_parameters_, "NAME=VALUE of the method, such as max_depth=8");
  c.add_option("--spp", spp_, "Samples per pixel instead of the scene's");
  c.add_option("--time", time_, "Stop after this long: 90s, 10m, 2h");
  c.add_option("--target-error", target_,
               "Stop when the estimated relative RMSE falls below this: 0.01 or 1%");
  c.add_option("--size", size_, "Image size WxH instead of the scene's");
  c.add_option("--crop", crop_, "Render only the window x,y,w,h, in pixels");
  c.add_option("-s,--sensor", o.sensor, "Which of the scene's sensors, counting from 0");
  c.add_option("--seed", o.seed, "Seed of the random numbers");
  c.add_option("-t,--threads", o.threads, "Number of threads (default: all)")
      ->check(CLI::Range(1, kMaxThreads));
  c.add_option("-D", o.read.defines, "NAME=VALUE of a $parameter of the scene");
  c.add_option("-a,--path", o.read.search_paths, "Further directory to look for files");
  c.add_option(
       "--aov", layers_,
       "Further layers, separated by commas: albedo normal depth position uv shape variance "
       "samples ...")
      ->delimiter(',');
  c.add_option("--stats", o.stats_file, "Write statistics as JSON to this file");
  c.add_option("--exposure", o.exposure, "Exposure of display formats, in stops");
  c.add_flag("--strict", o.read.strict, "Every warning is an error");
  c.add_flag("--strict-sampler", o.strict_sampler,
             "Independent samples where the scene asks for them, instead of Sobol' points");
  c.add_flag("-x,--skip-existing", o.skip_existing, "Leave out scenes whose images exist");
  c.add_flag("--keep-going,!--no-keep-going", o.keep_going,
             "After a scene that fails, render the others (default)");
  c.add_flag("-q,--quiet", o.quiet, "Errors and warnings only");
  c.add_flag("-v,--verbose", o.verbose, "More messages");
  c.add_option("--progress", progress_, "auto, bar, plain or none")
      ->check(CLI::IsMember({"auto", "bar", "plain", "none"}));
  c.add_option("--log", o.log_file, "Write all messages to this file, too");
}

RenderOptions RenderOptionParser::finish() {
  RenderOptions& o = options_;
  if (spp_) {
    if (*spp_ < 1) throw UsageError(fmt::format("--spp: {} is not a number of samples", *spp_));
    o.budget.spp = *spp_;
  }
  if (!time_.empty())
    o.budget.seconds =
        parse_with_unit("--time", time_, {{"", 1}, {"s", 1}, {"m", 60}, {"h", 3600}});
  if (!target_.empty())
    o.budget.target_error = parse_with_unit("--target-error", target_, {{"", 1}, {"%", 0.01}});
  if (!size_.empty()) {
    const auto v = parse_integers("--size", size_, 2, "WxH");
    if (v[0] < 1 || v[1] < 1 || v[0] > kMaxImageSide || v[1] > kMaxImageSide)
      throw UsageError(fmt::format("--size: {} is not a size from 1x1 to {}x{}", size_,
                                   kMaxImageSide, kMaxImageSide));
    o.size = Point2i{v[0], v[1]};
  }
  if (!crop_.empty()) {
    const auto v = parse_integers("--crop", crop_, 4, "x,y,w,h");
    if (v[0] < 0 || v[1] < 0 || v[2] < 1 || v[3] < 1 || v[0] > kMaxImageSide ||
        v[1] > kMaxImageSide || v[2] > kMaxImageSide || v[3] > kMaxImageSide)
      throw UsageError(fmt::format("--crop: {} is not a window", crop_));
    o.crop = PixelBounds{v[0], v[1], v[0] + v[2], v[1] + v[3]};
  }
  for (const std::string& p : integrator_parameters_) {
    const size_t equals = p.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError(fmt::format("-I needs NAME=VALUE, not \"{}\"", p));
    o.integrator.parameters.emplace_back(p.substr(0, equals), p.substr(equals + 1));
  }
  o.integrator.layers = layers_;
  o.progress = progress_ == "bar"     ? ProgressStyle::bar
               : progress_ == "plain" ? ProgressStyle::plain
               : progress_ == "none"  ? ProgressStyle::none
                                      : ProgressStyle::automatic;
  if (o.threads == 0) o.threads = hardware_threads();
  if (o.scenes.size() > 1)
    for (const std::string& output : o.outputs)
      if (is_fixed_file(output))
        throw UsageError(fmt::format(
            "-o {}: several scenes cannot be written to one file; use a directory or {{scene}}",
            output));
  return std::move(options_);
}

}  // namespace duet
