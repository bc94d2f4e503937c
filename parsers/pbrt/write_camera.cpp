// What stands before WorldBegin, as pbrt-v4 writes it.
#include <algorithm>
#include <cmath>

#include "math/fov.h"
#include "pbrt/scene_writer.h"

namespace duet::pbrt {

namespace {

/// pbrt has no paths without a limit.
constexpr int kNoLimit = 1000;

Matrix4 inverse_or_identity(const Matrix4& m) {
  return m.inverse().value_or(Matrix4{});
}

}  // namespace

void SceneWriter::lens(Statement& c, const SensorDescription& s, double scale) {
  if (!has_lens(s.kind)) return;
  c.number("lensradius", s.aperture_radius / scale)
      .number("focaldistance", s.focus_distance / scale);
}

void SceneWriter::pose(const SensorDescription& s, const Matrix4& to_description) {
  const auto text = [&](const Matrix4& moved) {
    return transform_text(inverse_or_identity(moved * s.to_world * to_description));
  };
  if (s.motion.empty())
    head_text_ += text({});
  else
    head_text_ += "ActiveTransform StartTime\n" + text(s.motion.keyframes().front().pose) +
                  "ActiveTransform EndTime\n" + text(s.motion.keyframes().back().pose) +
                  "ActiveTransform All\n";
}

void SceneWriter::camera(const SensorDescription& s) {
  const double aspect = double(s.film.width) / s.film.height;
  // The description's camera has its +x on the left.
  Matrix4 to_description = Matrix4::scale(-1, 1, 1);
  std::string_view kind = "perspective";
  std::array<double, 4> window = aspect > 1 ? std::array{-aspect, aspect, -1.0, 1.0}
                                            : std::array{-1.0, 1.0, -1 / aspect, 1 / aspect};
  const std::array<double, 4> standard = window;
  double fov = 90;
  if (has_fov(s.kind)) {
    if (s.kind == SensorKind::perspective_rdist) lose("the distortion of the lens is missing");
    const double half = std::tan(0.5 * horizontal_fov(s.fov, s.fov_axis, aspect) * kRadians);
    const double shorter = half / std::max(aspect, 1.0);
    fov = 2 * std::atan(shorter) / kRadians;
    for (size_t i = 0; i < 2; ++i) {
      window[i] += s.principal_point_offset_x * 2 * std::max(aspect, 1.0);
      window[i + 2] -= s.principal_point_offset_y * 2 / std::min(aspect, 1.0);
      // The window is stretched in place of the pose, which would stretch the lens as well.
      window[i + 2] /= s.aperture_aspect;
    }
    to_description = to_description * Matrix4::scale(1, s.aperture_aspect, 1);
  } else if (s.kind == SensorKind::orthographic || s.kind == SensorKind::telecentric) {
    kind = "orthographic";
    window = {-1, 1, -1 / aspect, 1 / aspect};
  } else if (s.kind == SensorKind::spherical) {
    kind = "spherical";
    to_description.m = {{{0, 0, 1, 0}, {0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 0, 1}}};
  } else if (s.kind == SensorKind::realistic) {
    lose("the lenses of the camera are missing: a perspective camera has its place");
  } else {
    lose(fmt::format("the sensor \"{}\" is missing: a perspective camera has its place", s.name()));
  }
  if (kind != "spherical" && (s.near_clip > 0.0101 || s.far_clip < 9999))
    lose("the clipping planes of the sensor are missing");
  if (s.medium) head_text_ += media({}, s.medium);
  pose(s, to_description);
  Statement c("Camera", kind);
  if (kind == "perspective") c.number("fov", fov);
  if (kind == "spherical")
    c.string("mapping",
             s.sphere_mapping == SphereMapping::equal_area ? "equalarea" : "equirectangular");
  if (kind != "spherical" && window != standard)
    c.list<double>("screenwindow", Type::number, window);
  lens(c, s, kind == "orthographic" ? std::cbrt(std::abs(s.to_world.determinant3())) : 1);
  const double open = s.shutter[0], close = s.shutter[1];
  if (close > open) c.number("shutteropen", open).number("shutterclose", close);
  head_text_ += c.text() + "Identity\nMediumInterface \"\" \"\"\n";
}

namespace {

int photons(const SceneDescription& d, double per_pixel) {
  if (d.sensors.empty()) return -1;
  const FilmDescription& film = d.sensors.front().film;
  return int(std::clamp(std::round(per_pixel * film.width * film.height), 1.0, 2e9));
}

}  // namespace

void SceneWriter::integrator() {
  const IntegratorDescription& i = d_.integrator;
  if (!i.aovs.layers.empty()) lose("further layers of the image are missing");
  if (i.moments) lose("the second moments are missing");
  const auto is_strict = []<class T>(const T& m) {
    if constexpr (requires { m.strict_normals; })
      return m.strict_normals;
    else
      return false;
  };
  if (std::visit(is_strict, i.method))
    lose("directions on which the shading and the geometric normal disagree count");
  const auto limits = [&](std::string_view name, int segments, const auto& m) {
    Statement s("Integrator", name);
    s.integer("maxdepth", segments < 0 ? kNoLimit : std::max(segments - 1, 0));
    if constexpr (requires {
                    m.hide_emitters;
                    m.light_selection;
                  }) {
      if (m.hide_emitters) lose("lights can be seen directly");
      if (m.light_selection != LightSelection::automatic)
        s.string("lightsampler", kLightSelectionNames[size_t(m.light_selection)]);
    }
    return s;
  };
  const auto write = [&]<class T>(const T& m) -> Statement {
    if constexpr (std::is_same_v<T, PathIntegratorDescription>) {
      if (m.only_specular) lose("paths go on from surfaces that are not smooth");
      return limits("path", m.max_depth, m);
    } else if constexpr (std::is_same_v<T, VolumePathIntegratorDescription>)
      return limits("volpath", m.max_depth, m);
    else if constexpr (std::is_same_v<T, DirectIntegratorDescription>)
      return limits("path", 2, m);
    else if constexpr (std::is_same_v<T, OcclusionIntegratorDescription>) {
      if (m.background) lose("where the camera sees nothing, ambient occlusion is black");
      Statement s("Integrator", "ambientocclusion");
      if (m.ray_length > 0 && m.ray_length < 1e15) s.number("maxdistance", m.ray_length);
      if (m.ray_length <= 0) lose("the length of rays of ambient occlusion has no limit");
      return s;
    } else if constexpr (std::is_same_v<T, BidirectionalIntegratorDescription>) {
      using enum BidirectionalMethod;
      if (m.is(ppm)) {
        Statement s = limits("sppm", m.max_depth, m);
        if (m.radius > 0) s.number("radius", m.radius);
        if (m.light_paths > 0) s.integer("photonsperiteration", photons(d_, m.light_paths));
        return s;
      }
      if (!m.is(bdpt) && !m.is(ptracer))
        lose(fmt::format("pbrt has no integrator \"{}\": bdpt takes its place", m.method_name()));
      return limits(m.is(ptracer) ? "lightpath" : "bdpt", m.max_depth, m);
    } else {
      lose(fmt::format("pbrt has no integrator \"{}\": volpath takes its place", m.method_name()));
      if constexpr (std::is_base_of_v<PathLimits, T>)
        return limits("volpath", m.max_depth, m);
      else
        return limits("volpath", -1, m);
    }
  };
  head_text_ += std::visit(write, i.method).text();
}

}  // namespace duet::pbrt
