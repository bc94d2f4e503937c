// Materials at the edges of what they can be asked: no result is infinite, negative or not a
// number.
#include <limits>

#include "support/bsdf_checks.h"

using namespace duet;
using namespace duet::test;
using nlohmann::json;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Directions from the normal to the horizon, above and below.
std::vector<Vector3f> directions() {
  std::vector<Vector3f> out;
  for (const float z :
       {1.0f, 0.99999f, 0.7f, 0.1f, 1e-2f, 1e-3f, 1e-4f, 1e-5f, 1.1e-6f, 1e-7f, 1e-20f, 0.0f})
    for (const float phi : {0.0f, 2.5f}) {
      const float r = std::sqrt(std::max(1 - z * z, 0.0f));
      out.push_back({r * std::cos(phi), r * std::sin(phi), z});
      out.push_back({r * std::cos(phi), r * std::sin(phi), -z});
    }
  return out;
}

std::vector<json> descriptions() {
  std::vector<json> out;
  const float indices[] = {1.0001f, 1.5f, 10, 0.9999f, 0.5f, 0.1f, 1};
  const float roughnesses[] = {0, 1e-4f, 1e-3f, 0.05f, 0.4f, 1, 20};
  for (const float eta : indices) {
    const json index{{"int_ior", eta}, {"ext_ior", 1}};
    for (const char* type : {"dielectric", "thindielectric", "plastic"}) {
      out.push_back({{"type", type}});
      out.back().update(index);
    }
    for (const float alpha : roughnesses) {
      for (const char* distribution : {"ggx", "beckmann"})
        for (const bool visible : {true, false}) {
          const json rough{{"distribution", distribution},
                           {"sample_visible", visible},
                           {"alpha_u", alpha},
                           {"alpha_v", eta > 1.2f ? alpha : 0.3f}};
          for (const char* type : {"roughdielectric", "roughplastic"}) {
            // Tables of a rough coat take a while to make.
            if (type == std::string("roughplastic") && !visible) continue;
            out.push_back({{"type", type}});
            out.back().update(index);
            out.back().update(rough);
          }
          out.push_back(
              {{"type", "roughconductor"}, {"eta", eta}, {"k", eta > 1.2f ? 0.0f : 1e4f}});
          out.back().update(rough);
        }
      const json principled{{"roughness", alpha},
                            {"eta", eta},
                            {"sheen", 1},
                            {"spec_tint", 0.5f},
                            {"anisotropic", eta > 1.2f},
                            {"flatness", 0.5f},
                            {"clearcoat", 0.5f},
                            {"clearcoat_gloss", 1}};
      for (const float spec_trans : {0.0f, 0.5f, 1.0f}) {
        out.push_back({{"type", "principled"}, {"spec_trans", spec_trans}});
        out.back().update(principled);
        out.push_back({{"type", "principledthin"}, {"spec_trans", spec_trans}, {"diff_trans", 1}});
        out.back().update(principled);
      }
      out.push_back({{"type", "principled"}, {"metallic", 1}});
      out.back().update(principled);
      for (const float thickness : {0.0f, 100.0f})
        for (const float albedo : {0.0f, 1.0f}) {
          const json coat{
              {"eta", eta}, {"alpha", alpha}, {"thickness", thickness}, {"albedo", albedo}};
          out.push_back({{"type", "coateddiffuse"}, {"reflectance", 1}});
          out.back().update(coat);
          out.push_back({{"type", "coatedconductor"}, {"conductor_alpha", alpha}, {"g", 1}});
          out.back().update(coat);
        }
      out.push_back({{"type", "substrate"}, {"alpha_u", alpha}, {"alpha_v", 0.3f}});
      out.push_back({{"type", "uber"},
                     {"distribution", "ggx_correlated"},
                     {"alpha", alpha},
                     {"eta", eta},
                     {"glossy_transmittance", 1},
                     {"specular_transmittance", 1},
                     {"opacity", 0.5f}});
    }
  }
  out.push_back({{"type", "diffuse"}});
  out.push_back({{"type", "null"}});
  for (const float k : {0.0f, 1e-5f, 1e30f})
    for (const float eta : {0.0f, 1.0f, 1e30f})
      out.push_back({{"type", "conductor"}, {"eta", eta}, {"k", k}});
  // Black materials and bad weights.
  for (const char* type : {"plastic", "roughplastic", "roughdielectric", "dielectric"})
    out.push_back({{"type", type},
                   {"diffuse_reflectance", 0},
                   {"specular_reflectance", 0},
                   {"specular_transmittance", 0}});
  out.push_back({{"type", "principled"},
                 {"base_color", 0},
                 {"metallic", 7},
                 {"spec_trans", -2},
                 {"roughness", -1},
                 {"clearcoat", -1},
                 {"sheen", -1}});
  out.push_back({{"type", "mask"}, {"opacity", -3}, {"nested", {{{"type", "diffuse"}}}}});
  // Normals in the plane, against it and of no length.
  const json nested[] = {{{"type", "diffuse"}},
                         {{"type", "roughdielectric"}, {"alpha", 0.2f}},
                         {{"type", "roughconductor"}, {"alpha", 1e-3f}},
                         {{"type", "dielectric"}}};
  for (const json& inner : nested) {
    for (const json& normal :
         {json{1, 0, 0}, json{0, 0, -1}, json{0.7f, 0.7f, 1e-4f}, json{0, 0, 1}})
      for (const bool flip : {true, false})
        out.push_back({{"type", "normalmap"},
                       {"normal", normal},
                       {"flip_invalid_normals", flip},
                       {"nested", {inner}}});
    for (const float slope : {0.0f, 1e6f, 1e30f})
      for (const json& base :
           {inner,
            json{{"type", "normalmap"}, {"normal", {0.7f, 0.7f, 1e-4f}}, {"nested", {inner}}}})
        out.push_back({{"type", "bumpmap"}, {"slope", {slope, -slope}}, {"nested", {base}}});
  }
  return out;
}

/// What no weight exceeds, as far as there is a bound for radiance without its compression by
/// refraction: sampling visible normals leaves only the masking of the other direction, and
/// Burley's lobes and normals of all facets have grazing directions that are sampled too rarely.
float largest_weight(const json& bsdf) {
  if (mentions(bsdf, "type", "hair")) return kInfinity;
  const std::string type = bsdf["type"];
  if (type.starts_with("coated")) return kInfinity;
  if (type == "diffuse" || type == "null" || type.ends_with("dielectric") ||
      type.ends_with("conductor"))
    // Beckmann's masking is an approximation in values, but exact in densities.
    return bsdf.value("sample_visible", true) ? 1.005f : kInfinity;
  // A coat with an index below one would amplify the light of its base.
  if (type.ends_with("plastic") && bsdf.value("int_ior", 1.5f) > 0.99f) return 2;
  return kInfinity;
}

bool is_number(float x) {
  return std::isfinite(x) && x >= 0;
}
bool is_number(const Spectrum& s) {
  return is_number(s.r) && is_number(s.g) && is_number(s.b);
}

}  // namespace

TEST_SUITE("materials at their limits") {
  TEST_CASE("values, densities and weights are numbers, and most weights have a bound") {
    const Surface surface = flat_surface();
    const std::vector<Vector3f> all = directions();
    int bounded = 0;
    const float numbers[] = {0, 1e-9f, 0.3f, 0.5f, 0.9f, 1 - 1e-6f, kBelowOne};
    for (const json& description : descriptions()) {
      const TestMaterial material(description);
      const float most = largest_weight(description);
      bounded += most < kInfinity;
      Failures failures(description.dump());
      for (const Vector3f& wo : all) {
        const Bsdf bsdf = material->bind(surface, wo);
        for (const Transport transport : kTransports) {
          for (const Vector3f& wi : all) {
            const BsdfEval e = bsdf.eval(wi, transport);
            const float reverse = bsdf.reverse_pdf(wi, transport).value;
            if (!is_number(e.value) || !is_number(e.pdf.value) || !is_number(reverse))
              failures.add(fmt::format("from {} to {}: {}, density {}, reverse {}", text(wo),
                                       text(wi), text(e.value), e.pdf.value, reverse));
          }
          for (const float u : {0.0f, 0.4f, kBelowOne})
            for (const float x : numbers)
              for (const float y : numbers) {
                const auto s = bsdf.sample(u, {x, y}, transport);
                if (!s) continue;
                const float scale = transport == Transport::radiance ? sqr(s->eta) : 1.0f;
                const bool good = s->weight.max() * scale <= most && is_number(s->weight) &&
                                  is_number(s->pdf.value) && s->pdf.value > 0 &&
                                  is_number(s->eta) && std::abs(length(s->wi) - 1) < 1e-4f;
                if (!good)
                  failures.add(fmt::format("from {} at ({}, {}, {}): to {}, weight {}, density {}",
                                           text(wo), u, x, y, text(s->wi), text(s->weight),
                                           s->pdf.value));
              }
        }
      }
    }
    CHECK(bounded > 200);
  }
}
