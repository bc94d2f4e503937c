// What the photon mapping of pbrt files asks for.
#include <doctest/doctest.h>

#include "support/pbrt_file.h"

using namespace duet;
using namespace duet::test;

namespace {

const std::string kFilm =
    " \"integer xresolution\" 40 \"integer yresolution\" 25\nSampler \"halton\" \"integer "
    "pixelsamples\" 7\nIntegrator \"sppm\" ";

PbrtFile v3_file(const std::string& parameters, const std::string& material = "matte") {
  return read_pbrt_file_of("Film \"image\"" + kFilm + parameters + "\nWorldBegin\nMaterial \"" +
                           material + "\"\nShape \"sphere\"\nWorldEnd\n");
}
PbrtFile v4_file(const std::string& parameters, const std::string& material = "diffuse") {
  return read_pbrt_file_of("Film \"rgb\"" + kFilm + parameters + "\nWorldBegin\nMaterial \"" +
                           material + "\"\nShape \"sphere\"\n");
}
int samples(const PbrtFile& file) {
  return scene_of(file).sensors.at(0).sampler.sample_count;
}

}  // namespace

TEST_CASE("pbrt-v3's sppm has iterations of its own, v4's takes the sampler's") {
  CHECK(samples(v3_file("")) == 64);
  CHECK(samples(v3_file("\"integer numiterations\" 3")) == 3);
  CHECK(samples(v3_file("\"integer numiterations\" 3 \"integer iterations\" 5")) == 5);
  CHECK(samples(v4_file("\"integer iterations\" 5")) == 7);
  const PbrtFile none = v3_file("\"integer iterations\" 0");
  CHECK_FALSE(none.scene);
  CHECK(none.messages.find("the number of iterations cannot be 0") != std::string::npos);
}

TEST_CASE("pbrt's sppm: photons of an iteration") {
  const auto paths = [](const PbrtFile& file) {
    return std::get<BidirectionalIntegratorDescription>(scene_of(file).integrator.method)
        .light_paths;
  };
  CHECK(paths(v4_file("")) == 0);
  CHECK(paths(v4_file("\"integer photonsperiteration\" 2500")) == 2.5);
  CHECK(paths(v3_file("\"integer photonsperiteration\" 500")) == 0.5);
}

TEST_CASE("pbrt's sppm: what mirrors and glass show has paths that are cut short") {
  const auto warns = [](const PbrtFile& file) {
    return file.messages.find("photons have met fewer surfaces than in pbrt") != std::string::npos;
  };
  CHECK_FALSE(warns(v3_file("")));
  CHECK_FALSE(warns(v4_file("")));
  CHECK(warns(v3_file("", "mirror")));
  CHECK(warns(v4_file("\"integer maxdepth\" 3", "dielectric")));
}
