// Light that media emit, against integrals by hand.
#include "media/emission.h"

#include <doctest/doctest.h>

#include "media/heterogeneous.h"
#include "media/homogeneous.h"
#include "media/phase_functions.h"
#include "pbrt/pbrt.h"
#include "support/statistics.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

const Isotropic kIsotropic;

/// ∫ T σ_a L_e along a ray of that optical depth.
Spectrum along(const Spectrum& depth, const Spectrum& albedo, const Spectrum& radiance) {
  Spectrum sum;
  for (int c = 0; c < 3; ++c) sum[c] = (1 - std::exp(-depth[c])) * (1 - albedo[c]) * radiance[c];
  return sum;
}

void check_emitted(const Medium& medium, const Ray& ray, const Spectrum& expected) {
  REQUIRE(medium.emits());
  RandomStream random(5);
  Moments found[3];
  for (int i = 0; i < 40000; ++i) {
    const Spectrum e = medium.emitted(ray, random);
    for (int c = 0; c < 3; ++c) found[c].add(double(e[c]));
  }
  for (int c = 0; c < 3; ++c) {
    CAPTURE(c);
    CHECK(std::abs(found[c].mean() - double(expected[c])) < 5 * found[c].error() + 1e-5);
    CHECK(found[c].error() < 0.01 * double(expected[c]));
  }
}

GridVolume even(float value) {
  VolumeGrid grid;
  grid.size = {4, 3, 2};
  grid.values.assign(grid.node_count(), value);
  return {std::make_shared<VolumeGrid>(grid), Matrix4::scale(4, 1, 1), VolumeFilter::trilinear,
          VolumeWrap::clamp, VolumeNodes::within};
}

}  // namespace

TEST_CASE("media emit what their absorption and radiance make") {
  const Spectrum sigma(0.5f, 1.5f, 4), albedo(0.2f, 0.5f, 0.9f), radiance(3, 2, 7);
  const Ray ray{{0, .5f, .5f}, {1, 0, 0}, 2};
  check_emitted(HomogeneousMedium(sigma, {albedo}, kIsotropic, radiance), ray,
                along(sigma * 2, albedo, radiance));
  CHECK_FALSE(HomogeneousMedium(sigma, {albedo}, kIsotropic).emits());

  const MediumEmission emission({radiance});
  check_emitted(HeterogeneousMedium(even(0.7f), 3, {albedo}, kIsotropic, emission), ray,
                along(Spectrum(0.7f * 3 * 2), albedo, radiance));
  CHECK_FALSE(HeterogeneousMedium(even(1), 3, {albedo}, kIsotropic).emits());
}

TEST_CASE("hot parts of a medium emit in the colour of their temperature") {
  const GridVolume density = even(0.5f), kelvin = even(1500);
  const MediumEmission emission({Spectrum(2)}, kelvin,
                                {Spectrum(0), Spectrum(1, 0, 0), Spectrum(1, 4, 0)}, 2000);
  CHECK_FALSE(emission.is_constant());
  // Half way between the last two colours.
  check_emitted(HeterogeneousMedium(density, 2, {Spectrum(0)}, kIsotropic, emission),
                {{1, .5f, .5f}, {1, 0, 0}, 2},
                along(Spectrum(2), Spectrum(0), Spectrum(2, 4, 1e-9f)));
}

TEST_CASE("nothing is seen in an oven") {
  // Where all that absorbs and all around emits the same radiance, so does every direction,
  // whatever is scattered: by Kirchhoff's law.
  const TemporaryDirectory folder;
  const std::string lists =
      "\"integer nx\" 2 \"integer ny\" 2 \"integer nz\" 2 \"point3 p0\" [-9 -9 -9] "
      "\"point3 p1\" [9 9 9] \"float density\" [3 3 3 3 3 3 3 3] ";
  const std::string sigma = "\"rgb sigma_a\" [1 .5 .2] \"rgb sigma_s\" [.5 2 .5] \"float g\" .4 ";
  for (const std::string& medium :
       {"\"homogeneous\" \"rgb Le\" [.5 .5 .5] \"float Lescale\" 2 " + sigma,
        "\"uniformgrid\" \"rgb Le\" [.25 .25 .25] \"float Lescale\" [4 4 4 4 4 4 4 4] " + lists +
            sigma}) {
    CAPTURE(medium);
    const std::string text =
        "LookAt 0 -3 0.2  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" 40\n"
        "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
        "WorldBegin\nLightSource \"infinite\" \"rgb L\" [1 1 1]\n"
        "MakeNamedMedium \"m\" \"string type\" " +
        medium + "\nMediumInterface \"m\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n";
    Diagnostics diagnostics;
    auto read = pbrt::read_pbrt(folder.write("oven.pbrt", text), {}, diagnostics);
    REQUIRE(read);
    const TransportScene scene(std::move(read->description));
    const auto image = scene.render("volpath", {{"max_depth", "60"}}, 256, 1).image;
    Moments all;
    for (size_t i = 0; i < image.data.size(); ++i)
      if (i % 4 < 3) all.add(double(image.data[i]));
    CHECK(std::abs(all.mean() - 1) < 5 * all.error() + 1e-4);
    CHECK(all.error() < 0.004);
  }
}
