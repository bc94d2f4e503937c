// BSDFs as pbrt-v4 writes them.
#include <algorithm>
#include <cmath>

#include "pbrt/scene_writer.h"

namespace duet::pbrt {

namespace {

/// Of a metal, for light along the normal (Fresnel).
Spectrum normal_reflectance(const Spectrum& eta, const Spectrum& k) {
  Spectrum r;
  for (int c = 0; c < 3; ++c) {
    const float over = eta[c] - 1, under = eta[c] + 1;
    r[c] = (over * over + k[c] * k[c]) / (under * under + k[c] * k[c]);
  }
  return r;
}

}  // namespace

void SceneWriter::one_sided(const Around& around) {
  if (!around.two_sided)
    lose("what scatters light on one side of a surface only does so on both sides");
}

void SceneWriter::lost_factor(const ColorInput& factor, std::string_view what) {
  if (factor != ColorInput(Spectrum(1.0f))) lose(fmt::format("{} is missing", what));
}

template <class Material>
void SceneWriter::lost_dielectric_factors(const Material& m) {
  lost_factor(m.specular_reflectance, "the factor of a dielectric's reflection");
  lost_factor(m.specular_transmittance, "the factor of a dielectric's transmission");
}

void SceneWriter::normal_map(Statement& s, const NormalMapMaterial& n) {
  const TextureId* id = std::get_if<TextureId>(&n.normals);
  const auto* image = id ? std::get_if<BitmapTexture>(&d_.textures[size_t(*id)].model) : nullptr;
  const UvTransform upright{{{{1, 0, 0}, {0, -1, 1}}}};
  if (n.drops_leaks || n.use_shadowing_function || n.flip_invalid_normals)
    lose("normal maps as Mitsuba has them: without its corrections where normals are turned far");
  if (!image || !(image->to_uv == upright))
    lose("a normal map that is no image with plain coordinates is missing or upside down");
  if (image) s.string("normalmap", image->file);
}

void SceneWriter::end_material(Statement& s, const Around& around) {
  if (const BumpMapMaterial* b = around.bumps) {
    if (b->drops_leaks || b->use_shadowing_function || b->flip_invalid_normals)
      lose("bumps as Mitsuba has them: without its corrections where normals are turned far");
    if (!b->follows_curvature) lose("bumps stretch the surface where it bends, as in pbrt");
    if (const TextureId* height = std::get_if<TextureId>(&b->height)) {
      std::string name = texture(*height, false);
      if (b->scale != 1) {
        const std::string scaled = unique_name("", name + "_scaled", 0);
        add_texture(
            Statement::texture(scaled, false, "scale").refer("tex", name).number("scale", b->scale),
            {});
        name = scaled;
      }
      s.refer("displacement", name);
    }
  }
  if (around.normals) normal_map(s, *around.normals);
  materials_text_ += s.text();
}

void SceneWriter::microfacets(MicrofacetDistribution distribution) {
  if (distribution != MicrofacetDistribution::ggx_correlated)
    lose(fmt::format("the microfacets of \"{}\" are those of GGX with correlated masking",
                     kMicrofacetNames[size_t(distribution)]));
}

void SceneWriter::roughness(Statement& s, const Alphas& alphas) {
  const auto root = [&](const FloatInput& alpha) -> const FunctionDescription* {
    const TextureId* id = std::get_if<TextureId>(&alpha);
    const auto* f =
        id ? std::get_if<FunctionDescription>(&d_.textures[size_t(*id)].model) : nullptr;
    return f && f->function == TextureFunction::root ? f : nullptr;
  };
  // The root of a texture is the texture, remapped.
  const bool remapped = std::any_of(alphas.begin(), alphas.end(),
                                    [&](const auto& named) { return root(named.second); });
  for (const auto& [name, alpha] : alphas) {
    if (!remapped)
      put(s, name, alpha);
    else if (const FunctionDescription* f = root(alpha))
      s.refer(name, texture(f->inner, false));
    else if (const double* constant = std::get_if<double>(&alpha))
      s.number(name, *constant * *constant);
    else
      lose("roughnesses of which one is remapped: the other is missing");
  }
  if (!remapped) s.boolean("remaproughness", false);
}

void SceneWriter::roughness(Statement& s, const std::optional<Roughness>& r) {
  if (!r) return;
  microfacets(r->distribution);
  roughness(s, {{"uroughness", r->alpha_u}, {"vroughness", r->alpha_v}});
}

void SceneWriter::write(const DiffuseMaterial& m, const std::string& name, const Around& around) {
  one_sided(around);
  Statement s = named_material(name, "diffuse");
  put(s, "reflectance", m.reflectance, true);
  end_material(s, around);
}

void SceneWriter::write(const DiffuseTransmitterMaterial& m, const std::string& name,
                        const Around& around) {
  Statement s = named_material(name, "diffusetransmission");
  s.color("reflectance", Spectrum(0.0f));
  put(s, "transmittance", m.transmittance, true);
  end_material(s, around);
}

void SceneWriter::write(const ConductorMaterial& m, const std::string& name, const Around& around) {
  one_sided(around);
  Statement s = named_material(name, "conductor");
  const TextureId* k = std::get_if<TextureId>(&m.k);
  const auto* of_color =
      k ? std::get_if<FunctionDescription>(&d_.textures[size_t(*k)].model) : nullptr;
  const auto* factor = std::get_if<Spectrum>(&m.specular_reflectance);
  const auto *eta = std::get_if<Spectrum>(&m.eta), *absorption = std::get_if<Spectrum>(&m.k);
  if (of_color && of_color->function == TextureFunction::metal_k) {
    lost_factor(m.specular_reflectance, "the factor of a metal's reflection");
    s.refer("reflectance", texture(of_color->inner, true));
  } else if (factor && *factor != Spectrum(1.0f) && eta && absorption) {
    lose("a metal's reflection that has a factor is right along the normal only");
    s.color("reflectance", *factor * normal_reflectance(*eta, *absorption));
  } else {
    lost_factor(m.specular_reflectance, "the factor of a metal's reflection");
    put(s, "eta", m.eta, false);
    put(s, "k", m.k, false);
  }
  roughness(s, m.roughness);
  end_material(s, around);
}

void SceneWriter::write(const DielectricMaterial& m, const std::string& name,
                        const Around& around) {
  lost_dielectric_factors(m);
  Statement s = named_material(name, "dielectric");
  if (const double* eta = std::get_if<double>(&m.eta))
    s.number("eta", *eta);
  else
    lose("an index of refraction that is a texture is 1.5");
  roughness(s, m.roughness);
  end_material(s, around);
}

void SceneWriter::write(const ThinDielectricMaterial& m, const std::string& name,
                        const Around& around) {
  lost_dielectric_factors(m);
  Statement s = named_material(name, "thindielectric");
  s.number("eta", m.eta);
  end_material(s, around);
}

void SceneWriter::write(const HairMaterial& m, const std::string& name, const Around& around) {
  Statement s = named_material(name, "hair");
  if (m.reflectance) {
    put(s, "reflectance", *m.reflectance, true);
  } else if (!m.sigma_a) {
    put(s, "eumelanin", m.eumelanin);
    put(s, "pheomelanin", m.pheomelanin);
  } else if (const Spectrum* constant = std::get_if<Spectrum>(&*m.sigma_a)) {
    s.color("sigma_a", *constant * float(m.scale));
  } else {
    put(s, "sigma_a", *m.sigma_a, false);
    if (m.scale != 1) lose("the factor of a texture of hair's absorption is missing");
  }
  put(s, "eta", m.eta);
  put(s, "beta_m", m.longitudinal_roughness);
  put(s, "beta_n", m.azimuthal_roughness);
  put(s, "alpha", m.scale_tilt);
  end_material(s, around);
}

void SceneWriter::write(const MeasuredMaterial& m, const std::string& name, const Around& around) {
  one_sided(around);
  Statement s = named_material(name, "measured");
  s.string("filename", m.file);
  end_material(s, around);
}

}  // namespace duet::pbrt
