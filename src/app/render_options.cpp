#include "app/render_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>

#include "app/arguments.h"
#include "app/commands.h"
#include "app/file_options.h"
#include "app/program.h"
#include "app/read_options.h"
#include "app/viewer_option.h"
#include "base/parallel.h"
#include "evaluate/render/asked.h"
#include "evaluate/render/assignment.h"
#include "evaluate/render/output.h"
#include "evaluate/render/output_checks.h"
#include "evaluate/render/scene_method.h"
#include "evaluate/report/render_limits.h"

namespace duet {

namespace {

std::string integrator_help() {
  std::string text = "Method instead of the scene's";
  for (const IntegratorName& n : integrator_names())
    text += fmt::format("{}{} ({})", &n == &integrator_names()[0] ? ": " : ", ", n.name, n.summary);
  return text;
}

std::string layer_help() {
  return fmt::format("Further layers of the EXR, separated by commas: {}",
                     fmt::join(layer_names(), " "));
}

}  // namespace

RenderOptionParser::RenderOptionParser(CLI::App& c, Program& program) : program_(program) {
  add_read_options(c, options_.read);
  add_method_options(c);
  add_image_options(c);
  add_raw_options(c);
  add_output_options(c);
}

void RenderOptionParser::add_method_options(CLI::App& c) {
  c.option_defaults()->group("Method and when to stop");
  c.add_option("-i,--integrator", options_.integrator.name, integrator_help());
  c.add_option("-I,--parameter", integrator_parameters_,
               "NAME=VALUE of the method, such as max_depth=8; repeatable")
      ->allow_extra_args(false);
  c.add_option("--spp", spp_, "Stop at this many samples per pixel (default: the scene's)");
  c.add_option("--time", time_, "Stop after this long: 90s, 10m, 2h");
  c.add_option("--target-error", target_,
               "Stop when the relative standard error of the image falls below this: 0.01 or 1%; "
               "noisy parts get more samples");
  c.add_flag("--require-target", options_.require_target,
             "Exit with 4 if --target-error is not met when time or samples are used up");
  c.add_option(
       "--light-selection", light_selection_,
       "By what light samples choose a light: auto, bvh (a tree: near ones first), power or "
       "uniform; the same as -I light_selection=NAME")
      ->check(CLI::IsMember(std::vector<std::string>(std::begin(kLightSelectionNames),
                                                     std::end(kLightSelectionNames))));
  c.add_option("--seed", seed_, "Seed of the random numbers");
  c.add_flag("--strict-sampler", options_.strict_sampler,
             "The sampler that the scene names, instead of Duet's Sobol' points");
  c.add_option("-t,--threads", threads_, "Number of threads (default: all)");
}

void RenderOptionParser::add_image_options(CLI::App& c) {
  c.option_defaults()->group("Image");
  c.add_option("-s,--sensor", sensor_, "Which of the scene's sensors, counting from 0");
  c.add_option("--size", size_, "Image size WxH instead of the scene's, without its crop window");
  c.add_option("--crop", crop_, "Render only the window x,y,w,h, in pixels");
  c.add_option("--aov", layers_, layer_help())->delimiter(',')->allow_extra_args(false);
  c.add_option("--cryptomatte", mattes_,
               "Mattes of things as layers of the EXR (Cryptomatte), separated by commas: object, "
               "material")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(
          CLI::IsMember(std::vector<std::string>(std::begin(kMatteKinds), std::end(kMatteKinds))));
  c.add_option("--techniques", techniques_,
               "One layer per technique: its part of the image, or with --techniques=raw without "
               "weights; EXR only")
      ->expected(0, 1)
      ->default_str("weighted")
      ->check(CLI::IsMember({"weighted", "raw"}));
  c.add_flag(
      "--denoise", options_.denoise,
      "Write NAME.denoised.exr, too: the image without most of its noise, but biased, by Open "
      "Image Denoise if that is found (DUET_OIDN_LIBRARY)");
  add_file_options(c, files_);
}

void RenderOptionParser::add_output_options(CLI::App& c) {
  RenderCommandLine& o = options_;
  c.option_defaults()->group("Output");
  c.add_option("-o,--output", o.outputs,
               "File, directory or template with {scene} {folder} {integrator} {spp} {seed}; - is "
               "standard output; .exr is linear and holds all layers, .png and .jpg are for "
               "display; directories are made; repeatable (default: {scene}.exr here)")
      ->allow_extra_args(false);
  c.add_option("--format", format_,
               "exr, png or jpg, where -o does not say it: in a directory, on standard output, by "
               "default (exr)")
      ->check(CLI::IsMember({"exr", "png", "jpg"}));
  c.add_flag("-x,--skip-existing", o.skip_existing,
             "Leave out scenes whose images exist, complete and made with the same settings");
  c.add_flag("--keep-partial-name", o.keep_partial_name,
             "After an interrupt write NAME.exr, not NAME.partial.exr");
  c.add_flag("--keep-going,!--no-keep-going", o.keep_going,
             "After a scene that fails, render the others (default)");
  c.add_option("--stats", o.stats_file, "Write statistics as JSON to this file");
  c.option_defaults()->group("Messages");
  CLI::Option* quiet = c.add_flag("-q,--quiet", o.quiet, "Errors and warnings only");
  c.add_flag("-v,--verbose", o.verbose, "More messages")->excludes(quiet);
  c.add_option("--progress", progress_, "auto, bar, plain or none")
      ->check(CLI::IsMember({"auto", "bar", "plain", "none"}));
  c.add_option("--display", viewer_,
               "Show the image as it grows in a viewer: tev, tev://HOST or tev://HOST:PORT "
               "(default: 127.0.0.1:14158)");
  c.add_flag("--live", live_, "Serve a page of this machine that shows the image as it grows");
  c.add_option("--live-port", live_port_, "Its port, from 1 to 65535 (default: any that is free)");
  c.add_option("--log", o.log_file, "Write all messages to this file, too");
}

void RenderOptionParser::add_raw_options(CLI::App& c) {
  RenderOptions& o = options_;
  c.option_defaults()->group("Parts of a render (docs/batch.md)");
  c.add_option("--raw", o.raw,
               "Write the exact sums of the samples to this .exr file (a template as for -o), for "
               "`duet merge` and --resume; without -o no image is written");
  c.add_option("--samples", samples_, "Take only the samples A:B of each pixel, from A to B - 1");
  c.add_option("--slice", slice_, "Take only part K/N of the samples, counting from 1");
  c.add_option("--resume", o.resume, "Go on from this raw film: take the samples that it lacks");
  c.add_option("--checkpoint", checkpoint_,
               "Write the raw film this often (60s, 10m) and when interrupted, to --raw or beside "
               "the image as NAME.checkpoint.exr; the same command goes on from it");
}

void RenderOptionParser::finish_raw() {
  RenderOptions& o = options_;
  o.writes_images = o.raw.empty() || !o.outputs.empty();
  read(checkpoint_, [&] { o.checkpoint = parse_seconds("--checkpoint", checkpoint_); });
  read(samples_, [&] {
    const auto v = parse_integers("--samples", samples_, ':', 2, "A:B");
    if (v[0] < 0 || v[1] <= v[0] || v[1] > kMaxSpp)
      throw UsageError(fmt::format("--samples {}: there are no such samples", samples_));
    o.samples = {uint32_t(v[0]), uint32_t(v[1])};
  });
  read(slice_, [&] {
    const auto v = parse_integers("--slice", slice_, '/', 2, "K/N");
    if (v[0] < 1 || v[1] < v[0])
      throw UsageError(fmt::format("--slice {}: the parts are 1/{} to {}/{}", slice_,
                                   std::max(v[1], 1), std::max(v[1], 1), std::max(v[1], 1)));
    o.slice = {uint32_t(v[0]), uint32_t(v[1])};
    if (o.budget.spp) asked_samples(o, *o.budget.spp);
  });
}

void RenderOptionParser::finish_numbers() {
  RenderBudget& budget = options_.budget;
  read(spp_, [&] { budget.spp = int(parse_whole("--spp", spp_, 1, kMaxSpp)); });
  read(time_, [&] { budget.seconds = parse_seconds("--time", time_); });
  read(target_, [&] {
    budget.target_error = parse_amount("--target-error", target_, {{"", 1}, {"%", 0.01}}, 1e-6, 1);
  });
  checks_.run([&] { options_.files = parse_file_settings(files_); });
  options_.threads = program_.threads();
  read(threads_, [&] {
    const int wanted = int(parse_whole("--threads", threads_, 1, kMaxThreads));
    options_.threads = startable_threads(wanted);
    if (options_.threads < wanted)
      program_.log.warning("only {} of {} threads can be started", options_.threads, wanted);
  });
  read(seed_, [&] {
    options_.seed = parse_whole("--seed", seed_, 0, std::numeric_limits<uint64_t>::max());
  });
  read(sensor_, [&] {
    options_.sensor = parse_whole("--sensor", sensor_, 0, std::numeric_limits<uint32_t>::max());
  });
}

void RenderOptionParser::finish_window() {
  read(size_, [&] { options_.size = parse_size("--size", size_, 1); });
  read(crop_, [&] {
    const auto v = parse_integers("--crop", crop_, ',', 4, "x,y,w,h");
    if (v[0] < 0 || v[1] < 0 || v[2] < 1 || v[3] < 1 || v[0] > kMaxImageSide ||
        v[1] > kMaxImageSide || v[2] > kMaxImageSide || v[3] > kMaxImageSide)
      throw UsageError(fmt::format("--crop: {} is not a window", crop_));
    options_.crop = PixelBounds{v[0], v[1], v[0] + v[2], v[1] + v[3]};
    check_window(options_);
  });
}

void RenderOptionParser::finish_format() {
  if (format_.empty()) return;
  options_.extension = "." + format_;
  for (const std::string& pattern : options_.outputs)
    if (const std::string named = image_format(pattern); !named.empty() && named != format_)
      throw UsageError(fmt::format("-o {}: --format {} asks for another one", pattern, format_));
}

void RenderOptionParser::finish_live() {
  if (live_) options_.live_port = 0;
  if (live_port_.empty()) return;
  if (!live_) throw UsageError("--live-port: there is no --live");
  options_.live_port =
      uint16_t(parse_whole("--live-port", live_port_, 1, std::numeric_limits<uint16_t>::max()));
}

void RenderOptionParser::finish_method() {
  RenderCommandLine& o = options_;
  if (!o.integrator.name.empty()) o.read.methods = {o.integrator.name};
  for (const std::string& p : integrator_parameters_)
    checks_.run([&] { o.integrator.parameters.push_back(parse_assignment("-I", p)); });
  for (const std::string& define : o.read.defines)
    checks_.run([&] { parse_assignment("-D", define); });
  if (!light_selection_.empty())
    o.integrator.parameters.emplace_back("light_selection", light_selection_);
  o.integrator.layers = layers_;
  o.mattes = matte_kinds(mattes_);
  if (!techniques_.empty())
    o.techniques = techniques_ == "raw" ? TechniqueOutput::raw : TechniqueOutput::weighted;
}

void RenderOptionParser::finish_uses() {
  RenderCommandLine& o = options_;
  for (const std::string& scene : o.read.scenes) o.uses.read("the scene", scene);
  o.uses.read(kResume, o.resume);
  o.uses.write("--stats", o.stats_file);
  o.uses.write("--log", o.log_file);
}

RenderCommandLine RenderOptionParser::finish() {
  RenderCommandLine& o = options_;
  finish_numbers();
  finish_window();
  finish_method();
  o.progress = progress_style(progress_);
  read(viewer_, [&] { o.viewer = parse_viewer(viewer_); });
  checks_.run([&] { finish_live(); });
  checks_.run([&] { finish_format(); });
  finish_raw();
  // What depends on several options is known once each makes sense.
  checks_.finish();
  if (o.require_target && !o.budget.target_error)
    throw UsageError("--require-target: there is no --target-error");
  checks_.run([&] { check_parts(o); });
  finish_uses();
  std::vector<std::string> images;
  checks_.run([&] { images = check_outputs(o, o.uses); });
  checks_.run([&] { check_method(o, images); });
  checks_.run([&] { check_writable("--stats", o.stats_file); });
  checks_.finish();
  return std::move(options_);
}

}  // namespace duet
