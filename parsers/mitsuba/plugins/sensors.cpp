// Cameras, and the other sensors.
#include "mitsuba/plugins/plugin.h"
#include "mitsuba/plugins/tables.h"
#include "values/text.h"

namespace duet::plugins {

std::pair<double, FovAxis> read_fov(Properties& p) {
  if (p.has("fov")) {
    p.only_one("fov", "focal_length", "focal_length");
    const FovAxis axis = FovAxis(p.choice("fov_axis", kFovAxes));
    return {p.optional_number("fov").value_or(45), axis};
  }
  const std::string text = p.string("focal_length");
  std::string_view number = trim(text);
  if (number.ends_with("mm")) number.remove_suffix(2);
  const auto length = parse_number(number);
  if (!length || !(*length > 0))
    p.error("focal_length", "{} is not a focal length of the form \"50mm\"", in_quotes(text));
  return {diagonal_fov(length && *length > 0 ? *length : 50), FovAxis::diagonal};
}

namespace {

/// An error if the transform, at any time, does more than turn, mirror and move: cameras have no
/// size.
void check_rigid(Properties& p, const SensorDescription& sensor) {
  bool rigid = sensor.to_world.is_rigid();
  for (const Keyframe& k : sensor.motion.keyframes()) rigid &= k.pose.is_rigid();
  if (!rigid) p.error("to_world", "the transform of {} must not scale", describe(p.node()));
}

}  // namespace

void read_sensor(SceneReader& s, Properties& p, SensorDescription& out) {
  out.where = p.node().where;
  out.label = {p.node().id};
  out.to_world = p.transform("to_world", out.motion);
  out.shutter = {p.number("shutter_open"), p.number("shutter_close")};
  if (out.shutter[0] > out.shutter[1])
    p.error(p.has("shutter_close") ? "shutter_close" : "shutter_open",
            "the shutter closes at {}, before it opens at {}", out.shutter[1], out.shutter[0]);
  read_values(s, p, out);
  if (out.near_clip >= out.far_clip)
    p.error(p.has("far_clip") ? "far_clip" : "near_clip",
            "the near clip distance {} is not smaller than the far one {}", out.near_clip,
            out.far_clip);
  if (const Node* medium = p.child(PluginKind::medium)) out.medium = s.medium(*medium);
  out.film.where = p.node().where;
  if (const Node* film = p.child(PluginKind::film)) {
    out.film.where = film->where;
    s.read_into(*film, out.film);
  }
  if (const Node* sampler = p.child(PluginKind::sampler)) s.read_into(*sampler, out.sampler);
}

namespace {

/// Cameras by their fields. Those of parallel rays may be scaled: it is the size of their image.
template <SensorKind kKind>
void read_camera(SceneReader& s, Properties& p, SensorDescription& out) {
  out.kind = kKind;
  read_sensor(s, p, out);
  if (kKind != SensorKind::orthographic && kKind != SensorKind::telecentric) check_rigid(p, out);
  if (has_fov(kKind)) std::tie(out.fov, out.fov_axis) = read_fov(p);
  if (has_lens(kKind))
    out.focus_distance = p.optional_number("focus_distance").value_or(out.far_clip);
}

void read_perspective_rdist(SceneReader& s, Properties& p, SensorDescription& out) {
  read_camera<SensorKind::perspective_rdist>(s, p, out);
  const std::string text = p.string("kc");
  const auto numbers = parse_numbers(text);
  if (numbers && numbers->size() == 2)
    out.distortion = {(*numbers)[0], (*numbers)[1]};
  else if (!numbers || !numbers->empty())
    p.error("kc", "{} are not two coefficients of distortion", in_quotes(text));
}

constexpr Parameter kResponse{.name = "srf",
                              .type = ParameterType::texture,
                              .note = "light is computed as red, green and blue, not by wavelength",
                              .versions = v3,
                              .support = refused};

ParameterList of_sensor(std::string_view names) {
  return parameters_of<SensorDescription>(names);
}

/// What `row` leaves open follows from the kind.
template <SensorKind kKind>
Plugin camera(Plugin row) {
  row.name = sensor_name(kKind);
  if (std::holds_alternative<std::monostate>(row.reader)) row.reader = &read_camera<kKind>;
  return row;
}

}  // namespace

std::vector<Plugin> sensors() {
  using enum SensorKind;
  const ParameterList fov = of_sensor("fov fov_axis focal_length");
  const ParameterList no_focus = inert_parameters(number, "focus_distance");
  constexpr Parameter aperture{
      .name = "aperture_radius", .type = number, .range = not_negative, .required = true};
  const ParameterList offset = of_sensor("principal_point_offset_x principal_point_offset_y");
  return joined(
      {{camera<perspective>({.parameters = {fov, offset, no_focus, kResponse}}),
        camera<thinlens>({.parameters = {fov, aperture, of_sensor("focus_distance"), kResponse}}),
        camera<orthographic>({.parameters = {no_focus, kResponse}})},
       meters(kResponse),
       {camera<fluencemeter>({.versions = v0, .note = "one pixel"}),
        camera<spherical>({.versions = v0}),
        camera<telecentric>(
            {.versions = v0, .parameters = of_sensor("aperture_radius focus_distance")}),
        camera<perspective_rdist>({.versions = v0,
                                   .parameters = {fov, of_sensor("kc"), no_focus},
                                   .reader = &read_perspective_rdist})}});
}

ParameterList sensor_parameters() {
  return {Parameter{"to_world", transform, "", kMovable},
          of_sensor("near_clip far_clip shutter_open shutter_close")};
}

}  // namespace duet::plugins
