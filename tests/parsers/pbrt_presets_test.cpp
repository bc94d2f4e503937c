// Media of pbrt files that are known by a name.
#include <doctest/doctest.h>

#include "support/pbrt_file.h"

using namespace duet;
using namespace duet::test;

namespace {

PbrtFile v4_medium(const std::string& parameters) {
  return read_pbrt_file_of(
      "Film \"rgb\"\nWorldBegin\nMakeNamedMedium \"m\" \"string type\" \"homogeneous\" " +
      parameters + "\nMediumInterface \"m\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n");
}
PbrtFile v3_medium(const std::string& parameters) {
  return read_pbrt_file_of(
      "Film \"image\"\nIntegrator \"volpath\"\nWorldBegin\nMakeNamedMedium \"m\" \"string type\" "
      "\"homogeneous\" " +
      parameters + "\nMediumInterface \"m\" \"\"\nMaterial \"none\"\nShape \"sphere\"\nWorldEnd\n");
}
PbrtFile v3_surface(const std::string& parameters) {
  return read_pbrt_file_of("Film \"image\"\nWorldBegin\nMaterial \"subsurface\" " + parameters +
                           "\nShape \"sphere\"\nWorldEnd\n");
}

/// What the only medium absorbs of red.
double absorption(const PbrtFile& file) {
  const SceneDescription d = scene_of(file);
  const MediumDescription& m = d.media.at(0);
  const double extinction = double(std::get<Spectrum>(m.sigma_t).r);
  return m.scale * extinction * (1 - double(std::get<Spectrum>(m.albedo).r));
}

const std::string kKetchup = "\"Ketchup\" ", kOwn = "\"rgb sigma_a\" [.5 .5 .5]";
constexpr double kKetchups = 0.061;  // per millimetre

}  // namespace

TEST_CASE("pbrt: in v3 coefficients count beside the name of a medium, in v4 the name alone") {
  CHECK(absorption(v4_medium("\"string preset\" " + kKetchup)) == doctest::Approx(kKetchups));
  CHECK(absorption(v4_medium("\"string preset\" " + kKetchup + kOwn)) ==
        doctest::Approx(kKetchups));
  CHECK(absorption(v3_medium("\"string preset\" " + kKetchup)) == doctest::Approx(kKetchups));
  CHECK(absorption(v3_medium("\"string preset\" " + kKetchup + kOwn)) == doctest::Approx(0.5));
  CHECK(absorption(v3_surface("\"string name\" " + kKetchup)) == doctest::Approx(kKetchups));
  CHECK(absorption(v3_surface("\"string name\" " + kKetchup + kOwn)) == doctest::Approx(0.5));
}

TEST_CASE("pbrt goes on without a medium that is not known") {
  for (const PbrtFile& file : {v4_medium("\"string preset\" \"Ketchap\" " + kOwn),
                               v3_medium("\"string preset\" \"Ketchap\" " + kOwn),
                               v3_surface("\"string name\" \"Ketchap\" " + kOwn)}) {
    CHECK(absorption(file) == doctest::Approx(0.5));
    CHECK(file.messages.find("there is no medium \"Ketchap\" (did you mean \"ketchup\"?)") !=
          std::string::npos);
    CHECK(file.messages.find("the coefficients hold, as in pbrt") != std::string::npos);
  }
}
