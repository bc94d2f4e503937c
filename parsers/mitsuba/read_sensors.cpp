// Sensors with their films, filters and samplers.
#include <cmath>

#include "mitsuba/focal_length.h"
#include "mitsuba/readers.h"
#include "mitsuba/sensor_parts.h"
#include "values/text.h"
#include "math/angles.h"

namespace duet {

namespace {

void read_size(SceneReader& s, Properties& p, FilmDescription& out) {
  constexpr int64_t most = int64_t(1) << 28;
  const bool tiny = p.node().type == "mfilm";
  out.width = tiny && !p.has("width") ? 1 : p.integer("width");
  out.height = tiny && !p.has("height") ? 1 : p.integer("height");
  if (int64_t(out.width) * out.height > most)
    p.error("width", "an image of {} × {} pixels is too large", out.width, out.height);
  CropWindow crop{p.integer("crop_offset_x"), p.integer("crop_offset_y"), out.width, out.height};
  if (p.has("crop_width")) crop.width = p.integer("crop_width");
  if (p.has("crop_height")) crop.height = p.integer("crop_height");
  if (int64_t(crop.x) + crop.width > out.width || int64_t(crop.y) + crop.height > out.height) {
    const char* name = "width";
    for (const char* n : {"crop_offset_x", "crop_offset_y", "crop_height", "crop_width"})
      if (p.has(n)) name = n;
    p.error(name, "the crop window {} × {} at ({}, {}) does not lie in the image of {} × {}",
            crop.width, crop.height, crop.x, crop.y, out.width, out.height);
  }
  if (crop != CropWindow{0, 0, out.width, out.height}) out.crop = crop;

  if (const Node* filter = p.child(PluginKind::rfilter)) s.read_into(*filter, out.filter);
  // Within its own pixel a sample counts for no other.
  if (p.boolean("sample_border") && out.filter.kind != FilterKind::box)
    s.approximate_loudly(
        p.where("sample_border"),
        "no samples are taken beyond the edges of the image or of its crop window");
}

void read_pixel_format(SceneReader& s, Properties& p, FilmDescription& out) {
  const std::initializer_list<std::pair<std::string_view, PixelFormat>> formats{
      {"luminance", PixelFormat::luminance},
      {"luminance_alpha", PixelFormat::luminance_alpha},
      {"rgb", PixelFormat::rgb},
      {"rgba", PixelFormat::rgba},
      {"xyz", PixelFormat::xyz},
      {"xyza", PixelFormat::xyza}};
  // A film of 0.6 can have a list of formats for the parts of a "multichannel" integrator.
  const std::string text = p.string("pixel_format");
  const auto parts = split_list(text);
  if (p.is_0x() && parts.size() > 1)
    for (const auto& [word, format] : formats)
      if (snake_case(parts.front()) == word) {
        s.approximate(p.where("pixel_format"),
                      "layers have the channels of their kinds, whatever \"pixelFormat\" says");
        out.pixel_format = format;
        return;
      }
  if (const std::string format = snake_case(text);
      p.is_0x() && (format == "spectrum" || format == "spectrum_alpha")) {
    s.approximate(p.where("pixel_format"), "the image has red, green and blue, not a spectrum");
    out.pixel_format = format == "spectrum" ? PixelFormat::rgb : PixelFormat::rgba;
    return;
  }
  out.pixel_format = p.choice<PixelFormat>("pixel_format", formats);
}

void read_component_format(SceneReader& s, Properties& p, FilmDescription& out) {
  out.component_format =
      p.choice<ComponentFormat>("component_format", {{"float16", ComponentFormat::half},
                                                     {"float32", ComponentFormat::single},
                                                     {"uint32", ComponentFormat::single}});
  if (p.string("component_format") == "uint32")
    s.approximate_loudly(p.where("component_format"),
                         "the image is written as float32, not as whole numbers (uint32)");
}

bool is_rigid(const Matrix4& m) {
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const double product = m[i][0] * m[j][0] + m[i][1] * m[j][1] + m[i][2] * m[j][2];
      if (std::abs(product - (i == j ? 1 : 0)) > 1e-3) return false;
    }
  return true;
}

}  // namespace

void check_rigid(Properties& p, const SensorDescription& sensor) {
  bool rigid = is_rigid(sensor.to_world);
  for (const Keyframe& k : sensor.motion.keyframes()) rigid &= is_rigid(k.pose);
  if (!rigid) p.error("to_world", "the transform of {} must not scale", describe(p.node()));
}

void read_sensor(SceneReader& s, Properties& p, SensorDescription& out) {
  out.where = p.node().where;
  out.label = {p.node().id};
  out.to_world = p.transform("to_world", out.motion);
  out.shutter = {p.number("shutter_open"), p.number("shutter_close")};
  if (out.shutter[0] > out.shutter[1])
    p.error(p.has("shutter_close") ? "shutter_close" : "shutter_open",
            "the shutter closes at {}, before it opens at {}", out.shutter[1], out.shutter[0]);
  out.near_clip = p.number("near_clip");
  out.far_clip = p.number("far_clip");
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

double diagonal_fov(double focal_length) {
  const double diagonal = std::sqrt(36.0 * 36 + 24 * 24);
  return 2 * std::atan(diagonal / (2 * focal_length)) * kDegrees;
}

std::pair<double, FovAxis> read_fov(Properties& p) {
  if (p.has("fov")) {
    if (p.has("focal_length"))
      p.error("focal_length", "either \"fov\" or \"focal_length\" can be given");
    const FovAxis axis = p.choice<FovAxis>("fov_axis", {{"x", FovAxis::x},
                                                        {"y", FovAxis::y},
                                                        {"diagonal", FovAxis::diagonal},
                                                        {"smaller", FovAxis::smaller},
                                                        {"larger", FovAxis::larger}});
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

void read_perspective(SceneReader& s, Properties& p, SensorDescription& out) {
  out.kind = SensorKind::perspective;
  read_sensor(s, p, out);
  check_rigid(p, out);
  std::tie(out.fov, out.fov_axis) = read_fov(p);
  out.principal_point_offset_x = p.number("principal_point_offset_x");
  out.principal_point_offset_y = p.number("principal_point_offset_y");
}

void read_thinlens(SceneReader& s, Properties& p, SensorDescription& out) {
  out.kind = SensorKind::thinlens;
  read_sensor(s, p, out);
  check_rigid(p, out);
  std::tie(out.fov, out.fov_axis) = read_fov(p);
  out.aperture_radius = p.number("aperture_radius");
  out.focus_distance = p.optional_number("focus_distance").value_or(out.far_clip);
}

void read_orthographic(SceneReader& s, Properties& p, SensorDescription& out) {
  out.kind = SensorKind::orthographic;
  read_sensor(s, p, out);
}

void read_hdrfilm(SceneReader& s, Properties& p, FilmDescription& out) {
  read_size(s, p, out);
  read_pixel_format(s, p, out);
  read_component_format(s, p, out);
}

void read_mfilm(SceneReader& s, Properties& p, FilmDescription& out) {
  read_size(s, p, out);
  if (!p.child(PluginKind::rfilter)) out.filter = {.kind = FilterKind::box};
  read_pixel_format(s, p, out);
  out.component_format = ComponentFormat::single;
  s.approximate_loudly(p.node().where, "the film \"mfilm\" writes an EXR file, not text");
}

void read_ldrfilm(SceneReader& s, Properties& p, FilmDescription& out) {
  read_size(s, p, out);
  out.pixel_format =
      p.choice<PixelFormat>("pixel_format", {{"luminance", PixelFormat::luminance},
                                             {"luminance_alpha", PixelFormat::luminance_alpha},
                                             {"rgb", PixelFormat::rgb},
                                             {"rgba", PixelFormat::rgba}});
  ToneMapping tone;
  tone.reinhard = p.choice<bool>("tonemap_method", {{"gamma", false}, {"reinhard", true}});
  tone.gamma = p.number("gamma");
  if (tone.gamma != -1 && !(tone.gamma > 0))
    p.error("gamma", "a gamma is positive, or -1 for sRGB, not {}", tone.gamma);
  tone.exposure = p.number("exposure");
  tone.key = p.number("key");
  tone.burn = p.number("burn");
  out.tone_mapping = tone;
}

void read_filter(SceneReader&, Properties& p, FilterDescription& out) {
  const std::string& type = p.node().type;
  out = {};
  if (type == "box") {
    out.kind = FilterKind::box;
    out.radius = p.number("radius");
  } else if (type == "tent") {
    out.kind = FilterKind::tent;
    out.radius = p.number("radius");
  } else if (type == "gaussian") {
    out.kind = FilterKind::gaussian;
    out.stddev = p.number("stddev");
  } else if (type == "mitchell") {
    out.kind = FilterKind::mitchell;
    out.b = p.optional_number("B").value_or(out.b);
    out.c = p.optional_number("C").value_or(out.c);
  } else if (type == "catmullrom") {
    out.kind = FilterKind::catmullrom;
  } else {
    out.kind = FilterKind::lanczos;
    out.lobes = p.integer("lobes");
  }
  // Larger filters would only be slow.
  constexpr double widest = 100;
  for (const char* name : {"radius", "stddev", "lobes"})
    if (find_parameter(PluginKind::rfilter, *p.node().plugin, name) && p.has(name))
      if (std::max({out.radius, out.stddev, double(out.lobes)}) > widest)
        p.error(name, "a reconstruction filter of more than {} pixels is too wide", widest);
}

void read_sampler(SceneReader&, Properties& p, SamplerDescription& out) {
  out.name = p.node().type;
  out.sample_count = p.integer("sample_count");
  out.seed = uint64_t(p.integer("seed"));
}

}  // namespace duet
