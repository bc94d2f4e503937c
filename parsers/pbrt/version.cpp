// Finds out which version of pbrt a file is for.
#include <string_view>

#include "pbrt/pbrt.h"

namespace duet::pbrt {

namespace {

struct Evidence {
  std::string_view directive;
  /// What follows it in quotes, or a parameter's type if the directive is empty.
  std::string_view name;
  Version version;
};

constexpr Version v3 = Version::v3, v4 = Version::v4;
constexpr Evidence kEvidence[] = {
    {"Film", "image", v3},
    {"Film", "rgb", v4},
    {"Film", "gbuffer", v4},
    {"Film", "spectral", v4},
    {"Sampler", "lowdiscrepancy", v3},
    {"Sampler", "02sequence", v3},
    {"Sampler", "zerotwosequence", v3},
    {"Sampler", "random", v3},
    {"Sampler", "maxmindist", v3},
    {"Sampler", "zsobol", v4},
    {"Sampler", "paddedsobol", v4},
    {"Sampler", "independent", v4},
    {"Sampler", "pmj02bn", v4},
    {"Camera", "environment", v3},
    {"Camera", "spherical", v4},
    {"Integrator", "directlighting", v3},
    {"Integrator", "whitted", v3},
    {"Integrator", "ao", v3},
    {"Integrator", "simplepath", v4},
    {"Integrator", "simplevolpath", v4},
    {"Integrator", "lightpath", v4},
    {"Integrator", "randomwalk", v4},
    {"Integrator", "ambientocclusion", v4},
    {"Material", "matte", v3},
    {"Material", "plastic", v3},
    {"Material", "metal", v3},
    {"Material", "glass", v3},
    {"Material", "mirror", v3},
    {"Material", "substrate", v3},
    {"Material", "translucent", v3},
    {"Material", "uber", v3},
    {"Material", "disney", v3},
    {"Material", "kdsubsurface", v3},
    {"Material", "fourier", v3},
    {"Material", "diffuse", v4},
    {"Material", "conductor", v4},
    {"Material", "dielectric", v4},
    {"Material", "thindielectric", v4},
    {"Material", "coateddiffuse", v4},
    {"Material", "coatedconductor", v4},
    {"Material", "diffusetransmission", v4},
    {"Material", "interface", v4},
    {"Material", "measured", v4},
    {"Shape", "bilinearmesh", v4},
    {"Shape", "cone", v3},
    {"Shape", "paraboloid", v3},
    {"Shape", "hyperboloid", v3},
    {"Shape", "heightfield", v3},
    {"Shape", "nurbs", v3},
    {"AreaLightSource", "area", v3},
    {"", "point", v3},
    {"", "vector", v3},
    {"", "color", v3},
};
/// Directives that only one version has.
constexpr Evidence kDirectives[] = {
    {"WorldEnd", "", v3}, {"SurfaceIntegrator", "", v3},
    {"Import", "", v4},   {"Attribute", "", v4},
    {"Option", "", v4},   {"ColorSpace", "", v4},
    {"Renderer", "", v3}, {"VolumeIntegrator", "", v3},
};

}  // namespace

Version find_version(Lexer& in) {
  std::string directive;
  bool is_name = false;
  std::vector<double> ignored;
  while (true) {
    try {
      switch (in.peek()) {
        case Kind::end:
          return v4;
        case Kind::word:
          directive = in.take_word();
          is_name = true;
          for (const Evidence& e : kDirectives)
            if (e.directive == directive) return e.version;
          break;
        case Kind::string: {
          const std::string text = in.take_string();
          const std::string_view type = std::string_view(text).substr(0, text.find(' '));
          for (const Evidence& e : kEvidence) {
            if (e.directive.empty() ? !is_name && type.size() < text.size() && type == e.name
                                    : is_name && directive == e.directive && text == e.name)
              return e.version;
          }
          // A named material's type is a value.
          is_name = directive == "MakeNamedMaterial" && text.ends_with(" type");
          if (is_name) directive = "Material";
          break;
        }
        case Kind::number:
          in.take_numbers(ignored);
          ignored.clear();
          break;
        default:
          in.take_bracket();
      }
    } catch (const SyntaxError&) {
      in.skip_to_next_line();
    }
  }
}

}  // namespace duet::pbrt
