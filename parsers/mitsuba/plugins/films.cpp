// Films, with their filters and samplers.
#include "mitsuba/plugins/plugin.h"
#include "mitsuba/plugins/tables.h"
#include "scene/filter_fields.h"
#include "values/text.h"

namespace duet::plugins {

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
  constexpr auto& formats = FilmDescription::kPixelFormats;
  // A film of 0.6 can have a list of formats for the parts of a "multichannel" integrator.
  const std::string text = p.string("pixel_format");
  const auto parts = split_list(text);
  if (p.is_0x() && parts.size() > 1)
    for (size_t i = 0; i < std::size(formats); ++i)
      if (snake_case(parts.front()) == formats[i]) {
        s.approximate(p.where("pixel_format"),
                      "layers have the channels of their kinds, whatever \"pixelFormat\" says");
        out.pixel_format = PixelFormat(i);
        return;
      }
  if (const std::string format = snake_case(text);
      p.is_0x() && (format == "spectrum" || format == "spectrum_alpha")) {
    s.approximate(p.where("pixel_format"), "the image has red, green and blue, not a spectrum");
    out.pixel_format = format == "spectrum" ? PixelFormat::rgb : PixelFormat::rgba;
    return;
  }
  out.pixel_format = PixelFormat(p.choice("pixel_format", formats));
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
      PixelFormat(p.choice("pixel_format", std::span(FilmDescription::kPixelFormats).first(4)));
  ToneMapping tone;
  read_values(s, p, tone);
  tone.reinhard = p.choice<bool>("tonemap_method", {{"gamma", false}, {"reinhard", true}});
  check_gamma(p, tone.gamma);
  out.tone_mapping = tone;
}

template <FilterKind kKind>
void read_filter(SceneReader& s, Properties& p, FilterDescription& out) {
  FilterOf<kKind> filter;
  read_values(s, p, filter);
  out = filter;
  // Larger filters would only be slow.
  constexpr double widest = 100;
  for (const Parameter& parameter : p.node().plugin->parameters)
    if (p.has(parameter.name) && std::max({out.radius, out.stddev, double(out.lobes)}) > widest)
      p.error(parameter.name, "a reconstruction filter of more than {} pixels is too wide", widest);
}

template <FilterKind kKind>
Plugin filter() {
  return plugin_of<FilterOf<kKind>, FilterDescription>({.reader = &read_filter<kKind>});
}

void read_sampler(SceneReader& s, Properties& p, SamplerDescription& out) {
  out.name = p.node().type;
  read_values(s, p, out);
}

/// A sampler whose place Duet's own takes.
Plugin sobol_instead(std::string_view name, FileVersions versions) {
  return {.name = name,
          .versions = versions,
          .reader = &read_sampler,
          .note = "Owen-scrambled Sobol' points instead",
          .support = Support::approximated};
}

Parameter pixel_format(std::string_view preset, std::string_view note) {
  return {"pixel_format", string, preset, note};
}

}  // namespace

std::vector<Plugin> films() {
  const auto of_film = [](std::string_view names) { return parameters_of<FilmDescription>(names); };
  const ParameterList hdr(of_film("pixel_format component_format"),
                          Parameter{"file_format", string, "openexr", "", any, both, ignored},
                          Parameter{"channel_names", string, "",
                                    "layers keep the names of their fields", any, v0, ignored});
  return {
      {"hdrfilm", both, hdr, &read_hdrfilm},
      {"ldrfilm",
       v0,
       {pixel_format("rgb", "luminance, luminance_alpha, rgb, rgba"),
        inert_parameters(string, "file_format"), parameters_of<ToneMapping>()},
       &read_ldrfilm,
       "tone mapping is for PNG and JPEG output"},
      {"tiledhdrfilm", v0, hdr, &read_hdrfilm, "written as any other EXR file"},
      {"mfilm",
       v0,
       {pixel_format("luminance", "luminance, luminance_alpha, rgb, rgba, xyz, xyza"),
        inert_parameters(string, "file_format"), inert_parameters(integer, "digits"),
        inert_parameters(string, "variable")},
       &read_mfilm,
       "written as EXR; 1 x 1 pixels unless the file says so",
       approximated},
      refused_plugin("specfilm", v3, "light is computed as red, green and blue, not by wavelength",
                     "component_format"),
  };
}

ParameterList film_parameters() {
  const auto without_image = [](std::string_view name, FileVersions versions) {
    return Parameter{name, boolean, "false", "", any, versions, ignored};
  };
  return {
      parameters_of<FilmDescription>(
          "width height crop_offset_x crop_offset_y crop_width crop_height"),
      without_image("banner", both),
      without_image("high_quality_edges", both),
      Parameter{"sample_border", boolean, "false", "as if it were false", any, v3, approximated},
      without_image("attach_log", v0),
      inert_parameters(boolean, "compensate", v3)};
}

std::vector<Plugin> rfilters() {
  using enum FilterKind;
  return {filter<box>(),      filter<tent>(),       filter<gaussian>(),
          filter<mitchell>(), filter<catmullrom>(), filter<lanczos>()};
}

std::vector<Plugin> samplers() {
  return {
      {.name = "independent",
       .reader = &read_sampler,
       .note = "Owen-scrambled Sobol' points, with --strict-sampler independent ones"},
      sobol_instead("stratified", both),
      sobol_instead("multijitter", v3),
      sobol_instead("orthogonal", v3),
      sobol_instead("ldsampler", both),
      {.name = "sobol", .versions = v0, .reader = &read_sampler, .note = "Owen-scrambled"},
      sobol_instead("halton", v0),
      sobol_instead("hammersley", v0),
  };
}

ParameterList sampler_parameters() {
  return {parameters_of<SamplerDescription>(),
          Parameter{"jitter", boolean, "true", "", any, v3, ignored},
          inert_parameters(integer, "dimension", v0),
          Parameter{"scramble", integer, "", "", any, v0, ignored}};
}

}  // namespace duet::plugins
