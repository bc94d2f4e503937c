#include "evaluate/compare/text.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/percent.h"
#include "evaluate/compare/verdict.h"

namespace duet {

namespace {

/// The test of sets of images.
std::string tile_lines(const TileComparison& t) {
  std::string text;
  text += fmt::format(
      "tile test  {} of {} tiles differ, mean z^2 {:.2f}, least p {:.3g}, worst ratio {:.5f}\n",
      t.rejected, t.tiles, t.mean_z2, t.least_p, t.worst_ratio);
  text +=
      fmt::format("mean       {:.6f} +- {:.6f} times the reference's\n", t.ratio, t.ratio_error);
  text += fmt::format(
      "power      a bias of {} of half the tiles, or {} of any, would have been "
      "noticed "
      "with a probability of 80 %\n",
      percent(t.visible_bias), percent(t.visible_bias_worst));
  return text;
}

std::string figure_lines(const Comparison& c) {
  std::string text;
  const ImageMetrics& m = c.measurements.metrics;
  for (const Figure& f : figures(c.measurements)) {
    if (f.name == "ratio")
      text += fmt::format("{:10} {:.6f} {:.6f} {:.6f}\n", "mean ratio", m.mean_ratio[0],
                          m.mean_ratio[1], m.mean_ratio[2]);
    if (f.name == "bias" && m.bias)
      text += fmt::format("{:10} {:+.2f}\n", f.name, *m.bias);
    else if (f.value)
      text += fmt::format("{:10} {:.6g}\n", f.name, *f.value);
    else if (f.needs.starts_with("--variance") && !c.measurements.tiles)
      text += fmt::format("{:10} not available (no --variance)\n", f.name);
  }
  if (c.measurements.bias_test) text += bias_test_text(*c.measurements.bias_test);
  if (c.measurements.tiles) text += tile_lines(*c.measurements.tiles);
  return text;
}

}  // namespace

std::string comparison_text(const Comparison& c) {
  std::string text = figure_lines(c);
  for (const Requirement& r : c.missed) text += fmt::format("missed     {}\n", r.text);
  return text + fmt::format("verdict    {}\n", verdict_text(c));
}

std::string table_text(const CompareSettings& settings, const std::vector<Comparison>& all) {
  std::string text;
  size_t width = 5, verdict_width = 7;
  for (const Comparison& c : all) {
    width = std::max(width, c.name.size());
    verdict_width = std::max(verdict_width, outcome_name(c).size());
  }
  text += fmt::format("{:{}}  {:{}}  relrmse   trimmed   flip      hdrflip\n", "image", width,
                      "verdict", verdict_width);
  for (const Comparison& c : all) {
    const Measurements& m = c.measurements;
    text += fmt::format("{:{}}  {:{}}  ", c.name, width, outcome_name(c), verdict_width);
    if (!c.compared()) {
      text += fmt::format("{}\n", absence(settings, c));
      continue;
    }
    text += fmt::format("{:<8.4g}  {:<8.4g}  {:<8.4g}  {:8}", m.metrics.relative_rmse,
                        m.metrics.relmse_trimmed, m.flip.value_or(NAN),
                        m.hdr_flip ? fmt::format("{:.4g}", *m.hdr_flip) : "-");
    if (!c.missed.empty()) text += fmt::format("  missed: {}", fmt::join(texts_of(c.missed), " "));
    text += "\n";
  }
  return text + summary_of(settings, all) + "\n";
}

}  // namespace duet
