#include "evaluate/compare/verdict.h"

#include <fmt/format.h>

#include "base/percent.h"
#include "image/colours.h"

namespace duet {

namespace {

/// From here on noise is worth a word that is larger than the samples explain.
constexpr double kNotableZRms = 2;

const char* colour_name(int channel) {
  static constexpr const char* names[] = {"red", "green", "blue"};
  return names[channel];
}

/// The share of pixels with a value above 1.
double share_above_one(const Image& image) {
  const Colours colours(image);
  size_t count = 0;
  for (size_t i = 0; i < colours.pixels(); ++i)
    count += colours(i, 0) > 1 || colours(i, 1) > 1 || colours(i, 2) > 1;
  return double(count) / double(colours.pixels());
}

}  // namespace

std::string known_text(const Comparison& c) {
  const Measurements& m = c.measurements;
  std::string error = fmt::format("relrmse {:.3g}", m.metrics.relative_rmse);
  const auto p = m.p_value();
  if (!p)
    return error + (m.bias_test ? "; no pixel has a known variance"
                                : "; without --variance noise and bias cannot be told apart");
  if (m.metrics.z_rms && *m.metrics.z_rms > kNotableZRms)
    error += fmt::format("; the noise is {:.2g} times what the samples explain", *m.metrics.z_rms);
  if (m.bias_test && m.bias_test->left_out > 0)
    error += fmt::format("; {} pixels left out that have no known variance", m.bias_test->left_out);
  if (!(*p >= kBiasSignificance))
    return fmt::format("different beyond noise, p {:.2g}; {}", *p, error);
  const double bound = m.bias_test ? m.bias_test->bound95()
                                   : std::abs(m.tiles->ratio - 1) + 1.96 * m.tiles->ratio_error;
  return fmt::format("no bias found, p {:.2g}; the mean within {} (95 %); {}", *p, percent(bound),
                     error);
}

std::string verdict_text(const Comparison& c) {
  std::string text = name_of(c.verdict);
  if (c.verdict == Verdict::none) text += ": " + known_text(c);
  if (c.verdict == Verdict::biased) text += fmt::format(" ({})", known_text(c));
  if (c.verdict == Verdict::noisy && !c.tells_noise)
    text += " (or biased: only --variance can tell these apart)";
  return text;
}

std::string bias_test_text(const BiasTest& t) {
  std::string text = fmt::format(
      "least p of {} tests {:.3g}: the tile {}x{} at {},{}, {} {:.4f} times the reference's\n",
      t.tests, t.tile.p, t.tile.width, t.tile.height, t.tile.x, t.tile.y,
      colour_name(t.tile.channel), t.tile.ratio);
  if (t.mean.p < t.tile.p)
    text = fmt::format(
        "least p of {} tests {:.3g}: the whole image, {} {:.4f} times the reference's\n", t.tests,
        t.mean.p, colour_name(t.mean.channel), t.mean.ratio);
  text += fmt::format(
      "a bias of {} everywhere, of {} of half the tiles, or of {} of any that is not dark would "
      "have been noticed with a probability of 80 %\n",
      percent(t.noticed_mean), percent(t.noticed_tile), percent(t.noticed_tile_worst));
  return text;
}

std::string clipping_warning(const LinearImage& image, const LinearImage& reference) {
  if (image.display_encoded == reference.display_encoded) return "";
  const bool which = image.display_encoded;
  const double share = share_above_one(which ? reference.image : image.image);
  if (!(share > 0)) return "";
  return fmt::format(
      "the {} is made for display and ends at 1, but {} of the {}'s pixels are above 1: the "
      "figures count what was clipped as an error; compare .exr with .exr",
      which ? "image" : "reference", percent(share), which ? "reference" : "image");
}

std::string denoised_warning(const LinearImage& image) {
  if (image.denoiser.empty()) return "";
  return fmt::format(
      "the image was denoised by {} and is biased: tests for bias are for images as they were "
      "rendered",
      image.denoiser);
}

}  // namespace duet
