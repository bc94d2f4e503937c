// Lights on surfaces and elsewhere.
#include <cmath>

#include "mitsuba/focal_length.h"
#include "mitsuba/readers.h"
#include "mitsuba/scene_reader.h"

namespace duet {

namespace {

void check_not_both(Properties& p, std::string_view a, std::string_view b) {
  if (p.has(a) && p.has(b)) p.error(b, "either \"{}\" or \"{}\" can be given", a, b);
}

/// What all lights that are not surfaces have.
void read_common(SceneReader& s, Properties& p, LightDescription& out) {
  out.sampling_weight = p.number("sampling_weight");
  if (const Node* medium = p.child(PluginKind::medium)) out.medium = s.medium(*medium);
}

}  // namespace

void read_area(SceneReader& s, Properties& p, AreaEmission& out) {
  out.radiance = s.color(p, "radiance");
  out.sampling_weight = p.number("sampling_weight");
  // Rays that leave a surface know what is beyond it.
  p.child(PluginKind::medium);
}

void read_point(SceneReader& s, Properties& p, LightDescription& out) {
  out.model = PointLight{s.constant_color(p, "intensity")};
  check_not_both(p, "position", "to_world");
  Triple position = p.triple("position");
  if (p.has("to_world")) {
    const Matrix4 m = p.transform("to_world", out.motion);
    position = {m[0][3], m[1][3], m[2][3]};
  }
  out.to_world = Matrix4::translate(position[0], position[1], position[2]);
  read_common(s, p, out);
}

void read_spot(SceneReader& s, Properties& p, LightDescription& out) {
  SpotLight light;
  light.intensity = s.constant_color(p, "intensity");
  light.cutoff_angle = p.number("cutoff_angle");
  light.beam_width = p.optional_number("beam_width").value_or(0.75 * light.cutoff_angle);
  // In Mitsuba 3 the light is even as far as it reaches, then.
  if (!p.is_0x()) light.beam_width = std::min(light.beam_width, light.cutoff_angle);
  if (light.beam_width > light.cutoff_angle)
    p.error("beam_width", "the beam width {} is greater than the cutoff angle {}", light.beam_width,
            light.cutoff_angle);
  light.texture = s.texture(p, "texture");
  out.model = light;
  out.to_world = p.transform("to_world", out.motion);
  read_common(s, p, out);
}

void read_projector(SceneReader& s, Properties& p, LightDescription& out) {
  ProjectorLight light;
  light.irradiance = s.color(p, "irradiance");
  light.scale = p.number("scale");
  std::tie(light.fov, light.fov_axis) = read_fov(p);
  out.model = light;
  out.to_world = p.transform("to_world", out.motion);
  read_common(s, p, out);
}

std::optional<Matrix4> along(const Triple& direction) {
  // Turning the light around its direction changes nothing: any "up" will do.
  const bool mostly_x = std::abs(direction[0]) > std::abs(direction[1]);
  return Matrix4::look_at({0, 0, 0}, direction, mostly_x ? Triple{0, 1, 0} : Triple{1, 0, 0});
}

void read_directional(SceneReader& s, Properties& p, LightDescription& out) {
  out.model = DirectionalLight{s.constant_color(p, "irradiance")};
  check_not_both(p, "direction", "to_world");
  out.to_world = p.transform("to_world", out.motion);
  if (p.has("direction")) {
    if (const auto m = along(p.triple("direction")))
      out.to_world = *m;
    else
      p.error("direction", "the direction of a light cannot be zero");
  }
  read_common(s, p, out);
}

void read_constant(SceneReader& s, Properties& p, LightDescription& out) {
  out.model = ConstantLight{s.constant_color(p, "radiance")};
  read_common(s, p, out);
}

void read_envmap(SceneReader& s, Properties& p, LightDescription& out) {
  EnvironmentMapLight light;
  light.file = s.file(p, "filename");
  light.scale = p.number("scale");
  light.gamma = p.optional_number("gamma");
  if (light.gamma && *light.gamma != -1 && !(*light.gamma > 0))
    p.error("gamma", "a gamma is positive, or -1 for sRGB, not {}", *light.gamma);
  out.model = light;
  out.to_world = p.transform("to_world", out.motion);
  read_common(s, p, out);
}

}  // namespace duet
