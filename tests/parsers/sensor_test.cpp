// What the parameters of lights, sensors, films, samplers and integrators become. Values that
// Mitsuba sets itself are those of 3.9.1.
#include <doctest/doctest.h>

#include "parsers/plugin_checks.h"

using namespace duet;
using namespace duet::test;

namespace {

/// Whether a message about such a scene contains the text.
bool says(const std::string& content, const std::string& text) {
  return read_text("<scene version='3.0.0'>" + content + "</scene>").has(text);
}

}  // namespace

TEST_CASE("emitters") {
  const auto spot =
      light<SpotLight>("0.6.0", "spot",
                       "<float name='cutoffAngle' value='40'/><texture name='texture' "
                       "type='checkerboard'/>")
          .first;
  CHECK(spot.cutoff_angle == 40);
  CHECK(spot.beam_width == 30);
  CHECK(spot.texture == TextureId{0});
  CHECK(light<SpotLight>("3.0.0", "spot").first == SpotLight{});
  CHECK(fails("0.6.0", "<emitter type='spot'><float name='beam_width' value='30'/></emitter>",
              "greater than the cutoff angle"));

  const auto [projector, at] =
      light<ProjectorLight>("3.0.0", "projector",
                            "<float name='fov' value='30'/><string name='fov_axis' "
                            "value='y'/><float name='scale' value='4'/>"
                            "<transform name='to_world'><translate x='5'/></transform>");
  CHECK(projector.fov == 30);
  CHECK(projector.fov_axis == FovAxis::y);
  CHECK(projector.scale == 4);
  CHECK(at[0][3] == 5);
  const auto lens = light<ProjectorLight>("3.0.0", "projector").first;
  CHECK(lens.fov_axis == FovAxis::diagonal);
  CHECK(lens.fov == doctest::Approx(46.7930));

  const auto sun = light<DirectionalLight>(
      "3.0.0", "directional",
      "<vector name='direction' value='1 2 3'/><rgb name='irradiance' value='2'/>");
  CHECK(sun.first.irradiance == Spectrum(2.0f));
  CHECK(sun.second[0][2] == doctest::Approx(0.267261));
  CHECK(sun.second[1][2] == doctest::Approx(0.534522));
  CHECK(sun.second[2][2] == doctest::Approx(0.801784));
  CHECK(sun.second.determinant3() == doctest::Approx(1));
  CHECK(fails("3.0.0",
              "<emitter type='directional'><vector name='direction' value='0 0 0'/></emitter>",
              "cannot be zero"));
  CHECK(fails("3.0.0",
              "<emitter type='point'><point name='position' value='1 2 3'/><transform "
              "name='to_world'/></emitter>",
              "either \"position\" or \"to_world\""));
  CHECK(light<PointLight>("3.0.0", "point",
                          "<transform name='to_world'><lookat origin='1 2 3' target='0 0 0' "
                          "up='0 1 0'/></transform>")
            .second == Matrix4::translate(1, 2, 3));

  const auto map = light<EnvironmentMapLight>(
      "0.6.0", "envmap",
      "<string name='filename' value='b.exr'/><float name='scale' value='2'/>"
      "<float name='gamma' value='-1'/><boolean name='cache' value='false'/>");
  EnvironmentMapLight expected;
  expected.file = "/scene/b.exr", expected.scale = 2, expected.gamma = -1.0;
  CHECK(map.first == expected);
  CHECK(fails("3.0.0", "<emitter type='constant'/><emitter type='constant'/>",
              "one environment only"));
  CHECK(fails("3.0.0",
              "<emitter type='point'><texture name='intensity' type='checkerboard'/></emitter>",
              "cannot be a texture"));
  CHECK(good("3.0.0", "<emitter type='point'><float name='sampling_weight' value='3'/></emitter>")
            .lights[0]
            .sampling_weight == 3);
}

TEST_CASE("sensors") {
  // x_fov of Mitsuba 3.9.1 for 768 × 576 pixels
  const auto xfov = [](const std::string& content) {
    const SensorDescription s = sensor("3.0.0", "perspective", content);
    return horizontal_fov(s.fov, s.fov_axis, 768.0 / 576);
  };
  CHECK(xfov("<string name='focal_length' value='35 mm'/>") ==
        doctest::Approx(52.62254333496094).epsilon(1e-6));
  CHECK(xfov("<string name='focal_length' value='50'/>") ==
        doctest::Approx(38.18484115600586).epsilon(1e-6));
  CHECK(xfov("<float name='fov' value='40'/>") == doctest::Approx(40));
  CHECK(xfov("<float name='fov' value='40'/><string name='fov_axis' value='Smaller'/>") > 40);

  const SensorDescription p = sensor("3.0.0", "perspective",
                                     "<float name='principal_point_offset_x' value='0.1'/>"
                                     "<float name='principal_point_offset_y' value='-0.2'/>"
                                     "<float name='focus_distance' value='3'/>");
  CHECK(p.principal_point_offset_x == 0.1);
  CHECK(p.principal_point_offset_y == -0.2);
  const SensorDescription lens =
      sensor("3.0.0", "thinlens", "<float name='aperture_radius' value='0.5'/>");
  CHECK(lens.aperture_radius == 0.5);
  CHECK(lens.focus_distance == 10000);
  CHECK(
      sensor("3.0.0", "orthographic", "<transform name='to_world'><scale x='2' y='2'/></transform>")
          .to_world[0][0] == 2);

  const auto bad = [](const std::string& type, const std::string& content,
                      const std::string& message) {
    return says("<sensor type='" + type + "'>" + content + "</sensor>", message);
  };
  CHECK(bad("thinlens", "", "needs the parameter \"aperture_radius\""));
  CHECK(bad("perspective", "<float name='fov' value='180'/>", "must be between 0 and 180"));
  CHECK(bad("perspective", "<float name='near_clip' value='0'/>", "must be positive"));
  CHECK(bad("perspective", "<float name='near_clip' value='3'/><float name='far_clip' value='2'/>",
            "not smaller"));
  CHECK(bad("perspective",
            "<float name='fov' value='40'/><string name='focal_length' value='35mm'/>",
            "either \"fov\" or \"focal_length\""));
  CHECK(bad("perspective", "<transform name='to_world'><scale x='2'/></transform>",
            "must not scale"));
  CHECK(!bad("perspective", "<transform name='to_world'><scale x='-1'/></transform>",
             "must not scale"));
  CHECK(
      bad("perspective", "<film type='hdrfilm'/><film type='hdrfilm'/>", "can have only one film"));
  CHECK(bad("perspective", "<string name='fov_axis' value='y'/>",
            "warning: the parameter \"fov_axis\""));
}

TEST_CASE("films and filters") {
  const FilmDescription f =
      film("3.0.0", "hdrfilm",
           "<integer name='width' value='100'/><integer name='height' value='50'/>"
           "<integer name='crop_width' value='10'/><string name='pixel_format' value='RGBA'/>"
           "<string name='component_format' value='Float32'/>");
  CHECK(f.width == 100);
  CHECK(f.crop == CropWindow{0, 0, 10, 50});
  CHECK(f.pixel_format == PixelFormat::rgba);
  CHECK(f.component_format == ComponentFormat::single);
  CHECK(!film("3.0.0", "hdrfilm", "<integer name='crop_width' value='768'/>").crop);
  CHECK(!f.tone_mapping);

  const FilmDescription ldr =
      film("0.6.0", "ldrfilm",
           "<string name='tonemapMethod' value='reinhard'/><float name='exposure' value='1.5'/>"
           "<float name='key' value='0.3'/><float name='burn' value='0.1'/><float name='gamma' "
           "value='2.2'/>");
  CHECK(ldr.tone_mapping == ToneMapping{true, 2.2, 1.5, 0.3, 0.1});
  CHECK(film("0.6.0", "ldrfilm", "").tone_mapping == ToneMapping{});

  const auto filter = [](const std::string& type, const std::string& content = "") {
    return film("3.0.0", "hdrfilm", "<rfilter type='" + type + "'>" + content + "</rfilter>")
        .filter;
  };
  // Radii of Mitsuba 3.9.1's filters.
  CHECK(filter_radius(filter("box")) == 0.5);
  CHECK(filter_radius(filter("tent")) == 1);
  CHECK(filter_radius(filter("gaussian")) == 2);
  CHECK(filter_radius(filter("mitchell")) == 2);
  CHECK(filter_radius(filter("catmullrom")) == 2);
  CHECK(filter_radius(filter("lanczos")) == 3);
  CHECK(filter("gaussian", "<float name='stddev' value='0.3'/>").stddev == 0.3);
  CHECK(filter("tent", "<float name='radius' value='2'/>").radius == 2);
  CHECK(filter("mitchell", "<float name='B' value='0.2'/><float name='C' value='0.4'/>").c == 0.4);
  CHECK(filter("lanczos", "<integer name='lobes' value='4'/>").lobes == 4);

  const auto bad = [](const std::string& content, const std::string& message) {
    return says("<sensor type='perspective'><film type='hdrfilm'>" + content + "</film></sensor>",
                message);
  };
  CHECK(bad("<integer name='width' value='0'/>", "must be from 1 to 65536, not 0"));
  CHECK(bad("<integer name='width' value='1000000000'/>", "must be from 1 to 65536"));
  CHECK(bad("<integer name='width' value='60000'/><integer name='height' value='60000'/>",
            "is too large"));
  CHECK(bad("<integer name='crop_offset_x' value='10'/>", "does not lie in the image"));
  CHECK(bad("<string name='component_format' value='uint8'/>", "it is one of float16, float32"));
  CHECK(bad("<rfilter type='gaussian'><float name='stddev' value='1e6'/></rfilter>", "too wide"));
  CHECK(bad("<boolean name='banner' value='true'/>", "warning: the parameter \"banner\""));
  CHECK(!bad("<boolean name='banner' value='false'/>", "banner"));
  const std::string border = "<boolean name='sample_border' value='true'/>";
  CHECK(bad(border, "warning: no samples are taken beyond the edges of the image"));
  CHECK(!bad(border + "<rfilter type='box'/>", "no samples"));
  CHECK(!bad("<boolean name='sample_border' value='false'/>", "no samples"));
}

TEST_CASE("samplers") {
  for (const char* name : {"independent", "stratified", "multijitter", "orthogonal", "ldsampler",
                           "sobol", "halton", "hammersley"}) {
    const SamplerDescription s = sensor("0.6.0", "perspective",
                                        std::string("<sampler type='") + name +
                                            "'><integer name='sampleCount' value='9'/>"
                                            "<integer name='seed' value='3'/></sampler>")
                                     .sampler;
    CHECK(s == SamplerDescription{name, 9, 3});
  }
}

TEST_CASE("integrators") {
  using Path = PathIntegratorDescription;
  using Direct = DirectIntegratorDescription;
  CHECK(std::get<Path>(integrator("3.0.0", "<integrator type='path'/>").method) == Path{});
  CHECK(std::get<Path>(integrator("0.6.0",
                                  "<integrator type='path'><integer name='maxDepth' value='-1'/>"
                                  "<boolean name='strictNormals' value='true'/></integrator>")
                           .method)
            .strict_normals);
  CHECK(std::get<Path>(integrator("3.0.0",
                                  "<integrator type='path'><string name='light_selection' "
                                  "value='power'/></integrator>")
                           .method)
            .light_selection == LightSelection::power);
  CHECK(
      std::get<Direct>(
          integrator(
              "3.0.0",
              "<integrator type='direct'><integer name='shading_samples' value='3'/></integrator>")
              .method) == Direct{3, 3, false, false});
  CHECK(std::get<Direct>(
            integrator("0.6.0",
                       "<integrator type='direct'><integer name='shadingSamples' value='3'/>"
                       "<integer name='bsdfSamples' value='2'/></integrator>")
                .method) == Direct{3, 2, false, false});
  CHECK(std::holds_alternative<DepthIntegratorDescription>(
      integrator("3.0.0", "<integrator type='depth'/>").method));
  using Occlusion = OcclusionIntegratorDescription;
  CHECK(std::get<Occlusion>(integrator("0.6.0", "<integrator type='ao'/>").method) == Occlusion{});
  CHECK(std::get<Occlusion>(
            integrator("0.6.0",
                       "<integrator type='ao'><integer name='shadingSamples' value='4'/>"
                       "<float name='rayLength' value='2.5'/></integrator>")
                .method) == Occlusion{4, 2.5});

  const IntegratorDescription aov = integrator(
      "3.0.0",
      "<integrator type='aov'><string name='aovs' value='dd:depth, nn:sh_normal,a:albedo'/>"
      "<integrator type='moment'><integrator type='direct'/></integrator></integrator>");
  CHECK(aov.aovs.layers.size() == 3);
  CHECK(aov.aovs.layers[1].kind == "sh_normal");
  CHECK(aov.aovs.layers[1].name == "nn");
  CHECK(aov.moments);
  CHECK(aov.image);
  CHECK(std::holds_alternative<Direct>(aov.method));
  CHECK(!integrator("3.0.0",
                    "<integrator type='aov'><string name='aovs' value='d:depth'/></integrator>")
             .image);

  const auto bad = [](const std::string& element, const std::string& message) {
    return says("<sensor type='perspective'/>" + element, message);
  };
  CHECK(bad("<integrator type='path'><integer name='max_depth' value='-2'/></integrator>",
            "must be -1 or more"));
  CHECK(bad("<integrator type='path'><integer name='rr_depth' value='0'/></integrator>",
            "must be positive"));
  CHECK(
      bad("<integrator type='direct'><integer name='emitter_samples' value='0'/>"
          "<integer name='bsdf_samples' value='0'/></integrator>",
          "at least one sample"));
  CHECK(bad("<integrator type='aov'><string name='aovs' value='d:foo'/></integrator>",
            "unknown kind of layer"));
  CHECK(bad("<integrator type='aov'><string name='aovs' value='d:depht'/></integrator>",
            "(did you mean \"depth\"?)"));
  CHECK(bad("<integrator type='aov'><string name='aovs' value='depth'/></integrator>",
            "form name:kind"));
  CHECK(bad("<integrator type='aov'><string name='aovs' value='d:duv_dz'/></integrator>",
            "(did you mean \"duv_dx\"?)"));
  CHECK(bad("<integrator type='aov'><string name='aovs' value='d:depth, d:uv'/></integrator>",
            "two layers are called \"d\""));
  CHECK(bad("<integrator type='aov'><string name='aovs' value=' '/></integrator>",
            "no layer is listed"));
  CHECK(bad("<integrator type='aov'/>", "needs the parameter \"aovs\""));
  CHECK(bad("<integrator type='moment'/>", "needs an integrator"));
  CHECK(bad("<integrator type='path'/><integrator type='path'/>", "can have only one integrator"));
  CHECK(bad("<integrator type='motion'/>", "integrator type \"motion\" is refused"));
}
