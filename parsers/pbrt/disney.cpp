// Burley's material of pbrt-v3.
#include "pbrt/materials.h"

namespace duet::pbrt {

namespace {

constexpr Spec kDisney[] = {
    {"color", kColorTexture, "0.5"},
    {"metallic", kNumberTexture, "0"},
    {"eta", kNumberTexture, "1.5"},
    {"roughness", kNumberTexture, "0.5"},
    {"speculartint", kNumberTexture, "0"},
    {"anisotropic", kNumberTexture, "0"},
    {"sheen", kNumberTexture, "0"},
    {"sheentint", kNumberTexture, "0.5"},
    {"clearcoat", kNumberTexture, "0"},
    {"clearcoatgloss", kNumberTexture, "1"},
    {"spectrans", kNumberTexture, "0"},
    {"scatterdistance", kColorTexture, "0", "light beneath the surface", 1, Status::ignored},
    {"thin", kBoolean, "false"},
    {"flatness", kNumberTexture, "0", "of thin surfaces"},
    {"difftrans", kNumberTexture, "1", "of thin surfaces: twice the share that passes"},
};

}  // namespace

std::span<const Spec> disney_specs() {
  return kDisney;
}

std::optional<MaterialId> read_disney(Values& v) {
  const ColorInput color = v.color_input("color", ColorMeaning::reflectance);
  const auto set_common = [&](auto& m) {
    m.base_color = color;
    m.roughness = v.float_input("roughness");
    m.anisotropic = v.float_input("anisotropic");
    m.spec_trans = v.float_input("spectrans");
    m.spec_tint = v.float_input("speculartint");
    m.sheen = v.float_input("sheen");
    m.sheen_tint = v.float_input("sheentint");
  };
  if (v.boolean("thin")) {
    PrincipledThinMaterial m;
    set_common(m);
    m.eta = v.float_input("eta");
    m.flatness = v.float_input("flatness");
    m.diff_trans = v.float_input("difftrans");
    return v.reader().add_material(m, v.where());
  }
  PrincipledMaterial m;
  set_common(m);
  m.metallic = v.float_input("metallic");
  m.eta = v.index_of_refraction("eta");
  m.clearcoat = v.float_input("clearcoat");
  m.clearcoat_gloss = v.float_input("clearcoatgloss");
  const double* transmitted = std::get_if<double>(&m.spec_trans);
  const MaterialId id = v.reader().add_material(m, v.where());
  // Glass has an inside, everything else is the same on both sides.
  return transmitted && *transmitted == 0 ? two_sided(v, id) : id;
}

}  // namespace duet::pbrt
