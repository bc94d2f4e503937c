// Mitsuba 0.6's woven cloth, approximated: Irawan and Marschner's model needs the light on every
// thread.
#include "mitsuba/plugins/bsdf.h"
#include "mitsuba/plugins/bsdfs.h"
#include "weave/weave.h"

namespace duet::plugins {

namespace {

/// How wide the highlights of cloth are, as the roughness of a microfacet surface.
constexpr double kClothRoughness = 0.4;

/// The value of a weave's colour, which may be a parameter of the scene.
Spectrum cloth_color(Properties& p, const WeaveColor& color) {
  if (color.parameter.empty()) return color.value;
  const Property* property = p.find_own(color.parameter);
  if (!property) {
    p.report().error(p.node().where, "the weave needs the parameter \"{}\"", color.parameter);
    return {};
  }
  const PropertyValue& v = property->value;
  Triple value{};
  if (const RgbColor* rgb = std::get_if<RgbColor>(&v))
    value = rgb->value;
  else if (const ScalarSpectrum* grey = std::get_if<ScalarSpectrum>(&v))
    value.fill(grey->value);
  else if (const double* number = std::get_if<double>(&v))
    value.fill(*number);
  else if (!std::holds_alternative<Broken>(v))
    p.report().error(property->where, "the parameter \"{}\" of a weave must be a colour",
                     color.parameter);
  for (double& x : value)
    if (!(x >= 0)) {
      p.report().error(property->where, "the colour has a negative component");
      x = 0;
    }
  return to_spectrum(value);
}

void read_irawan(SceneReader& s, Properties& p, MaterialDescription& out) {
  const std::string path = s.file(p, "filename");
  if (path.empty()) return;
  WardMaterial m;
  m.alpha_u = m.alpha_v = kClothRoughness;
  const auto weave = s.report().from_file(
      p.where("filename"), [&] { return parse_weave(text_of(path, s.files()), path); });
  if (!weave) return;
  Spectrum diffuse, specular;
  const std::vector<float> shares = weave->shares();
  for (size_t i = 0; i < shares.size(); ++i) {
    diffuse += cloth_color(p, weave->yarns[i].diffuse) * shares[i];
    specular += cloth_color(p, weave->yarns[i].specular) * shares[i];
  }
  m.diffuse_reflectance = diffuse, m.specular_reflectance = specular;
  conserve_energy(s, p, m.diffuse_reflectance, m.specular_reflectance);
  s.approximate_loudly(p.node().where,
                       "the woven cloth has the average colours of its yarns and a wide highlight: "
                       "threads are not simulated");
  out.model = m;
}

constexpr const char* kNormalised = "Mitsuba 0.6 refuses it, too: highlights are normalised";
constexpr const char* kNoThreads = "threads are not simulated";
constexpr Parameter kCloth[] = {
    {.name = "filename", .type = file, .note = "a .wv file", .required = true},
    {"repeat_u", number, "", kNoThreads, any, both, inert},
    {"repeat_v", number, "", kNoThreads, any, both, inert},
    {"ks_multiplier", number, "", kNormalised, any, both, refused},
    {"kd_multiplier", number, "", kNormalised, any, both, refused}};

}  // namespace

Plugin irawan() {
  return {.name = "irawan",
          .versions = v0,
          .parameters = kCloth,
          .reader = &read_irawan,
          .note =
              "woven cloth is its average colours and a wide highlight; the file's own "
              "parameters are colours; Mitsuba 3 has none",
          .support = approximated};
}

}  // namespace duet::plugins
