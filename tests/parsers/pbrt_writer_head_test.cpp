// What stands before the world of a pbrt-v4 file that is written: camera, film and integrator.
#include "pbrt/writer.h"

#include <doctest/doctest.h>

#include "support/pbrt_round_trip.h"

using namespace duet;
using namespace duet::test;

namespace {

/// The sensor of a file with these directives before its world, and of what is written of it.
std::pair<SensorDescription, SensorDescription> both_sensors(const std::string& head) {
  const SceneDescription d = read_pbrt_text(head + "\nWorldBegin\n", false);
  const pbrt::PbrtText written = pbrt::write_pbrt(d);
  CHECK(written.losses == std::vector<std::string>{});
  CAPTURE(written.text);
  return {d.sensors.at(0), read_pbrt_text(written.text, false).sensors.at(0)};
}

void check_close(const Matrix4& a, const Matrix4& b) {
  for (int i = 0; i < 4; ++i)
    for (size_t k = 0; k < 4; ++k) CHECK(a[i][k] == doctest::Approx(b[i][k]).epsilon(1e-12));
}

}  // namespace

TEST_CASE("pbrt writer: cameras survive") {
  const std::string film = "Film \"rgb\" \"integer xresolution\" 40 \"integer yresolution\" 30\n";
  const std::string place = "LookAt 1 2 3 4 5 7 0 1 0 Scale -1 1 1\n";
  for (const std::string camera :
       {"\"perspective\" \"float fov\" 50", "\"perspective\" \"float screenwindow\" [-1 2 -0.5 1]",
        "\"perspective\" \"float lensradius\" 0.5 \"float focaldistance\" 7",
        "\"perspective\" \"float lensradius\" 0.5 \"float frameaspectratio\" 2",
        "\"orthographic\" \"float screenwindow\" [-2 4 -1.5 3]",
        "\"orthographic\" \"float lensradius\" 0.5 \"float focaldistance\" 7", "\"spherical\"",
        "\"spherical\" \"string mapping\" \"equirectangular\"",
        "\"perspective\" \"float frameaspectratio\" 2",
        "\"perspective\" \"float shutteropen\" 1 \"float shutterclose\" 3"})
    for (const std::string portrait : {"", "tall"}) {
      CAPTURE(camera + portrait);
      std::string head = film + place + "Camera " + camera;
      if (!portrait.empty()) std::swap(head[head.find("40")], head[head.find("30")]);
      const auto [a, b] = both_sensors(head);
      CHECK(a.kind == b.kind);
      CHECK(a.fov == doctest::Approx(b.fov).epsilon(1e-12));
      CHECK(a.principal_point_offset_x == doctest::Approx(b.principal_point_offset_x));
      CHECK(a.principal_point_offset_y == doctest::Approx(b.principal_point_offset_y));
      CHECK(a.aperture_radius == doctest::Approx(b.aperture_radius));
      CHECK(a.aperture_aspect == doctest::Approx(b.aperture_aspect).epsilon(1e-12));
      CHECK(a.focus_distance == doctest::Approx(b.focus_distance));
      CHECK(a.sphere_mapping == b.sphere_mapping);
      CHECK(a.shutter == b.shutter);
      CHECK(a.film == b.film);
      check_close(a.to_world, b.to_world);
    }
}

TEST_CASE("pbrt writer: films, filters and samples survive") {
  const std::string film = "Film \"rgb\" \"integer xresolution\" 40 \"integer yresolution\" 30 ";
  for (const std::string& head :
       {film + "\"bool savefp16\" false", film + "\"integer pixelbounds\" [3 20 4 30]",
        film + "\"float iso\" 200", film + "\"float maxcomponentvalue\" 4 \"float iso\" 50",
        film + "PixelFilter \"box\" \"float xradius\" 2", film + "PixelFilter \"triangle\"",
        film + "PixelFilter \"gaussian\" \"float sigma\" 0.75 \"float yradius\" 3",
        film + "PixelFilter \"mitchell\" \"float B\" 0.25 \"float C\" 0.375",
        film + "PixelFilter \"sinc\"", film + "Sampler \"halton\" \"integer pixelsamples\" 7"}) {
    CAPTURE(head);
    const auto [a, b] = both_sensors(head + "\nCamera \"orthographic\"");
    CHECK(a.film == b.film);
    CHECK(a.sampler.sample_count == b.sampler.sample_count);
    CHECK(a.sampler.name == b.sampler.name);
  }
  for (const double kelvin : {2000.0, 3000.0, 4000.0, 5600.0, 6500.5, 12000.0}) {
    const auto [a, b] =
        both_sensors(film + fmt::format("\"float whitebalance\" {} \"float iso\" 300", kelvin) +
                     "\nCamera \"orthographic\"");
    for (size_t i = 0; i < 3; ++i)
      for (size_t k = 0; k < 3; ++k)
        CHECK(a.film.response.value()[i][k] ==
              doctest::Approx(b.film.response.value()[i][k]).epsilon(1e-9));
  }
}

TEST_CASE("pbrt's light samplers are selections of lights") {
  const auto selection = [](const std::string& integrator) {
    return light_selection(
        read_pbrt_text("Integrator " + integrator + " Camera \"orthographic\"\nWorldBegin\n", false)
            .integrator);
  };
  using enum LightSelection;
  CHECK(selection("\"path\"") == automatic);
  CHECK(selection("\"volpath\" \"string lightsampler\" \"bvh\"") == bvh);
  CHECK(selection("\"path\" \"string lightsampler\" \"exhaustive\"") == bvh);
  CHECK(selection("\"bdpt\" \"string lightsampler\" \"uniform\"") == uniform);
  CHECK(selection("\"path\" \"string lightsamplestrategy\" \"power\"") == power);
  CHECK(selection("\"path\" \"string lightsamplestrategy\" \"spatial\"") == automatic);
}

TEST_CASE("pbrt writer: integrators survive") {
  for (const std::string integrator :
       {"\"path\" \"integer maxdepth\" 3", "\"volpath\" \"integer maxdepth\" 12",
        "\"path\" \"string lightsampler\" \"power\"", "\"bdpt\" \"string lightsampler\" \"bvh\"",
        "\"bdpt\" \"integer maxdepth\" 4", "\"lightpath\" \"integer maxdepth\" 4",
        "\"sppm\" \"float radius\" 0.25", "\"sppm\" \"integer photonsperiteration\" 5000",
        "\"ambientocclusion\"", "\"ambientocclusion\" \"float maxdistance\" 3"}) {
    CAPTURE(integrator);
    const SceneDescription d = read_pbrt_text(
        "Integrator " + integrator + " Camera \"orthographic\"\nWorldBegin\n", false);
    const pbrt::PbrtText written = pbrt::write_pbrt(d);
    CHECK(written.losses == std::vector<std::string>{});
    CHECK(read_pbrt_text(written.text, false).integrator == d.integrator);
  }
}
