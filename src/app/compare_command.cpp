// duet compare: how far an image is from a reference.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/arguments.h"
#include "app/commands.h"
#include "app/output.h"
#include "image/image_io.h"
#include "image/metrics.h"

namespace duet {

namespace {

struct CompareOptions {
  std::string image, reference, variance, diff;
  std::string spp, reference_spp;
  std::vector<std::string> require;
  bool json = false;
};

enum class Verdict { pass, noisy, biased, fail };

const char* name_of(Verdict v) {
  switch (v) {
    case Verdict::pass:
      return "PASS";
    case Verdict::noisy:
      return "NOISY";
    case Verdict::biased:
      return "BIASED";
    case Verdict::fail:
      return "FAIL";
  }
  return "";
}

/// A number that --require can test.
struct Figure {
  std::string name;
  std::optional<double> value;
  std::string formula;
};

std::vector<Figure> figures(const ImageMetrics& m) {
  double ratio = 0;
  for (const double r : m.mean_ratio) ratio = std::max(ratio, std::abs(r - 1));
  return {
      {"rmse", m.rmse, "square root of the mean of (a - b)^2"},
      {"relrmse", m.relative_rmse, "rmse / mean(b)"},
      {"relmse", m.relmse, "mean of (a - b)^2 / (b^2 + 0.01)"},
      {"trimmed", m.relmse_trimmed, "relmse without the worst 0.1 % of the pixels"},
      {"mae", m.mae, "mean of |a - b|"},
      {"ratio", ratio, "largest |mean(a) / mean(b) - 1| of the channels"},
      {"bias", m.bias ? std::optional(std::abs(*m.bias)) : std::nullopt,
       "|mean(a) - mean(b)| in standard errors, worst channel; needs --variance"},
      {"z", m.z_share,
       "share of values that noise explains at significance 0.01 (Sidak); needs --variance"},
      {"zrms", m.z_rms, "root mean square of (a - b) / standard error; needs --variance"},
      {"nan", double(m.nan_pixels), "pixels with a NaN"},
      {"infinite", double(m.infinite_pixels), "pixels with an infinity"},
      {"negative", double(m.negative_pixels), "pixels with a negative value"},
  };
}

/// One --require, such as "rmse<0.02".
struct Requirement {
  std::string text, figure;
  bool less = true;
  double limit = 0;
};

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

/// The image in linear values; `file` keeps the rest of what was read.
Image load(const std::string& path, ImageFile& file) {
  file = read_image(path);
  Image image = std::move(file.image);
  if (!file.display_encoded) return image;
  if (!file.bytes.empty()) {
    image.data.resize(file.bytes.size());
    for (size_t i = 0; i < file.bytes.size(); ++i) image.data[i] = float(file.bytes[i]) / 255;
  }
  for (float& v : image.data) v = srgb_to_linear(v);
  return image;
}

/// The samples per pixel that the option says, or the header of the image.
double samples_of(const std::string& path, const ImageFile& file, const std::string& option,
                  const std::string& given) {
  if (!given.empty()) return parse_amount(option, given, {{"", 1}}, 1e-3, 1e15);
  for (const auto& [name, value] : file.header)
    if (const double spp = std::atof(value.c_str()); name == "spp" && spp > 0) return spp;
  throw UsageError(
      fmt::format("--variance also needs {}: the header of {} does not say how many samples it has",
                  option, path));
}

/// Whether a figure tells a bias from noise.
bool shows_bias(const std::string& figure) {
  return figure == "bias" || figure == "z" || figure == "zrms";
}

Verdict judge(const ImageMetrics& m, const std::vector<Requirement>& missed) {
  if (m.nan_pixels > 0 || m.infinite_pixels > 0) return Verdict::fail;
  if ((m.z_share && *m.z_share < kRequiredZShare) || (m.bias && std::abs(*m.bias) > kNotableBias))
    return Verdict::biased;
  for (const Requirement& r : missed)
    if (shows_bias(r.figure)) return Verdict::biased;
  return missed.empty() ? Verdict::pass : Verdict::noisy;
}

/// A reference with holes would let everything pass there.
void check_reference(const Image& image, const std::string& path) {
  for (const char* name : {"R", "G", "B", "Y"}) {
    const int channel = image.find_channel(name);
    if (channel < 0) continue;
    for (size_t i = size_t(channel); i < image.data.size(); i += image.channels.size())
      if (!std::isfinite(image.data[i]))
        throw std::runtime_error(fmt::format("{} has values that are not finite", path));
  }
}

void print_figures(const ImageMetrics& m) {
  for (const Figure& f : figures(m)) {
    if (f.name == "ratio")
      fmt::print("{:10} {:.6f} {:.6f} {:.6f}\n", "mean ratio", m.mean_ratio[0], m.mean_ratio[1],
                 m.mean_ratio[2]);
    if (f.name == "bias" && m.bias)
      fmt::print("{:10} {:+.2f}\n", f.name, *m.bias);
    else if (f.value)
      fmt::print("{:10} {:.6g}\n", f.name, *f.value);
    else
      fmt::print("{:10} not available (no --variance)\n", f.name);
  }
}

nlohmann::ordered_json to_json(const ImageMetrics& m) {
  nlohmann::ordered_json j;
  for (const Figure& f : figures(m))
    j[f.name] = f.value ? nlohmann::ordered_json(*f.value) : nullptr;
  if (m.bias) j["bias"] = *m.bias;
  j["mean_ratio"] = m.mean_ratio;
  return j;
}

/// Full colour at half the mean of the reference.
void write_difference(const std::string& path, const Image& image, const Image& reference,
                      const ImageMetrics& m) {
  const double mean = m.relative_rmse > 0 ? m.rmse / m.relative_rmse : 1;
  write_display_image(path, image.width, image.height, 3,
                      difference_image(image, reference, 0.5 * mean));
}

int compare(const CompareOptions& o) {
  std::vector<Requirement> requirements;
  for (const std::string& text : o.require) {
    requirements.push_back(parse_requirement(text));
    if (o.variance.empty() && shows_bias(requirements.back().figure))
      throw UsageError(fmt::format("--require \"{}\" needs --variance", text));
  }
  if (!o.diff.empty()) {
    if (!is_display_format(o.diff))
      throw UsageError(fmt::format("--diff {}: differences are written as .png or .jpg", o.diff));
    if (const std::string why = unwritable_reason(o.diff); !why.empty())
      throw UsageError(fmt::format("--diff: cannot write {}: {}", o.diff, why));
  }
  ImageFile image_file, reference_file, variance_file;
  const Image image = load(o.image, image_file), reference = load(o.reference, reference_file);
  check_reference(reference, o.reference);
  std::optional<NoiseModel> noise;
  Image variance;
  if (!o.variance.empty()) {
    variance = load(o.variance, variance_file);
    check_reference(variance, o.variance);
    noise = NoiseModel{&variance, samples_of(o.image, image_file, "--spp", o.spp),
                       samples_of(o.reference, reference_file, "--reference-spp", o.reference_spp)};
  }
  const ImageMetrics m = compare_images(image, reference, noise);
  const std::vector<Figure> all = figures(m);

  std::vector<Requirement> missed;
  std::vector<std::string> missed_texts;
  for (const Requirement& r : requirements) {
    const auto f =
        std::find_if(all.begin(), all.end(), [&](const Figure& x) { return x.name == r.figure; });
    // Written so that a value that is not a number misses every limit.
    if (f->value && (r.less ? *f->value < r.limit : *f->value > r.limit)) continue;
    missed.push_back(r);
    missed_texts.push_back(r.text);
  }
  const Verdict verdict = judge(m, missed);
  if (!o.diff.empty()) write_difference(o.diff, image, reference, m);
  if (o.json) {
    nlohmann::ordered_json j = to_json(m);
    j["missed"] = missed_texts;
    j["verdict"] = name_of(verdict);
    fmt::print("{}\n", j.dump(2));
  } else {
    print_figures(m);
    for (const std::string& text : missed_texts) fmt::print("missed     {}\n", text);
    fmt::print("verdict    {}{}\n", name_of(verdict),
               verdict == Verdict::noisy && !noise
                   ? " (or biased: only --variance can tell these apart)"
                   : "");
  }
  // An image with holes meets no requirement.
  const bool met = missed.empty() && (requirements.empty() || verdict != Verdict::fail);
  return met ? kSuccess : kThresholdMissed;
}

}  // namespace

void add_compare_command(CLI::App& app, int& exit_code) {
  CLI::App* c = app.add_subcommand("compare", "Compare an image with a reference");
  const auto o = std::make_shared<CompareOptions>();
  c->add_option("image", o->image, "The image a")->required();
  c->add_option("reference", o->reference, "The reference b, of the same size")->required();
  c->add_option("--variance", o->variance, "Variance of one sample of the reference, per pixel");
  c->add_option("--spp", o->spp, "Samples per pixel of the image (default: from its header)");
  c->add_option("--reference-spp", o->reference_spp,
                "Samples per pixel of the reference (default: from its header)");
  c->add_option("--diff", o->diff,
                "Write a .png or .jpg: red where a is brighter, blue where darker");
  c->add_option("--require", o->require,
                "FIGURE<LIMIT or FIGURE>LIMIT; a miss exits with 3; repeatable")
      ->allow_extra_args(false);
  c->add_flag("--json", o->json, "Print the figures as JSON");
  std::string text = "Figures, over the channels R, G, B of all pixels:\n";
  for (const Figure& f : figures({})) text += fmt::format("  {:9} {}\n", f.name, f.formula);
  text +=
      "Verdicts: PASS; NOISY, a required figure is missed but noise explains all differences;\n"
      "BIASED, noise does not explain them (z below 0.9975 or |bias| above 4); FAIL, not finite.\n"
      "Exit codes: 0, also without --require whatever the verdict; 1 an image cannot be read or "
      "the\n"
      "sizes differ; 2 wrong usage; 3 a --require is missed.\n"
      "Example:\n"
      "  duet compare a.exr mean.exr --variance variance.exr --require 'relrmse<0.05' --require "
      "'bias<4'";
  c->footer(text);
  c->callback([o, &exit_code] { exit_code = compare(*o); });
}

}  // namespace duet
