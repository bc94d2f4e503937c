#include "evaluate/compare/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace duet {

namespace {

template <class T>
std::optional<double> of_tiles(const Measurements& m, T TileComparison::*member) {
  return m.tiles ? std::optional(double((*m.tiles).*member)) : std::nullopt;
}

}  // namespace

std::optional<double> Measurements::p_value() const {
  if (tiles) return tiles->p;
  return bias_test && bias_test->tests > 0 ? std::optional(bias_test->p) : std::nullopt;
}

std::vector<Figure> figures(const Measurements& measurements) {
  const ImageMetrics& m = measurements.metrics;
  double ratio = 0;
  for (const double r : m.mean_ratio) ratio = std::max(ratio, std::abs(r - 1));
  return {
      {"rmse", m.rmse, "square root of the mean of (a - b)^2", ""},
      {"relrmse", m.relative_rmse, "rmse / mean(b)", ""},
      {"relmse", m.relmse, "mean of (a - b)^2 / (b^2 + 0.01)", ""},
      {"trimmed", m.relmse_trimmed, "relmse without the worst 0.1 % of the pixels", ""},
      {"worst", m.worst, "share of relmse that is in these worst pixels", ""},
      {"mae", m.mae, "mean of |a - b|", ""},
      {"mape", measurements.percentage.mape, "mean of |a - b| / (|b| + 0.01)", ""},
      {"smape", measurements.percentage.smape, "mean of 2 |a - b| / (|a| + |b| + 0.01)", ""},
      {"ratio", ratio, "largest |mean(a) / mean(b) - 1| of the channels", ""},
      {"firefly", m.firefly, "share of a's luminance that is in its brightest 0.1 % of pixels", ""},
      {"flip", measurements.flip, "mean LDR-FLIP of the values from 0 to 1, 67 pixels per degree",
       ""},
      {"hdrflip", measurements.hdr_flip,
       "mean HDR-FLIP, over exposures chosen from b; not of .png and the like", ""},
      {"psnr", measurements.display.psnr,
       "10 log10(1 / mean of (a - b)^2) dB, of values cut to 0..1 and encoded as sRGB", ""},
      {"ssim", measurements.display.ssim,
       "mean SSIM of such values, 11x11 Gaussian of 1.5 pixels, K1 0.01, K2 0.03; not of less than "
       "11x11",
       ""},
      {"bias", m.bias ? std::optional(std::abs(*m.bias)) : std::nullopt,
       "|mean(a) - mean(b)| in standard errors, worst channel; needs --variance", "--variance"},
      {"z", m.z_share,
       "share of values that noise explains at significance 0.01 (Sidak); needs --variance",
       "--variance"},
      {"zrms", m.z_rms, "root mean square of (a - b) / standard error; needs --variance",
       "--variance"},
      {"p", measurements.p_value(), "p-value of the test for bias; needs --variance or --batches",
       "--variance or --batches"},
      {"tiles", of_tiles(measurements, &TileComparison::rejected),
       "tiles of 8x8 whose means differ, Welch's t, 0.01 (Sidak); needs --batches", "--batches"},
      {"tilez2", of_tiles(measurements, &TileComparison::mean_z2),
       "mean z^2 of the tiles, 1 if only noise differs; needs --batches", "--batches"},
      {"nan", double(m.nan_pixels), "pixels with a NaN", ""},
      {"infinite", double(m.infinite_pixels), "pixels with an infinity", ""},
      {"negative", double(m.negative_pixels), "pixels with a negative value", ""},
  };
}

std::vector<std::string> texts_of(const std::vector<Requirement>& requirements) {
  std::vector<std::string> list;
  for (const Requirement& r : requirements) list.push_back(r.text);
  return list;
}

std::vector<Requirement> missed_of(const std::vector<Requirement>& requirements,
                                   const Measurements& measurements) {
  const std::vector<Figure> all = figures(measurements);
  std::vector<Requirement> missed;
  for (const Requirement& r : requirements) {
    const auto f =
        std::find_if(all.begin(), all.end(), [&](const Figure& x) { return x.name == r.figure; });
    // Written so that a value that is not a number misses every limit.
    if (f->value && (r.less ? *f->value < r.limit : *f->value > r.limit)) continue;
    missed.push_back(r);
  }
  return missed;
}

const char* name_of(Verdict v) {
  switch (v) {
    case Verdict::pass:
      return "PASS";
    case Verdict::none:
      return "no threshold given";
    case Verdict::noisy:
      return "NOISY";
    case Verdict::biased:
      return "BIASED";
    case Verdict::fail:
      return "FAIL";
  }
  return "";
}

Verdict judge(const Measurements& measurements, const std::vector<Requirement>& requirements,
              const std::vector<Requirement>& missed) {
  const ImageMetrics& m = measurements.metrics;
  if (m.nan_pixels > 0 || m.infinite_pixels > 0) return Verdict::fail;
  // Written so that a p-value that is not a number is no pass.
  if (const auto p = measurements.p_value(); p && !(*p >= kBiasSignificance))
    return Verdict::biased;
  if (requirements.empty()) return Verdict::none;
  return missed.empty() ? Verdict::pass : Verdict::noisy;
}

std::string figures_help() {
  std::string text = "Figures, over the channels R, G, B of all pixels:\n";
  for (const Figure& f : figures({})) text += fmt::format("  {:9} {}\n", f.name, f.formula);
  text +=
      "Verdicts: BIASED, noise does not explain the differences: p below 0.01, which at most one "
      "unbiased image in a hundred has; PASS, every --require is met; NOISY, one is missed, but no "
      "bias was found; FAIL, not finite; no threshold given, without --require. docs/compare.md "
      "has "
      "the test, how it was measured, and what it does not notice.\n";
  return text;
}

}  // namespace duet
