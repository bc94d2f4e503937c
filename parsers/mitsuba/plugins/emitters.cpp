// Lights on surfaces and elsewhere.

#include <cmath>

#include "mitsuba/plugins/emitter.h"
#include "mitsuba/plugins/tables.h"

namespace duet::plugins {

void read_weight(Properties& p, LightDescription& out) {
  out.sampling_weight = p.number("sampling_weight");
}

namespace {

template <bool kDirectional>
void read_area(SceneReader& s, Properties& p, AreaEmission& out) {
  read_values(s, p, out);
  out.directional = kDirectional;
  // Rays that leave a surface know what is beyond it.
  p.child(PluginKind::medium);
}

void read_point(SceneReader& s, Properties& p, LightDescription& out) {
  p.only_one("position", "to_world", "to_world");
  Triple position = p.triple("position");
  read_light<PointLight>(s, p, out);
  const Matrix4& m = out.to_world;
  if (p.has("to_world")) position = {m[0][3], m[1][3], m[2][3]};
  out.to_world = Matrix4::translate(position[0], position[1], position[2]);
}

void read_spot(SceneReader& s, Properties& p, LightDescription& out) {
  read_light<SpotLight>(s, p, out);
  SpotLight& light = std::get<SpotLight>(out.model);
  light.beam_width = p.optional_number("beam_width").value_or(0.75 * light.cutoff_angle);
  // In Mitsuba 3 the light is even as far as it reaches, then.
  if (!p.is_0x()) light.beam_width = std::min(light.beam_width, light.cutoff_angle);
  if (light.beam_width > light.cutoff_angle)
    p.error("beam_width", "the beam width {} is greater than the cutoff angle {}", light.beam_width,
            light.cutoff_angle);
}

void read_projector(SceneReader& s, Properties& p, LightDescription& out) {
  read_light<ProjectorLight>(s, p, out);
  ProjectorLight& light = std::get<ProjectorLight>(out.model);
  std::tie(light.fov, light.fov_axis) = read_fov(p);
}

void read_directional(SceneReader& s, Properties& p, LightDescription& out) {
  p.only_one("direction", "to_world", "to_world");
  read_light<DirectionalLight>(s, p, out);
  if (!p.has("direction")) return;
  if (const auto m = Matrix4::look_along({}, p.triple("direction")))
    out.to_world = *m;
  else
    p.error("direction", "the direction of a light cannot be zero");
}

void read_envmap(SceneReader& s, Properties& p, LightDescription& out) {
  read_light<EnvironmentMapLight>(s, p, out);
  check_gamma(p, std::get<EnvironmentMapLight>(out.model).gamma);
  warn_of_scales(s, p, out.to_world);
}

}  // namespace

std::vector<Plugin> emitters() {
  const auto of_map = [](std::string_view name) { return parameter<EnvironmentMapLight>(name); };
  const Parameter radiance = parameter<AreaEmission>("radiance");
  const std::vector<Plugin> own{
      {"area", both, radiance, &read_area<false>, "stands in a shape"},
      light<PointLight>({.reader = &read_point},
                        Parameter{"position", point, "0 0 0", "either this or to_world"}),
      light<SpotLight>({.reader = &read_spot}),
      light<ProjectorLight>({.versions = v3, .reader = &read_projector}),
      light<DirectionalLight>(
          {.reader = &read_directional},
          Parameter{"direction", point, "", "either this or to_world, whose +z it is"}),
      {"constant",
       both,
       {parameters_of<ConstantLight>(), inert_parameters(transform, "to_world")},
       &read_light<ConstantLight>},
      {"envmap",
       both,
       {of_map("filename"), of_map("scale"), kMovablePlace, of_map("gamma"),
        inert_parameters(boolean, "cache", v0), inert_parameters(boolean, "mis_compensation", v3)},
       &read_envmap},
      {"directionalarea", v3, radiance, &read_area<true>,
       "stands in a shape; only methods with light sub-paths carry it"},
      light<CollimatedLight>(
          {.versions = v0, .note = "only methods with light sub-paths carry it"}),
  };
  return joined({own,
                 skies(),
                 {refused_plugin("volumelight", v3,
                                 "a volume that emits is not computed, nor is it in Mitsuba 3.9",
                                 "radiance to_world")}});
}

}  // namespace duet::plugins
