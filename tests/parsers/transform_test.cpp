// Transforms in scene files.
#include <doctest/doctest.h>

#include "parsers/plugin_checks.h"

using namespace duet;
using namespace duet::test;

namespace {

Matrix4 transform(const std::string& version, const std::string& steps) {
  const ReadResult r = read_scene(version, "<shape type='rectangle'><transform name='to_world'>" +
                                               steps + "</transform></shape>");
  if (!r.scene) throw std::runtime_error(r.messages());
  return r.description().shapes[0].to_world;
}

}  // namespace

TEST_CASE("transforms in all their forms") {
  const std::array<double, 16> moved{1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1};
  check_matrix(transform("3.0.0", "<translate x='1' y='2' z='3'/>"), moved);
  check_matrix(transform("3.0.0", "<translate value='1, 2 3'/>"), moved);
  check_matrix(transform("0.6.0", "<matrix value='1 0 0 1, 0 1 0 2, 0 0 1 3, 0 0 0 1'/>"), moved);
  check_matrix(transform("3.0.0", "<translate value='1'/>"),
               {1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 0, 1});
  check_matrix(transform("3.0.0", "<scale value='2'/>"),
               {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1});
  check_matrix(transform("3.0.0", "<scale value='2 3 4'/>"),
               {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1});
  check_matrix(transform("0.6.0", "<scale y='3'/>"),
               {1, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  check_matrix(transform("3.0.0", "<rotate y='1' angle='90'/>"),
               {0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1});
  check_matrix(transform("3.0.0", "<rotate value='0 1 0' angle='90'/>"),
               {0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1});
  check_matrix(transform("3.0.0", "<matrix value='1 2 3 0 1 4 5 6 0'/>"),
               {1, 2, 3, 0, 0, 1, 4, 0, 5, 6, 0, 0, 0, 0, 0, 1});
  // The first step is applied first.
  check_matrix(transform("3.0.0", "<scale x='2'/><translate x='1'/>"),
               {2, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
}

TEST_CASE("lookat") {
  // Numbers of Mitsuba 3.9.1.
  check_matrix(transform("3.0.0", "<lookat origin='1 2 3' target='4, 6, 9'/>"),
               {0.111254, 0.91656, 0.384111, 1, -0.851662, -0.111254, 0.512148, 2, 0.512148,
                -0.384111, 0.768221, 3, 0, 0, 0, 1},
               1e-5);
  check_matrix(transform("3.0.0", "<lookat origin='0 0 0' target='0 0 1'/>"),
               {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  for (const char* version : {"0.6.0", "3.0.0"})
    for (const char* tag : {"lookat", "lookAt"})
      check_matrix(transform(version, std::string("<") + tag +
                                          " origin='0, 0,-5  ' target='0 ,0 0' up = '0,   1,0'/>"),
                   {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -5, 0, 0, 0, 1});
}

TEST_CASE("the axis of a rotation: normalised in 0.x, used as it is by Mitsuba 3") {
  const std::string rotate = "<rotate y='2' angle='90'/>";
  check_matrix(transform("0.6.0", rotate), {0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1});
  // Mitsuba 3.9.1: [[0, 0, 2], [0, 4, 0], [-2, 0, 0]]
  check_matrix(transform("3.0.0", rotate), {0, 0, 2, 0, 0, 4, 0, 0, -2, 0, 0, 0, 0, 0, 0, 1});
  CHECK(read_scene("3.0.0", "<shape type='cube'><transform name='to_world'>" + rotate +
                                "</transform></shape>")
            .has("does not normalise the axis"));
}
