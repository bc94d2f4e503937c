#include "support/test_material.h"

#include "materials/coating.h"
#include "materials/layered_material.h"
#include "materials/pbrt_materials.h"
#include "materials/principled_materials.h"
#include "materials/special_materials.h"
#include "support/source_path.h"

#include <fstream>
#include <stdexcept>

namespace duet::test {

namespace {

using nlohmann::json;

float number(const json& j, const char* name, float otherwise) {
  return j.contains(name) ? j[name].get<float>() : otherwise;
}

bool flag(const json& j, const char* name, bool otherwise) {
  return j.contains(name) ? j[name].get<bool>() : otherwise;
}

void set(ColorSlot& slot, const json& j, const char* name) {
  if (j.contains(name)) slot.constant = to_spectrum(j[name]);
}

void set(FloatSlot& slot, const json& j, const char* name) {
  slot.constant = number(j, name, slot.constant);
}

void set(float& value, const json& j, const char* name) {
  value = number(j, name, value);
}

float relative_index(const json& j, float inside) {
  return number(j, "int_ior", inside) / number(j, "ext_ior", 1.000277f);
}

RoughnessOptions roughness(const json& j) {
  RoughnessOptions r;
  if (j.contains("distribution"))
    for (size_t i = 0; i < std::size(kMicrofacetNames); ++i)
      if (j["distribution"] == kMicrofacetNames[i]) r.distribution = MicrofacetDistribution(i);
  set(r.alpha_u, j, "alpha");
  set(r.alpha_v, j, "alpha");
  set(r.alpha_u, j, "alpha_u");
  set(r.alpha_v, j, "alpha_v");
  r.sample_visible = flag(j, "sample_visible", true);
  return r;
}

ConductorOptions conductor(const json& j) {
  ConductorOptions o;
  set(o.eta, j, "eta");
  set(o.k, j, "k");
  set(o.specular_reflectance, j, "specular_reflectance");
  return o;
}

DielectricOptions dielectric(const json& j) {
  DielectricOptions o;
  o.eta.constant = relative_index(j, 1.5046f);
  set(o.specular_reflectance, j, "specular_reflectance");
  set(o.specular_transmittance, j, "specular_transmittance");
  return o;
}

PlasticOptions plastic(const json& j) {
  PlasticOptions o;
  o.eta = relative_index(j, 1.49f);
  set(o.diffuse_reflectance, j, "diffuse_reflectance");
  set(o.specular_reflectance, j, "specular_reflectance");
  o.nonlinear = flag(j, "nonlinear", false);
  return o;
}

PrincipledOptions principled(const json& j) {
  PrincipledOptions o;
  set(o.base_color, j, "base_color");
  set(o.roughness, j, "roughness");
  set(o.anisotropic, j, "anisotropic");
  set(o.metallic, j, "metallic");
  set(o.spec_trans, j, "spec_trans");
  o.eta = j.contains("eta") ? j["eta"].get<float>()
                            : principled_eta(number(j, "specular", 0.5f), is_used(o.spec_trans));
  set(o.spec_tint, j, "spec_tint");
  set(o.sheen, j, "sheen");
  set(o.sheen_tint, j, "sheen_tint");
  set(o.flatness, j, "flatness");
  set(o.clearcoat, j, "clearcoat");
  set(o.clearcoat_gloss, j, "clearcoat_gloss");
  set(o.diffuse_reflectance_sampling_rate, j, "diffuse_reflectance_sampling_rate");
  set(o.main_specular_sampling_rate, j, "main_specular_sampling_rate");
  set(o.clearcoat_sampling_rate, j, "clearcoat_sampling_rate");
  return o;
}

PrincipledThinOptions principled_thin(const json& j) {
  PrincipledThinOptions o;
  set(o.base_color, j, "base_color");
  set(o.roughness, j, "roughness");
  set(o.anisotropic, j, "anisotropic");
  set(o.spec_trans, j, "spec_trans");
  set(o.eta, j, "eta");
  set(o.spec_tint, j, "spec_tint");
  set(o.sheen, j, "sheen");
  set(o.sheen_tint, j, "sheen_tint");
  set(o.flatness, j, "flatness");
  set(o.diff_trans, j, "diff_trans");
  set(o.spec_reflectance_sampling_rate, j, "specular_reflectance_sampling_rate");
  set(o.spec_transmittance_sampling_rate, j, "specular_transmittance_sampling_rate");
  set(o.diffuse_reflectance_sampling_rate, j, "diffuse_reflectance_sampling_rate");
  set(o.diffuse_transmittance_sampling_rate, j, "diffuse_transmittance_sampling_rate");
  return o;
}

HairOptions hair(const json& j) {
  HairOptions o;
  set(o.longitudinal_roughness, j, "longitudinal_roughness");
  set(o.azimuthal_roughness, j, "azimuthal_roughness");
  set(o.scale_tilt, j, "scale_tilt");
  o.eta.constant = relative_index(j, 1.55f);
  set(o.eumelanin, j, "eumelanin");
  set(o.pheomelanin, j, "pheomelanin");
  if (j.contains("sigma_a")) set(o.absorption.emplace(), j, "sigma_a");
  set(o.absorption_scale, j, "scale");
  return o;
}

CoatingOptions coating(const json& j) {
  CoatingOptions o;
  o.eta = relative_index(j, 1.5046f);
  set(o.thickness, j, "thickness");
  set(o.sigma_a, j, "sigma_a");
  set(o.specular_reflectance, j, "specular_reflectance");
  if (j["type"] == "roughcoating") o.roughness = roughness(j);
  return o;
}

CoatLayerOptions coat_layer(const json& j) {
  CoatLayerOptions o;
  set(o.eta, j, "eta");
  set(o.alpha_u, j, "alpha");
  set(o.alpha_v, j, "alpha");
  set(o.alpha_u, j, "alpha_u");
  set(o.alpha_v, j, "alpha_v");
  set(o.thickness, j, "thickness");
  set(o.albedo, j, "albedo");
  set(o.g, j, "g");
  if (j.contains("max_depth")) o.max_depth = j["max_depth"];
  if (j.contains("samples")) o.samples = j["samples"];
  return o;
}

CoatedMetalOptions coated_metal(const json& j) {
  CoatedMetalOptions o;
  set(o.eta, j, "conductor_eta");
  set(o.k, j, "conductor_k");
  if (j.contains("reflectance")) o.reflectance = ColorSlot{to_spectrum(j["reflectance"])};
  set(o.alpha_u, j, "conductor_alpha");
  set(o.alpha_v, j, "conductor_alpha");
  return o;
}

UberOptions uber(const json& j) {
  UberOptions o;
  set(o.diffuse_reflectance, j, "diffuse_reflectance");
  set(o.diffuse_transmittance, j, "diffuse_transmittance");
  set(o.glossy_reflectance, j, "glossy_reflectance");
  set(o.glossy_transmittance, j, "glossy_transmittance");
  set(o.specular_reflectance, j, "specular_reflectance");
  set(o.specular_transmittance, j, "specular_transmittance");
  set(o.opacity, j, "opacity");
  set(o.eta, j, "eta");
  o.roughness = roughness(j);
  return o;
}

ThinLayerOptions thin_layer(const json& j) {
  ThinLayerOptions o;
  set(o.sigma_s, j, "sigma_s");
  set(o.sigma_a, j, "sigma_a");
  set(o.thickness, j, "thickness");
  set(o.g, j, "g");
  return o;
}

}  // namespace

const Material& TestMaterial::make(const json& j) {
  const std::string type = j["type"];
  std::vector<const Material*> nested;
  if (j.contains("nested"))
    for (const json& n : j["nested"]) nested.push_back(&make(n));
  const auto keep = [&](Material* m) -> const Material& {
    materials_.emplace_back(m);
    return *m;
  };
  const TiltOptions perturbation{flag(j, "flip_invalid_normals", true),
                                 flag(j, "use_shadowing_function", true),
                                 flag(j, "drops_leaks", true)};
  if (type == "diffuse") {
    ColorSlot reflectance{Spectrum(0.5f)};
    set(reflectance, j, "reflectance");
    return keep(new Diffuse(reflectance));
  }
  if (type == "phong") {
    PhongOptions o;
    set(o.diffuse_reflectance, j, "diffuse_reflectance");
    set(o.specular_reflectance, j, "specular_reflectance");
    set(o.exponent, j, "exponent");
    return keep(new Phong(o));
  }
  if (type == "ward") {
    WardOptions o;
    set(o.diffuse_reflectance, j, "diffuse_reflectance");
    set(o.specular_reflectance, j, "specular_reflectance");
    set(o.alpha_u, j, "alpha_u");
    set(o.alpha_v, j, "alpha_v");
    if (j.contains("variant"))
      o.variant = j["variant"] == "ward" ? WardVariant::ward : WardVariant::duer;
    return keep(new Ward(o));
  }
  if (type == "roughdiffuse") {
    ColorSlot reflectance{Spectrum(0.5f)};
    set(reflectance, j, "reflectance");
    return keep(new RoughDiffuse(reflectance, {number(j, "alpha", 0.2f)}, flag(j, "fast", false)));
  }
  if (type == "difftrans")
    return keep(new DiffuseTransmitter({Spectrum(number(j, "transmittance", 0.5f))}));
  if (type == "mixturebsdf") {
    std::vector<Mixture::Part> parts;
    for (size_t i = 0; i < nested.size(); ++i)
      parts.push_back({j["weights"][i].get<float>(), nested[i]});
    return keep(new Mixture(std::move(parts)));
  }
  if (type == "null") return keep(new Null);
  if (type == "hair") return keep(new HairFibre(hair(j)));
  if (type == "pplastic") return keep(new PolarizedPlastic(plastic(j), roughness(j)));
  if (type == "polarizer" || type == "retarder" || type == "circular") {
    ColorSlot transmittance{Spectrum(1)};
    set(transmittance, j, "transmittance");
    return keep(new Filter(transmittance, type == "retarder" ? 1.0f : 0.5f, type == "circular"));
  }
  if (type == "coating" || type == "roughcoating") return keep(new Coating(coating(j), *nested[0]));
  if (type == "coateddiffuse") {
    ColorSlot reflectance{Spectrum(0.5f)};
    set(reflectance, j, "reflectance");
    return keep(new CoatedDiffuse(reflectance, coat_layer(j)));
  }
  if (type == "coatedconductor") return keep(new CoatedConductor(coated_metal(j), coat_layer(j)));
  if (type == "uber") return keep(new Uber(uber(j)));
  if (type == "substrate") {
    ColorSlot diffuse{Spectrum(0.5f)}, specular{Spectrum(0.5f)};
    set(diffuse, j, "diffuse_reflectance");
    set(specular, j, "specular_reflectance");
    return keep(new Substrate(diffuse, specular, roughness(j)));
  }
  if (type == "hk") return keep(new ThinLayer(thin_layer(j)));
  if (type == "conductor") return keep(new Conductor(conductor(j)));
  if (type == "roughconductor") return keep(new RoughConductor(conductor(j), roughness(j)));
  if (type == "dielectric") return keep(new Dielectric(dielectric(j)));
  if (type == "roughdielectric") return keep(new RoughDielectric(dielectric(j), roughness(j)));
  if (type == "thindielectric") return keep(new ThinDielectric(dielectric(j)));
  if (type == "plastic") return keep(new Plastic(plastic(j)));
  if (type == "roughplastic") return keep(new RoughPlastic(plastic(j), roughness(j)));
  if (type == "principled") return keep(new Principled(principled(j)));
  if (type == "principledthin") return keep(new PrincipledThin(principled_thin(j)));
  if (type == "twosided") return keep(new TwoSided(*nested.front(), *nested.back()));
  if (type == "mask") {
    FloatSlot opacity{0.5f};
    set(opacity, j, "opacity");
    return keep(new Mask(opacity, *nested[0]));
  }
  if (type == "blendbsdf") {
    FloatSlot weight{0.5f};
    set(weight, j, "weight");
    return keep(new Blend(weight, *nested[0], *nested[1]));
  }
  if (type == "bumpmap") {
    textures_.emplace_back(
        new FlatTexture(Spectrum(0.5f), {j["slope"][0].get<float>(), j["slope"][1].get<float>()}));
    return keep(new BumpMap({0, textures_.back().get()}, number(j, "scale", 1),
                            flag(j, "follows_curvature", false), perturbation, *nested[0]));
  }
  if (type == "normalmap") {
    const Vector3f n = normalize(to_vector(j["normal"]));
    textures_.emplace_back(
        new FlatTexture(Spectrum(0.5f * (n.x + 1), 0.5f * (n.y + 1), 0.5f * (n.z + 1))));
    return keep(new NormalMap({{}, textures_.back().get()}, perturbation, *nested[0]));
  }
  throw std::runtime_error("unknown bsdf " + type);
}

Surface flat_surface() {
  Surface s{};
  s.ng = {0, 0, 1};
  s.shading = Frame({1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  s.uv = {0.5f, 0.5f};
  s.dp_du = to_vector(mitsuba_tables()["dp_du"]);
  s.dp_dv = to_vector(mitsuba_tables()["dp_dv"]);
  return s;
}

Spectrum to_spectrum(const json& j) {
  if (j.is_number()) return Spectrum(j.get<float>());
  return {j[0].get<float>(), j[1].get<float>(), j[2].get<float>()};
}

Vector3f to_vector(const json& j) {
  return {j[0].get<float>(), j[1].get<float>(), j[2].get<float>()};
}

const json& mitsuba_tables() {
  static const json tables = [] {
    std::ifstream file(source_path("reference/bsdf/mitsuba.json"));
    if (!file) throw std::runtime_error("reference/bsdf/mitsuba.json is missing");
    return json::parse(file);
  }();
  return tables;
}

}  // namespace duet::test
