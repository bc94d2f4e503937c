// Every method against Mitsuba's references, by tiles of independent images.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "references/reference_tiles.h"
#include "support/show.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr int kBatches = 16, kMostBatches = 640, kSpp = 2;
/// Standard error of the mean of the images, relative to the reference.
constexpr double kMostError = 0.006;

/// Images until the relative standard error of their mean is at most `most_error`; a test whose
/// images cannot be as certain as that is no test.
TileBatches render(const ReferenceCase& c, const std::string& name, double most_error) {
  IntegratorOverride method{name, {}, {}};
  // Of the methods other than `path`, the only one with another meaning of depth.
  if (c.reference == "hide-emitters") method.parameters.emplace_back("max_depth", "2");
  const PreparedScene scene(c.scene, c.defines, method);
  TileBatches batches;
  const auto add = [&](int count) {
    for (int i = 0; i < count; ++i)
      batches.add(scene.render(kSpp, 2, scene.layout.crop, uint64_t(batches.count())));
  };
  add(kBatches);
  // Half as many again as the estimate of what it takes, which is none too good; and a little
  // better than asked for, since the test divides by the mean of the reference.
  for (int count = kBatches; count < kMostBatches; count = int(batches.count())) {
    const double error = batches.total().error() / batches.total().mean();
    const double needed = 1.5 * count * std::pow(error / (0.95 * most_error), 2);
    if (needed <= 1.5 * count) break;
    add(std::min(int(needed), kMostBatches) - count);
  }
  return batches;
}

/// Photons do not enter media.
bool has_media(const ReferenceCase& c) {
  return c.reference.starts_with("media-");
}

/// Scenes with media that this test cannot judge. In `media-homogeneous` glass makes caustics of a
/// lamp without size, which are in no image of `volpath`, by which the reference has been made; the
/// light that glass brings to the media of `media-nested` comes too rarely for so few samples.
bool is_left_out(const ReferenceCase& c) {
  return c.reference == "media-homogeneous" || c.reference == "media-nested";
}

/// Light cannot be followed through curves from its source.
bool has_fibres(const ReferenceCase& c) {
  return c.reference == "bsdf-fibres";
}

/// Where the sky is seen directly it has next to no noise, and Mitsuba's single precision is all
/// that these tiles would show: it differs by up to 0.07 %.
bool is_without_noise(const ReferenceCase& c) {
  return c.reference == "sunsky";
}

/// The error down to which a scene is rendered. Where parallel lights are met by few light
/// sub-paths, and those bring much, tiles of fewer samples are not normally distributed.
double most_error(const ReferenceCase& c) {
  return c.reference == "directional-area" ? kMostError / 3 : kMostError;
}

/// Whether light sub-paths can be connected with the sensor, which `reuse` needs.
bool has_light_image(const ReferenceCase& c) {
  return c.reference != "batch";
}

/// Whether the light image alone shows the scene: no specular surfaces, and none so glossy that
/// what it reflects is found too rarely for statistics.
bool suits_light_tracing(const ReferenceCase& c) {
  constexpr std::string_view kScenes[]{"camera",       "filters-tent", "filters-lanczos",
                                       "lights-area",  "textures",     "lights-delta",
                                       "thesis-empty", "shapes",       "directional-area"};
  return std::find(std::begin(kScenes), std::end(kScenes), c.reference) != std::end(kScenes);
}

}  // namespace

TEST_SUITE("references") {
  TEST_CASE("unbiased methods agree with Mitsuba") {
    const std::vector<ReferenceCase>& cases = reference_cases();
    const double level = sidak(0.01, 3 * int(cases.size()) * 64);
    for (const std::string name : {"bdpt", "reuse", "ptracer"}) {
      CAPTURE(name);
      double total = 0;
      int count = 0;
      for (const ReferenceCase& c : cases) {
        if (is_left_out(c) || is_without_noise(c) || has_fibres(c) ||
            (name == "ptracer" && !suits_light_tracing(c)) ||
            (name == "reuse" && !has_light_image(c)))
          continue;
        const Reference reference(c.reference);
        const ReferenceComparison r = compare_tiles(render(c, name, most_error(c)), reference);
        CAPTURE(c.reference);
        CAPTURE(r.ratio);
        CHECK(r.ratio_error < kMostError);
        CHECK(r.least_p > level);
        CHECK(r.mean_z2 < 2.2);
        total += r.mean_z2, ++count;
      }
      CHECK(total / count < 1.6);
    }
  }

  // What merging does to the mean of an image of few iterations: photons of one surface count for
  // another near it, and those beyond an edge are missing (docs/mis.md).
  TEST_CASE("methods that merge come near Mitsuba") {
    struct Method {
      std::string name;
      double bias, most_error;  ///< relative to the reference
    };
    for (const auto& [name, bias, most_error] :
         {Method{"vcm", 0.005, kMostError}, {"bpm", 0.025, 0.012}, {"ppm", 0.025, 0.012}}) {
      for (const ReferenceCase& c : reference_cases()) {
        if (has_fibres(c) || (name == "vcm" ? is_left_out(c) : has_media(c))) continue;
        const Reference reference(c.reference);
        const ReferenceComparison r = compare_tiles(render(c, name, most_error), reference);
        SHOW(name);
        CAPTURE(c.reference);
        CHECK(r.ratio_error < most_error);
        CHECK(std::abs(r.ratio - 1) < bias + 3.5 * r.ratio_error);
      }
    }
  }
}
