// Scenes of pbrt against the images that pbrt-v4 has made of them, and methods against one another.
#include <nlohmann/json.hpp>

#include "image/colours.h"
#include "image/image_io.h"
#include "image/tile_test.h"
#include "integrators/method_rules.h"
#include "references/rendering.h"
#include "support/files.h"
#include "support/source_path.h"

using namespace duet;
using namespace duet::test;

namespace {

namespace fs = std::filesystem;

constexpr int kPbrtBatches = 12;
/// What merging does to the mean of an image, relative to it.
constexpr double kMostBlur = 0.002;
constexpr int kTileCount = TileBatches::kTiles * TileBatches::kTiles;

/// A folder of reference/ that pbrt has filled.
struct PbrtReference {
  std::string name;      ///< of the folder, there and in scenes/
  Image mean, variance;  ///< the variance is that of the mean
  /// Relative deviation that is allowed: Duet renders three colours, pbrt spectra.
  double tolerance = 0;
};

std::vector<PbrtReference> pbrt_references() {
  std::vector<PbrtReference> all;
  for (const auto& entry : fs::directory_iterator(source_path("reference"))) {
    const std::string name = entry.path().filename().string(), folder = entry.path().string();
    if (!name.starts_with("pbrt-")) continue;
    const auto provenance = nlohmann::json::parse(read_file(folder + "/provenance.json"));
    const std::string kind = provenance["light_transport_class"];
    all.push_back({name, read_image(folder + "/mean.exr").image,
                   read_image(folder + "/variance.exr").image,
                   kind == "grey"  ? 0.005
                   : kind == "rgb" ? 0.01
                                   : 0.03});
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return all;
}

std::vector<Image> render_batches(const PreparedScene& scene, int spp) {
  std::vector<Image> images;
  for (int b = 0; b < kPbrtBatches; ++b)
    images.push_back(scene.render(spp, 2, scene.layout.crop, uint64_t(b)));
  return images;
}

/// The sum over all pixels of a channel.
double sum(const Image& image, int channel) {
  const Colours colours(image);
  double total = 0;
  for (size_t i = 0; i < colours.pixels(); ++i) total += colours(i, channel);
  return total;
}

/// Mean and error of the mean in each tile.
std::vector<MeanEstimate> tiles_of(const PbrtReference& reference) {
  const Colours mean(reference.mean), variance(reference.variance);
  const int n = TileBatches::kTiles, width = reference.mean.width, height = reference.mean.height;
  std::vector<MeanEstimate> tiles(kTileCount);
  std::vector<double> counts(kTileCount);
  for (size_t i = 0; i < mean.pixels(); ++i) {
    const int x = int(i) % width, y = int(i) / width;
    const auto t = size_t((y * n / height) * n + x * n / width);
    double deviation = 0;
    for (int c = 0; c < 3; ++c) {
      tiles[t].mean += mean(i, c) / 3;
      deviation += std::sqrt(variance(i, c)) / 3;
    }
    tiles[t].error2 += deviation * deviation;
    ++counts[t];
  }
  for (size_t t = 0; t < tiles.size(); ++t)
    tiles[t].mean /= counts[t], tiles[t].error2 /= counts[t] * counts[t];
  return tiles;
}

/// Tiles whose deviation is larger than `allowed` by more than chance explains.
int count_deviating(const TileBatches& images, const std::vector<MeanEstimate>& reference,
                    double allowed) {
  int deviating = 0;
  for (size_t t = 0; t < reference.size(); ++t) {
    const WelchTest test = welch_test(images.tile(int(t)).estimate(), reference[t]);
    const double excess = std::abs(images.tile(int(t)).mean() - reference[t].mean) -
                          allowed * std::abs(reference[t].mean);
    if (excess <= 0) continue;
    deviating += !(test.error > 0) ||
                 student_p_value(excess / test.error, test.dof) < sidak(0.01, kTileCount);
  }
  return deviating;
}

TileBatches batches_of(const std::vector<Image>& images) {
  TileBatches batches;
  for (const Image& image : images) batches.add(image);
  return batches;
}

/// Whether the images' mean is the reference's in each colour and, but for two tiles, in each tile.
bool agrees(const std::vector<Image>& images, const PbrtReference& reference) {
  bool agrees =
      count_deviating(batches_of(images), tiles_of(reference), 2 * reference.tolerance) <= 2;
  for (int c = 0; c < 3; ++c) {
    Moments sums;
    for (const Image& image : images) sums.add(sum(image, c));
    const double expected = sum(reference.mean, c);
    const double error = std::sqrt(sums.error() * sums.error() + sum(reference.variance, c));
    CAPTURE(c);
    CAPTURE(sums.mean() / expected);
    CAPTURE(error / expected);
    // What the images cannot show they do not prove.
    CHECK(error < 0.01 * expected);
    agrees =
        agrees && std::abs(sums.mean() - expected) < reference.tolerance * expected + 3 * error;
  }
  return agrees;
}

/// pbrt-v4 has rendered files of v3 after upgrading them itself; that leaves spot lights the edge
/// of v4.
void as_upgraded(SceneDescription& d) {
  for (LightDescription& l : d.lights)
    if (auto* spot = std::get_if<SpotLight>(&l.model)) spot->falloff = SpotFalloff::smooth;
}

}  // namespace

TEST_SUITE("references") {
  TEST_CASE("scenes agree with pbrt") {
    const std::vector<PbrtReference> references = pbrt_references();
    CHECK(references.size() >= 40);
    for (const PbrtReference& reference : references) {
      CAPTURE(reference.name);
      CHECK(
          agrees(render_batches(PreparedScene(reference.name, {}, {}, as_upgraded), 8), reference));
    }
  }
}

TEST_SUITE("agreement") {
  TEST_CASE("methods have the same mean in pbrt's scenes") {
    int compared = 0;
    const std::vector<PbrtReference> references = pbrt_references();
    for (const PbrtReference& reference : references) {
      // What shows no light has no other method.
      if (reference.name == "pbrt-integ-ao") continue;
      const TileBatches expected = batches_of(render_batches(
          PreparedScene(reference.name, {}, IntegratorOverride{"volpath", {}, {}}), 16));
      for (const std::string method : {"bdpt", "reuse", "vcm"}) {
        const PreparedScene scene(reference.name, {}, IntegratorOverride{method, {}, {}});
        if (!scene.is_supported) continue;
        CAPTURE(reference.name);
        CAPTURE(method);
        const TileComparison r = compare_tiles(batches_of(render_batches(scene, 16)), expected);
        CAPTURE(r.ratio);
        CAPTURE(r.ratio_error);
        CHECK(r.ratio_error < 0.01);
        ++compared;
        CHECK(r.mean_z2 < 2.2);
        if (method == "vcm") {
          CHECK(std::abs(r.ratio - 1) < kMostBlur + 3.5 * r.ratio_error);
          continue;
        }
        CHECK(r.least_p > sidak(0.01, 2 * int(references.size()) * kTileCount));
        CHECK(r.mean_p > sidak(0.01, 2 * int(references.size())));
      }
    }
    CHECK(compared > 2 * int(references.size()));
  }
}
