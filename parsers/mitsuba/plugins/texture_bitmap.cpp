// Images, whose filters, borders and gamma values have several spellings.
#include "mitsuba/plugins/plugin.h"
#include "mitsuba/plugins/tables.h"

namespace duet::plugins {

namespace {

WrapMode read_wrap_mode(Properties& p, std::string_view name) {
  return p.choice<WrapMode>(name, {{"repeat", WrapMode::repeat},
                                   {"mirror", WrapMode::mirror},
                                   {"clamp", WrapMode::clamp},
                                   {"zero", WrapMode::zero},
                                   {"black", WrapMode::zero},
                                   {"one", WrapMode::one},
                                   {"white", WrapMode::one}});
}

void read_modes(SceneReader& s, Properties& p, BitmapTexture& t) {
  enum class Filter { nearest, bilinear, other };
  const Filter filter = p.choice<Filter>("filter_type", {{"bilinear", Filter::bilinear},
                                                         {"nearest", Filter::nearest},
                                                         {"ewa", Filter::other},
                                                         {"trilinear", Filter::other}});
  t.filter = filter == Filter::nearest ? TextureFilter::nearest : TextureFilter::bilinear;
  if (filter == Filter::other)
    s.approximate(p.where("filter_type"),
                  "textures are looked up bilinearly instead of with EWA or trilinear filters");
  t.wrap_u = t.wrap_v = read_wrap_mode(p, "wrap_mode");
  if (p.has("wrap_mode_u")) t.wrap_u = read_wrap_mode(p, "wrap_mode_u");
  if (p.has("wrap_mode_v")) t.wrap_v = read_wrap_mode(p, "wrap_mode_v");
  check_gamma(p, t.gamma);
  if (t.gamma == 1.0) t.raw = true, t.gamma.reset();
  if (p.has("channel"))
    t.channel = p.choice<TextureChannel>("channel", {{"r", TextureChannel::red},
                                                     {"g", TextureChannel::green},
                                                     {"b", TextureChannel::blue},
                                                     {"a", TextureChannel::alpha}});
}

}  // namespace

void check_gamma(Properties& p, std::optional<double> gamma) {
  if (gamma && *gamma != -1 && !(*gamma > 0))
    p.error("gamma", "a gamma is positive, or -1 for sRGB, not {}", *gamma);
}

Plugin bitmap() {
  return texture<BitmapTexture, read_modes>(
      {}, {inert_parameters(number, "max_anisotropy", v0), inert_parameters(boolean, "cache", v0),
           inert_parameters(boolean, "accel", v3), inert_parameters(string, "format", v3)});
}

}  // namespace duet::plugins
