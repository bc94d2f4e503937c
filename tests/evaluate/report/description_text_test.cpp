// The lines of `duet info` about lights, sensors and films: what their fields say.
#include "evaluate/report/description_text.h"

#include <doctest/doctest.h>

#include "support/memory_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

SceneDescription described(const std::string& version, const std::string& content) {
  const ReadResult r = read_scene(version, content, {{{"/scene/sky.exr", "x"}}});
  REQUIRE_MESSAGE(r.scene, r.messages());
  return r.description();
}

std::string light_line(const std::string& version, const std::string& light) {
  const SceneDescription d = described(version, light);
  return DescriptionText(d).light(d.lights.at(0));
}

SceneDescription seen_by(const std::string& version, const std::string& sensor) {
  const ReadResult r =
      read_text("<scene version='" + version + "'><integrator type='path'/>" + sensor + "</scene>");
  REQUIRE_MESSAGE(r.scene, r.messages());
  return r.description();
}

std::string sensor_line(const std::string& version, const std::string& sensor) {
  const SceneDescription d = seen_by(version, sensor);
  return DescriptionText(d).sensor(d.sensors.at(0));
}

std::string film_line(const std::string& version, const std::string& film) {
  const SceneDescription d = seen_by(version, "<sensor type='perspective'>" + film + "</sensor>");
  return DescriptionText(d).film(d.sensors.at(0).film);
}

const std::string kAtOrigin = " at (0, 0, 0) towards (0, 0, 1)";

}  // namespace

TEST_CASE("the line of a light says all its fields, and its place where it has one") {
  CHECK(light_line("3.0.0",
                   "<emitter type='spot'><float name='cutoff_angle' value='12.3456'/></emitter>") ==
        "spot" + kAtOrigin + ": 1, cutoff angle 12.3456, beam width 9.2592");
  CHECK(light_line("3.0.0",
                   "<emitter type='projector'><float name='fov' value='30'/><float name='scale' "
                   "value='2'/><rgb name='irradiance' value='1 2 3'/></emitter>") ==
        "projector" + kAtOrigin + ": 1 2 3, scale 2, fov 30 along x");
  CHECK(light_line("0.6.0",
                   "<emitter type='envmap'><string name='filename' value='sky.exr'/><float "
                   "name='gamma' value='2.5'/></emitter>") ==
        "envmap: /scene/sky.exr, scale 1, gamma 2.5");
  CHECK(light_line("3.0.0",
                   "<emitter type='sunsky'><vector name='sun_direction' value='0 0 1'/><float "
                   "name='turbidity' value='4'/></emitter>") ==
        "sunsky of turbidity 4, albedo 0.3, scale 1, sun 1, aperture 0.5358, direction (0, 0, 1)");
  // The sun of 0.x has an irradiance of its own.
  CHECK(light_line("0.6.0",
                   "<emitter type='sunsky'><vector name='sunDirection' x='0' y='1' "
                   "z='0'/></emitter>")
            .find(", disk of irradiance ") != std::string::npos);
}

TEST_CASE("the line of a sensor says what its kind has, and what is not as usual") {
  CHECK(
      sensor_line("3.0.0", "<sensor type='perspective'><float name='fov' value='40'/></sensor>") ==
      "perspective" + kAtOrigin + ", fov 40 along x");
  CHECK(sensor_line("3.0.0",
                    "<sensor type='thinlens'><float name='fov' value='40'/><float "
                    "name='aperture_radius' value='0.5'/><float name='focus_distance' "
                    "value='3'/><float name='near_clip' value='0.5'/><float name='shutter_close' "
                    "value='2'/></sensor>") ==
        "thinlens" + kAtOrigin +
            ", shutter (0, 2), near clip 0.5, fov 40 along x, aperture radius 0.5, focus at 3");
  CHECK(sensor_line("3.0.0",
                    "<sensor type='perspective'><float name='fov' value='40'/><float "
                    "name='principal_point_offset_x' value='0.25'/></sensor>") ==
        "perspective" + kAtOrigin + ", fov 40 along x, principal point offset x 0.25");
  CHECK(sensor_line("3.0.0",
                    "<sensor type='distant'><point name='target' value='1 2 3'/></sensor>") ==
        "distant" + kAtOrigin + ", target (1, 2, 3)");
}

TEST_CASE("the line of a film says its size, window, formats and filter") {
  CHECK(film_line("3.0.0",
                  "<film type='hdrfilm'><integer name='width' value='40'/><integer name='height' "
                  "value='30'/><integer name='crop_offset_x' value='1'/><integer "
                  "name='crop_offset_y' value='2'/><integer name='crop_width' "
                  "value='3'/><integer name='crop_height' value='4'/><string "
                  "name='component_format' value='float32'/><rfilter type='mitchell'><float "
                  "name='B' value='0.25'/></rfilter></film>") ==
        "40x30, window 1,2,3,4, rgb float32, mitchell filter, B 0.25, C 0.333333");
  CHECK(film_line("0.6.0",
                  "<film type='ldrfilm'><string name='tonemapMethod' value='reinhard'/><float "
                  "name='key' value='0.5'/></film>")
            .find(", tone mapping by Reinhard's operator, key 0.5") != std::string::npos);
}
