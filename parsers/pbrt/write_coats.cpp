// BSDFs that pbrt-v4 has under other names: coats and sums of lobes.
#include <algorithm>
#include <cmath>

#include "pbrt/scene_writer.h"

namespace duet::pbrt {

namespace {

/// What a smooth dielectric interface reflects of diffuse light that meets it from inside: 1 − (1 −
/// F)/η², where F is that from outside by the quadrature of Fresnel's equations.
double internal_reflectance(double eta) {
  constexpr int kSteps = 4096;
  double outside = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double cosine = (i + 0.5) / kSteps;
    const double inner = std::sqrt(std::max(1 - (1 - cosine * cosine) / (eta * eta), 0.0));
    const double s = (cosine - eta * inner) / (cosine + eta * inner),
                 p = (eta * cosine - inner) / (eta * cosine + inner);
    outside += (s * s + p * p) * cosine / kSteps;
  }
  return 1 - (1 - outside) / (eta * eta);
}

}  // namespace

void SceneWriter::coat(Statement& s, const CoatLayer& c, std::string_view prefix) {
  s.number(fmt::format("{}eta", prefix), c.eta);
  put(s, "thickness", c.thickness);
  put(s, "albedo", c.albedo, true);
  put(s, "g", c.g);
  s.integer("maxdepth", int(c.max_depth)).integer("nsamples", int(c.samples));
}

void SceneWriter::write(const CoatedDiffuseMaterial& m, const std::string& name,
                        const Around& around) {
  one_sided(around);
  Statement s = named_material(name, "coateddiffuse");
  put(s, "reflectance", m.reflectance, true);
  roughness(s, {{"uroughness", m.alpha_u}, {"vroughness", m.alpha_v}});
  coat(s, m, "");
  end_material(s, around);
}

void SceneWriter::write(const CoatedConductorMaterial& m, const std::string& name,
                        const Around& around) {
  one_sided(around);
  Statement s = named_material(name, "coatedconductor");
  if (m.reflectance) {
    put(s, "reflectance", *m.reflectance, true);
  } else {
    put(s, "conductor.eta", m.conductor_eta, false);
    put(s, "conductor.k", m.conductor_k, false);
  }
  roughness(s, {{"interface.uroughness", m.alpha_u},
                {"interface.vroughness", m.alpha_v},
                {"conductor.uroughness", m.conductor_alpha_u},
                {"conductor.vroughness", m.conductor_alpha_v}});
  coat(s, m, "interface.");
  end_material(s, around);
}

void SceneWriter::write(const PlasticMaterial& m, const std::string& name, const Around& around) {
  one_sided(around);
  lost_factor(m.specular_reflectance, "the factor of a plastic's reflection");
  Statement s = named_material(name, "coateddiffuse");
  ColorInput base = m.diffuse_reflectance;
  if (!m.nonlinear) {
    // ρ / (1 − F) of the linear model is ρ' / (1 − ρ' F), which is what walks in the coat yield.
    const float f = float(internal_reflectance(m.eta));
    if (Spectrum* constant = std::get_if<Spectrum>(&base)) {
      for (int c = 0; c < 3; ++c) (*constant)[c] /= 1 - f + (*constant)[c] * f;
    } else {
      lose("colours of a plastic that are a texture shift by scattering inside the coating");
    }
  }
  put(s, "reflectance", base, true);
  if (m.roughness) {
    lose("a rough plastic is a rough coat over a diffuse base, in which light is followed");
    roughness(s, m.roughness);
  }
  s.number("eta", m.eta).number("thickness", 0).integer("maxdepth", 100);
  end_material(s, around);
}

void SceneWriter::write(const UberMaterial& m, const std::string& name, const Around& around) {
  const auto is = [](const ColorInput& input, float value) {
    return input == ColorInput(Spectrum(value));
  };
  if (!is(m.opacity, 1)) lose("the opacity of \"uber\" is missing");
  const bool reflects = is(m.diffuse_transmittance, 0) && is(m.glossy_transmittance, 0) &&
                        is(m.specular_transmittance, 0);
  const bool shines = !is(m.glossy_reflectance, 0) || !is(m.specular_reflectance, 0);
  const double* eta = std::get_if<double>(&m.eta);
  if (reflects && shines && eta) {
    lose("a diffuse lobe beside a glossy or specular one is a diffuse base under a coat");
    Statement s = named_material(name, "coateddiffuse");
    put(s, "reflectance", m.diffuse_reflectance, true);
    if (is(m.specular_reflectance, 0)) roughness(s, m.roughness);
    s.number("eta", *eta);
    return end_material(s, around);
  }
  if (shines || !is(m.glossy_transmittance, 0) || !is(m.specular_transmittance, 0))
    lose("of the lobes of \"uber\" that let light through only the diffuse ones exist in pbrt-v4");
  Statement s = named_material(name, "diffusetransmission");
  put(s, "reflectance", m.diffuse_reflectance, true);
  put(s, "transmittance", m.diffuse_transmittance, true);
  end_material(s, around);
}

void SceneWriter::write(const SubstrateMaterial& m, const std::string& name, const Around& around) {
  one_sided(around);
  lose("a substrate is a diffuse base under a coat");
  Statement s = named_material(name, "coateddiffuse");
  put(s, "reflectance", m.diffuse_reflectance, true);
  roughness(s, m.roughness);
  end_material(s, around);
}

}  // namespace duet::pbrt
