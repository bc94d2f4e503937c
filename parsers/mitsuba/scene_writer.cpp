#include "mitsuba/scene_writer.h"

#include <algorithm>

#include "mitsuba/writer.h"

namespace duet {

namespace {

/// "--" must not occur in a comment.
std::string commented(std::string_view text) {
  std::string out = "  ";
  for (const char c : text)
    if (c == '-' && out.back() == '-')
      out += " -";
    else
      out += c;
  return out += '\n';
}

}  // namespace

void SceneWriter::lose(std::string what) {
  if (std::find(losses_.begin(), losses_.end(), what) == losses_.end())
    losses_.push_back(std::move(what));
}

std::string SceneWriter::unique_id(const std::string& wanted, const std::string& otherwise) {
  const bool usable = !wanted.empty() && wanted.find_first_of("$\\") == wanted.npos;
  if (usable && ids_.insert(wanted).second) return wanted;
  std::string id = otherwise;
  for (int i = 1; !ids_.insert(id).second; ++i) id = fmt::format("{}_{}", otherwise, i);
  return id;
}

void SceneWriter::name_things() {
  const auto name = [&](const auto& things, std::vector<std::string>& ids, std::string_view kind) {
    for (const auto& thing : things)
      ids.push_back(unique_id(thing.label.text, fmt::format("{}{}", kind, ids.size())));
  };
  name(d_.textures, texture_ids_, "texture");
  name(d_.materials, material_ids_, "material");
  name(d_.media, medium_ids_, "medium");
  name(d_.groups, group_ids_, "group");
}

void SceneWriter::write() {
  name_things();
  integrator(d_.integrator);
  for (size_t i = 0; i < d_.media.size(); ++i) medium(d_.media[i], medium_ids_[i]);
  for (const SensorDescription& s : d_.sensors)
    if (s.kind != SensorKind::irradiancemeter) sensor(s);
  for (size_t i = 0; i < d_.textures.size(); ++i) texture(i);
  for (size_t i = 0; i < d_.materials.size(); ++i) material(d_.materials[i], material_ids_[i]);
  for (size_t i = 0; i < d_.groups.size(); ++i) {
    out_.open("shape", "shapegroup", {}, group_ids_[i]);
    for (const ShapeDescription& s : d_.groups[i].shapes) shape(s, "");
    out_.close();
  }
  for (const ShapeDescription& s : d_.shapes)
    shape(s, s.label.text.empty() ? "" : unique_id(s.label.text, s.label.text));
  for (const LightDescription& l : d_.lights) light(l);
}

void SceneWriter::fov(double degrees, FovAxis axis) {
  constexpr std::string_view axes[] = {"x", "y", "diagonal", "smaller", "larger"};
  out_.number("fov", degrees);
  out_.string("fov_axis", axes[size_t(axis)]);
}

void SceneWriter::view(const SensorDescription& s) {
  if (s.shutter != std::array<double, 2>{}) {
    out_.number("shutter_open", s.shutter[0]);
    out_.number("shutter_close", s.shutter[1]);
  }
  if (s.kind == SensorKind::irradiancemeter) return;
  out_.transform("to_world", s.to_world);
  if (has_fov(s.kind) || s.kind == SensorKind::orthographic || s.kind == SensorKind::telecentric) {
    out_.number("near_clip", s.near_clip);
    out_.number("far_clip", s.far_clip);
  }
  if (has_fov(s.kind)) fov(s.fov, s.fov_axis);
  if (s.kind == SensorKind::perspective) {
    out_.number("principal_point_offset_x", s.principal_point_offset_x);
    out_.number("principal_point_offset_y", s.principal_point_offset_y);
  }
  if (s.kind == SensorKind::thinlens || s.kind == SensorKind::telecentric) {
    out_.number("aperture_radius", s.aperture_radius);
    out_.number("focus_distance", s.focus_distance);
  }
  if (s.kind == SensorKind::perspective_rdist)
    out_.string("kc", fmt::format("{}, {}", s.distortion[0], s.distortion[1]));
  if (s.target_point) out_.point("target", *s.target_point);
  for (const ShapeDescription& target : s.target_shape) shape(target, "", "target");
  for (const SensorDescription& part : s.parts) {
    out_.open("sensor", sensor_name(part.kind));
    view(part);
    out_.close();
  }
  if (s.kind == SensorKind::telecentric || s.kind == SensorKind::perspective_rdist ||
      s.kind == SensorKind::spherical || s.kind == SensorKind::fluencemeter)
    lose(fmt::format("the sensor \"{}\" does not exist in Mitsuba 3", sensor_name(s.kind)));
}

void SceneWriter::sensor(const SensorDescription& s) {
  out_.open("sensor", sensor_name(s.kind));
  view(s);
  if (s.medium) out_.reference({}, medium_id(*s.medium));
  film(s.film);
  const bool known = s.sampler.name == "independent" || s.sampler.name == "stratified" ||
                     s.sampler.name == "multijitter" || s.sampler.name == "orthogonal" ||
                     s.sampler.name == "ldsampler";
  if (!known) lose(fmt::format("the sampler \"{}\" is \"ldsampler\" instead", s.sampler.name));
  out_.open("sampler", known ? s.sampler.name : "ldsampler");
  out_.integer("sample_count", s.sampler.sample_count);
  out_.integer("seed", int64_t(s.sampler.seed));
  out_.close();
  out_.close();
}

void SceneWriter::film(const FilmDescription& f) {
  constexpr std::string_view pixels[] = {"luminance", "luminance_alpha", "rgb", "rgba", "xyz",
                                         "xyza"};
  out_.open("film", "hdrfilm");
  out_.integer("width", f.width);
  out_.integer("height", f.height);
  if (f.crop) {
    out_.integer("crop_offset_x", f.crop->x);
    out_.integer("crop_offset_y", f.crop->y);
    out_.integer("crop_width", f.crop->width);
    out_.integer("crop_height", f.crop->height);
  }
  out_.string("pixel_format", pixels[size_t(f.pixel_format)]);
  out_.string("component_format",
              f.component_format == ComponentFormat::half ? "float16" : "float32");
  if (f.tone_mapping) lose("the tone mapping of \"ldrfilm\" is missing");
  filter(f.filter);
  out_.close();
}

void SceneWriter::filter(const FilterDescription& f) {
  constexpr std::string_view filters[] = {"box",      "tent",       "gaussian",
                                          "mitchell", "catmullrom", "lanczos"};
  out_.open("rfilter", filters[size_t(f.kind)]);
  switch (f.kind) {
    case FilterKind::box:
      if (f.radius != 0.5) lose("the radius of a box filter is missing");
      break;
    case FilterKind::tent:
      out_.number("radius", f.radius);
      break;
    case FilterKind::gaussian:
      out_.number("stddev", f.stddev);
      break;
    case FilterKind::mitchell:
      out_.number("B", f.b);
      out_.number("C", f.c);
      break;
    case FilterKind::catmullrom:
      break;
    case FilterKind::lanczos:
      out_.integer("lobes", f.lobes);
      break;
  }
  out_.close();
}

void SceneWriter::sampling_weight(double weight) {
  if (weight != 1) out_.number("sampling_weight", weight);
}

void SceneWriter::light(const LightDescription& l) {
  constexpr std::string_view types[] = {"point",    "spot",   "projector", "directional",
                                        "constant", "envmap", "sunsky",    "collimated",
                                        "goniometric"};
  static_assert(std::size(types) == std::variant_size_v<decltype(l.model)>);
  out_.open("emitter", types[l.model.index()]);
  if (const auto* point = std::get_if<PointLight>(&l.model)) {
    color("intensity", point->intensity);
  } else if (const auto* spot = std::get_if<SpotLight>(&l.model)) {
    color("intensity", spot->intensity);
    out_.number("cutoff_angle", spot->cutoff_angle);
    out_.number("beam_width", spot->beam_width);
    if (spot->texture) out_.reference("texture", texture_id(*spot->texture));
    if (spot->falloff != SpotFalloff::linear) lose("the spot light fades linearly in the angle");
  } else if (const auto* projector = std::get_if<ProjectorLight>(&l.model)) {
    color("irradiance", projector->irradiance);
    out_.number("scale", projector->scale);
    if (projector->is_intensity) lose("the projector's image is irradiance, not intensity");
    fov(projector->fov, projector->fov_axis);
  } else if (const auto* directional = std::get_if<DirectionalLight>(&l.model)) {
    color("irradiance", directional->irradiance);
  } else if (const auto* constant = std::get_if<ConstantLight>(&l.model)) {
    color("radiance", constant->radiance);
  } else if (const auto* map = std::get_if<EnvironmentMapLight>(&l.model)) {
    out_.string("filename", map->file);
    out_.number("scale", map->scale);
    if (map->tint != Spectrum(1.0f)) lose("the colour of an environment map is missing");
    if (map->illuminance) lose("the illuminance of an environment map is missing");
    if (map->layout == EnvironmentLayout::equal_area)
      lose("the image of an environment map is one of equal areas");
    if (map->gamma) lose("the gamma value of an environment map is missing");
  } else if (const auto* sky = std::get_if<SkyLight>(&l.model)) {
    out_.number("turbidity", sky->turbidity);
    color("albedo", ColorInput(sky->albedo));
    out_.number("sky_scale", sky->sky_scale);
    out_.number("sun_scale", sky->sun_scale);
    out_.number("sun_aperture", sky->sun_aperture);
    std::array<double, 3> sun{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) sun[size_t(i)] += l.to_world[i][size_t(j)] * sky->sun[size_t(j)];
    out_.point("sun_direction", sun);
    if (sky->stretch != 1 || sky->extend) lose("the sky ends at the horizon");
    if (sky->disk && sky->sun_scale != 0)
      lose("the sun has the brightness of Hosek and Wilkie's model, and sets with the horizon");
  } else if (const auto* beam = std::get_if<CollimatedLight>(&l.model)) {
    lose("the light \"collimated\" does not exist in Mitsuba 3");
    color("power", ColorInput(beam->power));
  } else if (const auto* image = std::get_if<GoniometricLight>(&l.model)) {
    lose("the light \"goniometric\" does not exist in Mitsuba 3");
    out_.string("filename", image->file);
  }
  if (!std::holds_alternative<ConstantLight>(l.model)) out_.transform("to_world", l.to_world);
  sampling_weight(l.sampling_weight);
  if (l.medium) out_.reference({}, medium_id(*l.medium));
  out_.close();
}

namespace {

/// Of a description in which nothing moves.
MitsubaXml write(const SceneDescription& description, std::vector<std::string> losses) {
  SceneWriter writer(description);
  writer.write();
  losses.insert(losses.end(), writer.losses().begin(), writer.losses().end());
  std::string comments;
  for (const std::string& loss : losses) comments += commented("Not in Mitsuba 3: " + loss);
  for (const Diagnostic& a : description.approximations)
    comments += commented("Approximated: " + a.message);
  std::string text = "<scene version=\"3.0.0\">\n";
  if (!comments.empty()) text += "  <!--\n" + comments + "  -->\n";
  return {text + writer.text() + "</scene>\n", std::move(losses)};
}

}  // namespace

MitsubaXml write_mitsuba_xml(const SceneDescription& description) {
  if (count_moving(description) > 0) {
    const double time = description.sensors.empty() ? 0 : description.sensors[0].shutter[0];
    return write(
        scene_at(description, time),
        {fmt::format("motion is missing: everything stands as it does at the time {}", time)});
  }
  return write(description, {});
}

}  // namespace duet
