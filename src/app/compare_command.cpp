// duet compare: how far an image is from a reference.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "base/log.h"
#include "image/image_io.h"
#include "image/metrics.h"

namespace duet {

namespace {

struct CompareOptions {
  std::string image, reference, variance, diff;
  double spp = 0, reference_spp = 0;
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
  Requirement r;
  r.text = text;
  size_t used = 0;
  if (at != std::string::npos) {
    r.figure = text.substr(0, at);
    r.less = text[at] == '<';
    const std::string number = text.substr(at + 1);
    try {
      r.limit = std::stod(number, &used);
    } catch (const std::exception&) {
      used = 0;
    }
    if (used != number.size()) used = 0;
  }
  if (used == 0) throw UsageError(fmt::format("--require \"{}\" is not like rmse<0.02", text));
  std::vector<std::string> known;
  for (const Figure& f : figures({})) known.push_back(f.name);
  if (std::find(known.begin(), known.end(), r.figure) == known.end())
    throw UsageError(fmt::format("--require: there is no figure \"{}\"{}", r.figure,
                                 did_you_mean(r.figure, known)));
  return r;
}

/// The image in linear values.
Image load(const std::string& path, ImageFile& file) {
  file = read_image(path);
  if (!file.display_encoded) return file.image;
  Image image = file.image;
  if (!file.bytes.empty()) {
    image.data.resize(file.bytes.size());
    for (size_t i = 0; i < file.bytes.size(); ++i) image.data[i] = float(file.bytes[i]) / 255;
  }
  for (float& v : image.data) v = srgb_to_linear(v);
  return image;
}

/// The sample count that was given, or else the one that the image's header states.
std::optional<double> sample_count(double given, const ImageFile& file) {
  if (given > 0) return given;
  for (const auto& [name, value] : file.header)
    if (const double n = name == "spp" ? std::atof(value.c_str()) : 0; n > 0) return n;
  return std::nullopt;
}

Verdict judge(const ImageMetrics& m, bool required_met) {
  if (m.nan_pixels > 0 || m.infinite_pixels > 0) return Verdict::fail;
  if ((m.z_share && *m.z_share < kRequiredZShare) || (m.bias && std::abs(*m.bias) > kNotableBias))
    return Verdict::biased;
  return required_met ? Verdict::pass : Verdict::noisy;
}

int compare(const CompareOptions& o) {
  std::vector<Requirement> requirements;
  for (const std::string& text : o.require) requirements.push_back(parse_requirement(text));
  ImageFile image_file, reference_file, variance_file;
  const Image image = load(o.image, image_file), reference = load(o.reference, reference_file);
  std::optional<NoiseModel> noise;
  Image variance;
  if (!o.variance.empty()) {
    variance = load(o.variance, variance_file);
    const auto spp = sample_count(o.spp, image_file);
    if (!spp)
      throw UsageError(fmt::format("{} does not say how many samples it has: give --spp", o.image));
    noise = NoiseModel{&variance, *spp,
                       sample_count(o.reference_spp, reference_file).value_or(INFINITY)};
  }
  const ImageMetrics m = compare_images(image, reference, noise);
  const std::vector<Figure> all = figures(m);

  std::vector<std::string> missed;
  for (const Requirement& r : requirements) {
    const auto f =
        std::find_if(all.begin(), all.end(), [&](const Figure& x) { return x.name == r.figure; });
    if (!f->value) throw UsageError(fmt::format("--require {}: needs --variance", r.text));
    // Written so that a value that is not a number misses every limit.
    if (!(r.less ? *f->value < r.limit : *f->value > r.limit)) missed.push_back(r.text);
  }
  const Verdict verdict = judge(m, missed.empty());
  if (!o.diff.empty()) {
    const double scale = 0.5 * m.rmse / std::max(m.relative_rmse, 1e-30);
    write_display_image(o.diff, image.width, image.height, 3,
                        difference_image(image, reference, scale));
  }

  if (o.json) {
    nlohmann::ordered_json j;
    for (const Figure& f : all) {
      if (f.name == "bias")
        j[f.name] = m.bias ? nlohmann::ordered_json(*m.bias) : nullptr;
      else
        j[f.name] = f.value ? nlohmann::ordered_json(*f.value) : nullptr;
    }
    j["mean_ratio"] = m.mean_ratio;
    j["missed"] = missed;
    j["verdict"] = name_of(verdict);
    std::printf("%s\n", j.dump(2).c_str());
  } else {
    for (const Figure& f : all) {
      if (f.name == "ratio")
        fmt::print("{:10} {:.6f} {:.6f} {:.6f}\n", "ratio", m.mean_ratio[0], m.mean_ratio[1],
                   m.mean_ratio[2]);
      else if (f.name == "bias" && m.bias)
        fmt::print("{:10} {:+.2f}\n", f.name, *m.bias);
      else if (f.value)
        fmt::print("{:10} {:.6g}\n", f.name, *f.value);
      else
        fmt::print("{:10} not available (no --variance)\n", f.name);
    }
    for (const std::string& text : missed) fmt::print("missed     {}\n", text);
    fmt::print("verdict    {}\n", name_of(verdict));
  }
  return missed.empty() ? kSuccess : kThresholdMissed;
}

}  // namespace

void add_compare_command(CLI::App& app, int& exit_code) {
  CLI::App* c = app.add_subcommand("compare", "Compare an image with a reference");
  const auto o = std::make_shared<CompareOptions>();
  c->add_option("image", o->image, "The image a")->required();
  c->add_option("reference", o->reference, "The reference b, of the same size")->required();
  c->add_option("--variance", o->variance, "Variance of one sample of the reference, per pixel");
  c->add_option("--spp", o->spp, "Samples per pixel of the image (default: from its header)")
      ->check(CLI::PositiveNumber);
  c->add_option(
       "--reference-spp", o->reference_spp,
       "Samples per pixel of the reference (default: from its header; else it counts as exact)")
      ->check(CLI::PositiveNumber);
  c->add_option("--diff", o->diff, "Write a picture: red where a is brighter, blue where darker");
  c->add_option("--require", o->require, "FIGURE<LIMIT or FIGURE>LIMIT; a miss exits with 3");
  c->add_flag("--json", o->json, "Print the figures as JSON");
  std::string text = "Figures, over the channels R, G, B of all pixels:\n";
  for (const Figure& f : figures({})) text += fmt::format("  {:9} {}\n", f.name, f.formula);
  text +=
      "Verdicts: PASS; NOISY, a required figure is missed but noise explains all differences;\n"
      "BIASED, noise does not explain them (z below 0.9975 or |bias| above 4); FAIL, not finite.\n"
      "Example:\n"
      "  duet compare a.exr mean.exr --variance variance.exr --require 'relrmse<0.05' --require "
      "'bias<4'";
  c->footer(text);
  c->callback([o, &exit_code] { exit_code = compare(*o); });
}

}  // namespace duet
