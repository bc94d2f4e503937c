// Textures, and the textures of Mitsuba 3 that are the same everywhere.
#include <cmath>

#include "mitsuba/readers.h"
#include "mitsuba/scene_reader.h"
#include "values/text.h"

namespace duet {

namespace {

/// Mitsuba 3 has a transform, 0.x offsets and scales.
UvTransform uv_transform(Properties& p) {
  UvTransform uv;
  if (find_parameter(PluginKind::texture, *p.node().plugin, "to_uv") && p.has("to_uv")) {
    const Matrix4 m = p.transform("to_uv");
    for (int i = 0; i < 2; ++i) uv.m[i] = {m[i][0], m[i][1], m[i][3]};
    for (const char* name : {"uoffset", "voffset", "uscale", "vscale", "uvscale"})
      if (p.has(name)) p.error(name, "both \"to_uv\" and {} are given", in_quotes(name));
    return uv;
  }
  const double scale = p.number("uvscale");
  uv.m[0] = {p.optional_number("uscale").value_or(scale), 0, p.number("uoffset")};
  uv.m[1] = {0, p.optional_number("vscale").value_or(scale), p.number("voffset")};
  return uv;
}

/// Two lists of numbers as a spectrum; nothing after an error.
std::optional<std::vector<SpectrumSample>> samples(Properties& p, std::string_view name,
                                                   const std::vector<double>& wavelengths,
                                                   const std::vector<double>& values) {
  if (wavelengths.size() != values.size() || values.size() < 2) {
    p.error(name, "{} wavelengths and {} values make no spectrum", wavelengths.size(),
            values.size());
    return std::nullopt;
  }
  std::vector<SpectrumSample> result;
  for (size_t i = 0; i < values.size(); ++i) {
    if (i > 0 && !(wavelengths[i - 1] < wavelengths[i])) {
      p.error(name, "the wavelengths of a spectrum must increase");
      return std::nullopt;
    }
    result.push_back({wavelengths[i], values[i]});
  }
  return result;
}

std::vector<double> number_list(Properties& p, std::string_view name) {
  if (!p.has(name)) return p.find(name), std::vector<double>();
  const std::string text = p.string(name);
  auto numbers = parse_numbers(text);
  if (!numbers) p.error(name, "{} is not a list of numbers", in_quotes(text));
  return numbers.value_or(std::vector<double>());
}

}  // namespace

void read_bitmap(SceneReader& s, Properties& p, TextureDescription& out) {
  BitmapTexture t;
  t.file = s.file(p, "filename");
  enum class Filter { nearest, bilinear, other };
  const Filter filter = p.choice<Filter>("filter_type", {{"bilinear", Filter::bilinear},
                                                         {"nearest", Filter::nearest},
                                                         {"ewa", Filter::other},
                                                         {"trilinear", Filter::other}});
  t.filter = filter == Filter::nearest ? TextureFilter::nearest : TextureFilter::bilinear;
  if (filter == Filter::other)
    s.approximate(p.where("filter_type"),
                  "textures are looked up bilinearly instead of with EWA or trilinear filters");

  const auto wrap = [&](std::string_view name) {
    return p.choice<WrapMode>(name, {{"repeat", WrapMode::repeat},
                                     {"mirror", WrapMode::mirror},
                                     {"clamp", WrapMode::clamp},
                                     {"zero", WrapMode::zero},
                                     {"black", WrapMode::zero},
                                     {"one", WrapMode::one},
                                     {"white", WrapMode::one}});
  };
  t.wrap_u = t.wrap_v = wrap("wrap_mode");
  if (p.has("wrap_mode_u")) t.wrap_u = wrap("wrap_mode_u");
  if (p.has("wrap_mode_v")) t.wrap_v = wrap("wrap_mode_v");

  t.raw = p.boolean("raw");
  t.gamma = p.optional_number("gamma");
  if (t.gamma && *t.gamma != -1 && !(*t.gamma > 0))
    p.error("gamma", "a gamma is positive, or -1 for sRGB, not {}", *t.gamma);
  if (t.gamma == 1.0) t.raw = true, t.gamma.reset();
  if (p.has("channel"))
    t.channel = p.choice<TextureChannel>("channel", {{"r", TextureChannel::red},
                                                     {"g", TextureChannel::green},
                                                     {"b", TextureChannel::blue},
                                                     {"a", TextureChannel::alpha}});
  t.to_uv = uv_transform(p);
  out.model = t;
}

void read_checkerboard(SceneReader& s, Properties& p, TextureDescription& out) {
  out.model =
      CheckerboardTexture{s.color(p, "color0"), s.color(p, "color1"), !p.is_0x(), uv_transform(p)};
}

void read_mesh_attribute(SceneReader&, Properties& p, TextureDescription& out) {
  MeshAttributeTexture t{p.find("name") ? p.string("name") : "", p.number("scale")};
  if (p.has("name") && !t.attribute.starts_with("vertex_") && !t.attribute.starts_with("face_"))
    p.error("name", "the name of a mesh attribute begins with \"vertex_\" or \"face_\", unlike {}",
            in_quotes(t.attribute));
  out.model = t;
}

void read_vertexcolors(SceneReader&, Properties&, TextureDescription& out) {
  out.model = MeshAttributeTexture{"vertex_color", 1};
}

void read_scale(SceneReader& s, Properties& p, TextureDescription& out) {
  const Spectrum factor = s.constant_color(p, "scale");
  const Node* nested = p.child(PluginKind::texture);
  if (!nested) {
    s.report().error(p.node().where, "{} needs a texture", describe(p.node()));
    return;
  }
  if (const auto id = s.texture(*nested)) out.model = ScaledTextureDescription{*id, factor};
}

void read_gridtexture(SceneReader& s, Properties& p, TextureDescription& out) {
  out.model = GridLinesTexture{s.color(p, "color0"), s.color(p, "color1"), p.number("line_width"),
                               uv_transform(p)};
}

void read_wireframe(SceneReader& s, Properties& p, TextureDescription& out) {
  WireframeTexture t{s.constant_color(p, "interior_color"), s.constant_color(p, "edge_color"),
                     std::nullopt, std::clamp(p.number("step_width"), 0.0, 1.0)};
  if (const double width = p.number("line_width"); width != 0) t.line_width = width;
  out.model = t;
}

void read_curvature(SceneReader&, Properties& p, TextureDescription& out) {
  const CurvatureKind shown = p.choice<CurvatureKind>(
      "curvature", {{"gaussian", CurvatureKind::gaussian}, {"mean", CurvatureKind::mean}});
  out.model = CurvatureTexture{shown, p.number("scale")};
}

void read_volume_texture(SceneReader& s, Properties& p, TextureDescription& out) {
  out.model = VolumeTextureDescription{s.color_volume(p, "volume")};
}

void read_uniform(SceneReader&, Properties& p, MeantColor& out) {
  out.value = Spectrum(float(p.number("value")));
}

void read_srgb(SceneReader& s, Properties& p, MeantColor& out) {
  out.value = s.constant_color(p, "color");
  if (!p.boolean("unbounded") && out.value.max() > 1)
    p.error("color",
            "a component of an \"srgb\" spectrum is greater than 1, but not \"unbounded\"");
}

void read_d65(SceneReader& s, Properties& p, MeantColor& out) {
  out.value = s.constant_color(p, "color") * float(p.number("scale"));
}

void read_rawconstant(SceneReader& s, Properties& p, MeantColor& out) {
  const Property* value = p.find("value");
  const Triple* triple = value ? std::get_if<Triple>(&value->value) : nullptr;
  if (triple)
    out.value = {float((*triple)[0]), float((*triple)[1]), float((*triple)[2])};
  else if (value)
    out.value = s.constant_color(p, "value");
}

void read_irregular(SceneReader&, Properties& p, MeantColor& out) {
  const auto wavelengths = number_list(p, "wavelengths"), values = number_list(p, "values");
  if (!p.has("wavelengths") || !p.has("values")) return;
  if (const auto list = samples(p, "values", wavelengths, values))
    out.value = spectrum_to_rgb(*list, out.meaning);
}

void read_regular(SceneReader&, Properties& p, MeantColor& out) {
  const double first = p.number("wavelength_min"), last = p.number("wavelength_max");
  const auto values = number_list(p, "values");
  if (!p.has("wavelength_min") || !p.has("wavelength_max") || !p.has("values")) return;
  std::vector<double> wavelengths;
  for (size_t i = 0; i < values.size(); ++i)
    wavelengths.push_back(first + (last - first) * double(i) / double(values.size() - 1));
  if (const auto list = samples(p, "values", wavelengths, values))
    out.value = spectrum_to_rgb(*list, out.meaning);
}

void read_blackbody(SceneReader&, Properties& p, MeantColor& out) {
  if (const auto kelvin = p.optional_number("temperature"))
    out.value = spectrum_to_rgb(blackbody_spectrum(*kelvin, 1), out.meaning);
}

}  // namespace duet
