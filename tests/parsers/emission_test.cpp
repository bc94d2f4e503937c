// Sensors, lights, textures, films and integrators that are rarely met, as both Mitsubas mean them.
#include "parsers/plugin_checks.h"
#include "support/tables.h"
#include "values/sun_position.h"
#include "values/sun_radiance.h"

using namespace duet;
using namespace duet::test;

namespace {

const std::string kMeter = "<sensor type='irradiancemeter'/>";

/// What a scene without a sensor of its own has.
ReadResult read_sensors(const std::string& version, const std::string& content) {
  return read_text("<scene version='" + version + "'><integrator type='path'/>" + content +
                   "</scene>");
}

void check_direction(const std::array<double, 3>& a, const std::array<double, 3>& b,
                     double tolerance) {
  for (size_t i = 0; i < 3; ++i) CHECK(std::abs(a[i] - b[i]) <= tolerance);
}

}  // namespace

TEST_CASE("meters are read with their places and targets") {
  SensorDescription s = sensor("3.0.0", "radiancemeter",
                               "<point name='origin' value='1 2 3'/><vector name='direction' "
                               "value='0 0 -2'/>");
  CHECK(s.kind == SensorKind::radiancemeter);
  check_direction({s.to_world[0][3], s.to_world[1][3], s.to_world[2][3]}, {1, 2, 3}, 1e-9);
  check_direction({s.to_world[0][2], s.to_world[1][2], s.to_world[2][2]}, {0, 0, -1}, 1e-9);
  s = sensor("3.0.0", "distant", "<point name='target' value='4 5 6'/>");
  CHECK(s.target_point == std::array<double, 3>{4, 5, 6});
  s = sensor("3.0.0", "distant", "<shape type='sphere' name='target'/>");
  REQUIRE(s.target_shape.size() == 1);
  CHECK(std::holds_alternative<SphereShape>(s.target_shape[0].geometry));
  s = sensor("0.6.0", "perspective_rdist", "<string name='kc' value='0.1, -0.2'/>");
  CHECK(s.distortion == std::array<double, 2>{0.1, -0.2});
  s = sensor("0.6.0", "telecentric", "<float name='apertureRadius' value='0.3'/>");
  CHECK(s.aperture_radius == 0.3);
  CHECK(s.focus_distance == s.far_clip);
  CHECK(sensor("0.6.0", "spherical").kind == SensorKind::spherical);
  CHECK(sensor("0.6.0", "fluencemeter").kind == SensorKind::fluencemeter);
  s = sensor("3.0.0", "batch", "<sensor type='perspective'/><sensor type='distant'/>");
  REQUIRE(s.parts.size() == 2);
  CHECK(s.parts[1].kind == SensorKind::distant);
}

TEST_CASE("an irradiance meter belongs to its shape") {
  const ReadResult r =
      read_sensors("3.0.0", "<shape type='disk'/><shape type='sphere'>" + kMeter + "</shape>");
  REQUIRE(r.scene);
  REQUIRE(r.description().sensors.size() == 1);
  CHECK(r.description().sensors[0].shape == 1);
  CHECK(read_sensors("3.0.0", kMeter).has("must stand in a shape"));
  CHECK(read_sensors("3.0.0", "<shape type='sphere'><sensor type='perspective'/></shape>")
            .has("cannot stand in a shape"));
  CHECK(read_sensors("3.0.0", "<shape type='shapegroup'><shape type='sphere'>" + kMeter +
                                  "</shape></shape><sensor type='perspective'/>")
            .has("cannot stand in"));
}

TEST_CASE("sensors that make no sense are errors") {
  const auto bad = [](const std::string& text, const std::string& message) {
    const ReadResult r = read_sensors("3.0.0", text);
    INFO(r.messages());
    CHECK_FALSE(r.scene);
    CHECK(r.has(message));
    CHECK(r.has("scene.xml:1:"));
  };
  bad("<sensor type='radiancemeter'><point name='origin' value='1 2 3'/></sensor>", "together");
  bad("<sensor type='distant'><vector name='direction' value='0 0 0'/></sensor>", "cannot be zero");
  bad("<sensor type='distant'><vector name='direction' value='0 0 1'/><transform name='to_world'>"
      "<scale value='2'/></transform></sensor>",
      "can be given");
  bad("<sensor type='distant'><shape type='sphere'/></sensor>", "one \"target\"");
  bad("<sensor type='distant'><shape type='sphere' name='target'><emitter type='area'/></shape>"
      "</sensor>",
      "neither shines");
  bad("<sensor type='batch'/>", "needs a sensor");
  bad("<sensor type='perspective_rdist'><string name='kc' value='1'/></sensor>",
      "two coefficients");
  bad("<sensor type='perspective'><spectrum name='srf' value='400:1, 700:2'/></sensor>",
      "refused: light is computed as red, green and blue");
  bad("<sensor type='spherical'><transform name='to_world'><scale value='2'/></transform></sensor>",
      "must not scale");
}

TEST_CASE("the sun of 0.x is as bright as the paper's model says") {
  const Json table = read_table("sun_0x");
  double most_watts = 0;
  for (const Json& row : table["sun"]) {
    INFO(row.dump());
    const double elevation = row[1];
    const Spectrum found = sun_irradiance_0x(row[0], (90 - elevation) * 3.14159265358979 / 180);
    const Spectrum expected = triple<Spectrum>(row, 2);
    for (int k = 0; k < 3; ++k) CHECK(std::abs(found[k] - expected[k]) <= 2e-4f * expected.max());
    most_watts = std::max(most_watts, row[5].get<double>());
  }
  // What reaches the ground between 350 and 800 nm is less than half of the solar constant.
  CHECK(most_watts > 400);
  CHECK(most_watts < 1361.0 / 2);
  // 683 lm/W and the integral of the luminous efficiency, 106.86 nm, make a luminance of one
  // 72,980 lx; a high sun in clear air yields about 100,000.
  CHECK(std::abs(double(sun_irradiance_0x(2, 0.4).luminance()) * 72980 - 100000) < 5000);
}

TEST_CASE("suns of 0.x have their size, scale and place") {
  const std::string low = "<vector name='sunDirection' x='0' y='0.5' z='-0.8660254'/>";
  const auto sun = [](const std::string& type, const std::string& content) {
    return light<SkyLight>("0.6.0", type, content).first;
  };
  SkyLight sky = sun("sun", "<float name='sunRadiusScale' value='3'/>");
  CHECK(sky.sky_scale == 0);
  CHECK(sky.sun_aperture == doctest::Approx(3 * 0.5358));
  sky = sun("sunsky", low + "<float name='turbidity' value='4.5'/>");
  REQUIRE(sky.disk);
  CHECK(sky.disk->irradiance.g == doctest::Approx(0.653931).epsilon(1e-3));
  check_direction(sky.disk->direction, sky.sun, 1e-6);
  // Stretching moves the disk, not what its brightness and the sky depend on.
  for (const char* type : {"sun", "sunsky"}) {
    const SkyLight stretched = sun(type, low +
                                             "<float name='turbidity' value='4.5'/>"
                                             "<float name='stretch' value='2'/>");
    REQUIRE(stretched.disk);
    CHECK(stretched.disk->irradiance == sky.disk->irradiance);
    check_direction(stretched.sun, sky.sun, 1e-9);
    check_direction(stretched.disk->direction, {0, 0.8660254, -0.5}, 1e-6);
  }
  // The two scales stand in the place of the common one.
  sky = sun("sunsky", "<float name='scale' value='2'/>");
  CHECK(sky.sun_scale == 2);
  CHECK(sky.sky_scale == 2);
  sky = sun("sunsky", "<float name='scale' value='2'/><float name='sunScale' value='3'/>");
  CHECK(sky.sun_scale == 3);
  CHECK(sky.sky_scale == 2);
  // The sun alone takes any turbidity, and none is as wide as the sky.
  CHECK(sun("sun", "<float name='turbidity' value='20'/>").disk);
  CHECK(fails("0.6.0", "<emitter type='sun'><float name='sunRadiusScale' value='700'/></emitter>",
              "not less than 180"));
  // Beside a direction, times are unused and places an error.
  sky = sun("sun", low + "<float name='hour' value='9'/>");
  check_direction(sky.sun, {0, 0.8660254, 0.5}, 1e-6);
  CHECK(fails("0.6.0", "<emitter type='sun'>" + low + "<integer name='day' value='9'/></emitter>",
              "either \"sun_direction\""));
}

TEST_CASE("a sun of 0.x without a size is a directional light") {
  const std::string content =
      "<vector name='sunDirection' x='1' y='2' z='3'/><float name='sunRadiusScale' value='0'/>"
      "<float name='scale' value='2'/><float name='samplingWeight' value='4'/>"
      "<transform name='toWorld'><rotate y='1' angle='40'/></transform>";
  const double length = std::sqrt(14.0);
  for (const std::string type : {"sun", "sunsky"}) {
    const SceneDescription d =
        good("0.6.0", "<emitter type='" + type + "'>" + content + "</emitter>");
    REQUIRE(d.lights.size() == (type == "sun" ? 1 : 2));
    const LightDescription& l = d.lights[0];
    REQUIRE(std::holds_alternative<DirectionalLight>(l.model));
    check_direction({l.to_world[0][2], l.to_world[1][2], l.to_world[2][2]},
                    {-1 / length, -2 / length, -3 / length}, 1e-6);
    CHECK(std::get<DirectionalLight>(l.model).irradiance.r ==
          doctest::Approx(2 * sun_irradiance_0x(3, std::acos(2 / length)).r));
    CHECK(l.sampling_weight == 4);
    if (type == "sun") continue;
    const SkyLight& sky = std::get<SkyLight>(d.lights[1].model);
    CHECK(sky.sun_scale == 0);
    CHECK(sky.sky_scale == 2);
  }
}

TEST_CASE("the sun stands where Mitsuba's stands") {
  const auto sun = [](const std::string& content) {
    return light<SkyLight>("3.0.0", "sunsky", content).first.sun;
  };
  check_direction(sun(""), {0.05138545, 0.69174796, 0.7203085}, 1e-3);
  check_direction(
      sun("<integer name='year' value='2024'/><integer name='month' value='2'/><integer name='day' "
          "value='29'/><float name='hour' value='9.5'/><float name='minute' value='12'/><float "
          "name='second' value='30'/><float name='latitude' value='51.5'/><float name='longitude' "
          "value='-0.12'/><float name='timezone' value='0'/>"),
      {0.6976201, -0.60466504, 0.38432583}, 1e-3);
  check_direction(sun("<float name='hour' value='6'/><float name='latitude' value='-33.9'/><float "
                      "name='longitude' value='151.2'/><float name='timezone' value='10'/><integer "
                      "name='month' value='12'/>"),
                  {0.29459327, -0.92015946, 0.25791726}, 1e-3);
  // At noon of the equinox on the equator it stands overhead.
  const SunAngles a = sun_angles({2010, 3, 20, 12.12, 0, 0}, {0, 0, 0});
  CHECK(a.zenith < 0.01);
}

TEST_CASE("skies are read as each Mitsuba means them") {
  auto [sky, to_world] = light<SkyLight>(
      "3.0.0", "sunsky",
      "<vector name='sun_direction' value='1 2 3'/><float name='turbidity' "
      "value='5'/><float name='sun_scale' value='0'/><float name='sun_aperture' "
      "value='2'/><transform name='to_world'><rotate z='1' angle='90'/></transform>");
  CHECK(sky.turbidity == 5);
  CHECK(sky.sun_scale == 0);
  CHECK(sky.sun_aperture == 2);
  CHECK(sky.albedo == Spectrum(0.3f));
  check_direction(sky.sun, {2, -1, 3}, 1e-9);
  std::tie(sky, to_world) =
      light<SkyLight>("0.6.0", "sky",
                      "<vector name='sunDirection' x='1' y='2' z='3'/><float name='scale' "
                      "value='4'/><boolean name='extend' value='true'/>");
  CHECK(sky.sky_scale == 4);
  CHECK(sky.sun_scale == 0);
  CHECK(sky.extend);
  CHECK(sky.albedo == Spectrum(0.2f));
  // Up is +y there, and the sun is where the file says.
  std::array<double, 3> world{}, up{};
  for (int i = 0; i < 3; ++i) {
    up[size_t(i)] = to_world[i][2];
    for (int j = 0; j < 3; ++j) world[size_t(i)] += to_world[i][size_t(j)] * sky.sun[size_t(j)];
  }
  check_direction(world, {1, 2, 3}, 1e-9);
  check_direction(up, {0, 1, 0}, 1e-9);
  sky = light<SkyLight>("3.0.0", "timed_sunsky").first;
  check_direction(sky.sun,
                  light<SkyLight>("3.0.0", "sunsky",
                                  "<integer name='year' value='2025'/><integer "
                                  "name='month' value='1'/><integer name='day' "
                                  "value='1'/><float name='hour' value='7'/>")
                      .first.sun,
                  1e-9);
  CHECK(fails("3.0.0", "<emitter type='sunsky'><float name='turbidity' value='11'/></emitter>",
              "is not between 1 and 10"));
  CHECK(fails("3.0.0",
              "<emitter type='sunsky'><vector name='sun_direction' value='0 0 1'/><float "
              "name='hour' value='3'/></emitter>",
              "either \"sun_direction\" or time and place"));
  CHECK(
      fails("3.0.0", "<emitter type='sunsky'/><emitter type='constant'/>", "one environment only"));
  CHECK(fails("0.6.0", "<emitter type='sky'><float name='hour' value='1'/></emitter>",
              "below the horizon"));
}

TEST_CASE("beams are read") {
  CHECK(light<CollimatedLight>("0.6.0", "collimated", "<spectrum name='power' value='3'/>")
            .first.power == Spectrum(3.0f));
  const SceneDescription d = good("3.0.0",
                                  "<shape type='disk'><emitter type='directionalarea'><rgb "
                                  "name='radiance' value='1 2 3'/></emitter></shape>");
  REQUIRE(d.shapes.back().emission);
  CHECK(d.shapes.back().emission->directional);
}

TEST_CASE("textures of both versions are read") {
  const auto grid = texture<GridLinesTexture>(
      "0.6.0", "gridtexture",
      "<float name='lineWidth' value='0.1'/><float name='uscale' value='2'/>");
  CHECK(grid.line_width == 0.1);
  CHECK(grid.color0 == ColorInput(Spectrum(0.2f)));
  CHECK(grid.to_uv.m[0][0] == 2);
  const auto scaled = texture<ScaledTextureDescription>(
      "0.6.0", "scale",
      "<float name='scale' value='0.5'/><texture type='bitmap'><string name='filename' "
      "value='a.png'/></texture>");
  CHECK(scaled.scale == Spectrum(0.5f));
  const auto volume = texture<VolumeTextureDescription>(
      "3.0.0", "volume",
      "<volume name='volume' type='constvolume'><rgb name='value' "
      "value='.1 .2 .3'/></volume>");
  CHECK(std::get<Spectrum>(volume.volume) == Spectrum(0.1f, 0.2f, 0.3f));
}

TEST_CASE("films of 0.6 become EXR images") {
  const FilmDescription m = film("0.6.0", "mfilm", "");
  CHECK(m.width == 1);
  CHECK(m.height == 1);
  CHECK(m.pixel_format == PixelFormat::luminance);
  CHECK(m.filter.kind == FilterKind::box);
  CHECK(film("0.6.0", "tiledhdrfilm", "<integer name='width' value='7'/>").width == 7);
  CHECK(film("0.6.0", "hdrfilm", "<string name='pixelFormat' value='rgba, luminance'/>")
            .pixel_format == PixelFormat::rgba);
}

TEST_CASE("integrators that Duet does not have are run as those that fit best") {
  const auto path = std::get<PathIntegratorDescription>(
      integrator("3.0.0",
                 "<integrator type='prb'><boolean name='hide_emitters' value='true'/>"
                 "</integrator>")
          .method);
  CHECK(path.max_depth == 6);
  CHECK(path.hide_emitters);
  for (const char* name : {"prb_basic", "prb_projective"})
    CHECK(std::holds_alternative<PathIntegratorDescription>(
        integrator("3.0.0", std::string("<integrator type='") + name + "'/>").method));
  CHECK(std::holds_alternative<VolumePathIntegratorDescription>(
      integrator("3.0.0", "<integrator type='prbvolpath'/>").method));
  CHECK(std::holds_alternative<DirectIntegratorDescription>(
      integrator("3.0.0", "<integrator type='direct_projective'/>").method));
  for (const char* name : {"mlt", "erpt", "pssmlt"}) {
    const auto d = std::get<BidirectionalIntegratorDescription>(
        integrator("0.6.0", std::string("<integrator type='") + name +
                                "'><integer name='maxDepth' value='9'/></integrator>")
            .method);
    CHECK(d.method == BidirectionalMethod::bdpt);
    CHECK(d.max_depth == 9);
  }
  CHECK(std::get<PathIntegratorDescription>(integrator("0.6.0", "<integrator type='vpl'/>").method)
            .max_depth == 5);
  for (const char* name : {"irrcache", "adaptive"})
    CHECK(std::holds_alternative<DirectIntegratorDescription>(
        integrator("0.6.0", std::string("<integrator type='") + name +
                                "'><integrator type='direct'/></integrator>")
            .method));
  CHECK(std::holds_alternative<PathIntegratorDescription>(
      integrator("3.0.0", "<integrator type='stokes'><integrator type='path'/></integrator>")
          .method));
  const ReadResult warned = read_text(
      "<scene version='0.6.0'><sensor type='perspective'/><integrator type='pssmlt'/></scene>");
  CHECK(warned.has("the integrator \"pssmlt\" is run as \"bdpt\""));
}

TEST_CASE("fields are layers, alone or beside an image") {
  const IntegratorDescription field = integrator(
      "0.6.0", "<integrator type='field'><string name='field' value='shNormal'/></integrator>");
  CHECK_FALSE(field.image);
  REQUIRE(field.aovs.layers.size() == 1);
  CHECK(field.aovs.layers[0].kind == "sh_normal");
  const IntegratorDescription both = integrator(
      "0.6.0",
      "<integrator type='multichannel'><integrator type='path'/><integrator type='field'><string "
      "name='field' value='distance'/></integrator><integrator type='field'><string name='field' "
      "value='uv'/></integrator></integrator>");
  CHECK(both.image);
  CHECK(std::holds_alternative<PathIntegratorDescription>(both.method));
  REQUIRE(both.aovs.layers.size() == 2);
  CHECK(both.aovs.layers[0].kind == "depth");
  const auto bad = [](const std::string& content, const std::string& message) {
    const ReadResult r =
        read_text("<scene version='0.6.0'><sensor type='perspective'/>" + content + "</scene>");
    INFO(r.messages());
    CHECK_FALSE(r.scene);
    CHECK(r.has(message));
  };
  bad("<integrator type='field'><string name='field' value='relPosition'/></integrator>",
      "relative to the camera");
  bad("<integrator type='field'><string name='field' value='normals'/></integrator>",
      "unknown field");
  bad("<integrator type='multichannel'><integrator type='path'/><integrator type='direct'/>"
      "</integrator>",
      "not two");
  bad("<integrator type='multichannel'/>", "needs an integrator");
  bad("<integrator type='motion'/>", "is refused");
}

TEST_CASE("environments: scales are left out, and said to be") {
  const auto has_warning = [](const std::string& type, const std::string& steps) {
    MemoryFiles files;
    files.texts["/scene/a.png"] = "x";
    const std::string file =
        type == "envmap" ? "<string name='filename' value='a.png'/>" : std::string();
    const ReadResult r =
        read_scene("3.0.0",
                   "<emitter type='" + type + "'>" + file + "<transform name='to_world'>" + steps +
                       "</transform></emitter>",
                   files);
    REQUIRE_MESSAGE(r.scene, r.messages());
    return r.has("also scales, which is left out");
  };
  for (const char* type : {"envmap", "sunsky", "timed_sunsky"}) {
    CAPTURE(type);
    CHECK(has_warning(type, "<scale value='2'/>"));
    CHECK(has_warning(type, "<scale x='2' y='0.5' z='1'/>"));
    CHECK(!has_warning(type, "<scale x='-1'/><rotate x='1' angle='40'/>"));
  }
  CHECK(!has_warning("constant", "<scale value='2'/>"));
  // The sun stands where the file says, at any distance.
  const auto [sky, to_world] = light<SkyLight>(
      "3.0.0", "sunsky",
      "<vector name='sun_direction' value='1 2 3'/><transform name='to_world'><scale x='2' "
      "y='0.5' z='1'/></transform>");
  check_direction(sky.sun, {0.5, 1, 1.5}, 1e-6);
}
