#include <filesystem>

#include "evaluate/report/description_text.h"
#include "evaluate/report/overloaded.h"

namespace duet {

std::string DescriptionText::material(MaterialId id) const {
  const auto rough = [&](const std::optional<Roughness>& r, const std::string& model) {
    if (!r) return model;
    const std::string u = input(r->alpha_u), v = input(r->alpha_v);
    return fmt::format("rough{} ({}, alpha {})", model,
                       r->distribution == MicrofacetDistribution::ggx ? "ggx" : "beckmann",
                       u == v ? u : u + " and " + v);
  };
  return std::visit(
      Overloaded{
          [&](const DiffuseMaterial& m) { return "diffuse " + input(m.reflectance); },
          [&](const ConductorMaterial& m) { return rough(m.roughness, "conductor"); },
          [&](const DielectricMaterial& m) {
            return fmt::format("{}, eta {}", rough(m.roughness, "dielectric"), input(m.eta));
          },
          [&](const ThinDielectricMaterial& m) {
            return fmt::format("thindielectric, eta {:.4g}", m.eta);
          },
          [&](const PlasticMaterial& m) {
            return fmt::format("{}, eta {:.4g}, diffuse {}", rough(m.roughness, "plastic"), m.eta,
                               input(m.diffuse_reflectance));
          },
          [&](const PrincipledMaterial& m) {
            return fmt::format("principled {}, roughness {}, metallic {}", input(m.base_color),
                               input(m.roughness), input(m.metallic));
          },
          [&](const PrincipledThinMaterial& m) {
            return fmt::format("principledthin {}, roughness {}", input(m.base_color),
                               input(m.roughness));
          },
          [&](const PhongMaterial& m) {
            return fmt::format("phong, exponent {}, diffuse {}, specular {}", input(m.exponent),
                               input(m.diffuse_reflectance), input(m.specular_reflectance));
          },
          [&](const WardMaterial& m) {
            return fmt::format("ward, alpha {} and {}, diffuse {}, specular {}", input(m.alpha_u),
                               input(m.alpha_v), input(m.diffuse_reflectance),
                               input(m.specular_reflectance));
          },
          [&](const RoughDiffuseMaterial& m) {
            return fmt::format("roughdiffuse {}, alpha {}", input(m.reflectance), input(m.alpha));
          },
          [&](const DiffuseTransmitterMaterial& m) {
            return "difftrans " + input(m.transmittance);
          },
          [&](const MixtureMaterial& m) {
            std::vector<std::string> parts;
            for (const auto& [weight, part] : m.parts)
              parts.push_back(fmt::format("{:.4g} of {}", weight, material(part)));
            return fmt::format("mixturebsdf [{}]", fmt::join(parts, "; "));
          },
          [&](const HairMaterial& m) {
            return fmt::format("hair, roughness {:.4g} and {:.4g}, {}", m.longitudinal_roughness,
                               m.azimuthal_roughness,
                               m.sigma_a ? "sigma_a " + input(*m.sigma_a)
                                         : fmt::format("eumelanin {:.4g}, pheomelanin {:.4g}",
                                                       m.eumelanin, m.pheomelanin));
          },
          [&](const MeasuredMaterial& m) {
            return "measured " + std::filesystem::path(m.file).filename().string();
          },
          [&](const PolarizedPlasticMaterial& m) {
            return fmt::format("p{}, eta {:.4g}, diffuse {}", rough(m.interface, "plastic"), m.eta,
                               input(m.diffuse_reflectance));
          },
          [&](const FilterMaterial& m) {
            constexpr const char* kinds[] = {"polarizer", "retarder", "circular"};
            return fmt::format("{}, transmittance {}", kinds[size_t(m.kind)],
                               input(m.transmittance));
          },
          [&](const CoatingMaterial& m) {
            return fmt::format("{}, eta {:.4g} [{}]", rough(m.roughness, "coating"), m.eta,
                               material(m.nested));
          },
          [&](const ThinLayerMaterial& m) {
            return fmt::format("hk, sigma_s {}, sigma_a {}, thickness {:.4g}", input(m.sigma_s),
                               input(m.sigma_a), m.thickness);
          },
          [&](const TwoSidedMaterial& m) {
            return m.front == m.back ? fmt::format("twosided [{}]", material(m.front))
                                     : fmt::format("twosided [front {}; back {}]",
                                                   material(m.front), material(m.back));
          },
          [&](const MaskMaterial& m) {
            return fmt::format("mask, opacity {} [{}]", input(m.opacity), material(m.nested));
          },
          [&](const BlendMaterial& m) {
            return fmt::format("blendbsdf, weight {} [{}; {}]", input(m.weight), material(m.first),
                               material(m.second));
          },
          [&](const BumpMapMaterial& m) {
            return fmt::format("bumpmap {} [{}]", input(m.height), material(m.nested));
          },
          [&](const NormalMapMaterial& m) {
            return fmt::format("normalmap {} [{}]", input(m.normals), material(m.nested));
          },
          [&](const NullMaterial&) { return std::string("null"); },
      },
      scene_.materials[size_t(id)].model);
}

}  // namespace duet
