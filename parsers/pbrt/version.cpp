// Finds out which version of pbrt a file is for.
#include <algorithm>
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

/// Parameters that only v3 has.
constexpr std::string_view kParametersOfV3[] = {"mapname", "samples", "nsamples"};

/// What a file says from its beginning on.
class Search {
 public:
  explicit Search(std::vector<std::string>& includes) : includes_(includes) {}

  std::optional<Version> directive(std::string word) {
    directive_ = std::move(word);
    strings_ = 0;
    for (const Evidence& e : kDirectives)
      if (e.directive == directive_) return e.version;
    return std::nullopt;
  }

  std::optional<Version> string(const std::string& text) {
    const size_t index = strings_++;
    if (directive_ == "Include") {
      if (index == 0) includes_.push_back(text);
      return std::nullopt;
    }
    const bool is_name = index == 0 || is_type_;
    const std::string_view directive = is_type_ ? "Material" : std::string_view(directive_);
    // A named material's type is a value.
    is_type_ = directive_ == "MakeNamedMaterial" && text.ends_with(" type");
    if (is_name) {
      for (const Evidence& e : kEvidence)
        if (!directive.empty() && e.directive == directive && e.name == text) return e.version;
      return std::nullopt;
    }
    if (directive_ == "Texture" && index == 1)
      return text == "color" ? std::optional(v3) : std::nullopt;
    return parameter(text);
  }

 private:
  /// Of "type name"; also of a value that looks like one.
  std::optional<Version> parameter(std::string_view text) const {
    const size_t gap = text.find(' ');
    if (gap == text.npos) return std::nullopt;
    for (const Evidence& e : kEvidence)
      if (e.directive.empty() && e.name == text.substr(0, gap)) return e.version;
    const std::string_view name = text.substr(text.rfind(' ') + 1);
    const bool is_known = find_type(text.substr(0, gap)).has_value();
    // Coats of v4 have samples, too.
    if (name == "nsamples" && directive_.ends_with("Material")) return std::nullopt;
    if (is_known && std::ranges::find(kParametersOfV3, name) != std::end(kParametersOfV3))
      return v3;
    return std::nullopt;
  }

  std::vector<std::string>& includes_;
  std::string directive_;
  size_t strings_ = 0;  ///< behind the directive
  bool is_type_ = false;
};

/// Of an included file, where evidence stands at the beginning if there is any.
constexpr uint64_t kHead = uint64_t(1) << 20;
constexpr size_t kMostFiles = 64;

}  // namespace

std::optional<Version> find_evidence(Lexer& in, std::vector<std::string>& includes) {
  Search search(includes);
  std::vector<double> ignored;
  while (true) {
    try {
      std::optional<Version> found;
      switch (in.peek()) {
        case Kind::end:
          return std::nullopt;
        case Kind::word:
          found = search.directive(in.take_word());
          break;
        case Kind::string:
          found = search.string(in.take_string());
          break;
        case Kind::number:
          in.take_numbers(ignored);
          ignored.clear();
          break;
        default:
          in.take_bracket();
      }
      if (found) return found;
    } catch (const SyntaxError&) {
      in.skip_to_next_line();
    }
  }
}

Version find_version(const std::string& file, const Options& options) {
  std::vector<std::string> names, seen{file};
  Lexer main(file);
  if (const auto found = find_evidence(main, names)) return *found;
  // Those that come first are asked first, and then those that they include.
  for (size_t i = 0; i < names.size() && seen.size() <= kMostFiles; ++i) {
    const std::string path = find_file(file, names[i], options);
    if (path.empty() || std::ranges::find(seen, path) != seen.end()) continue;
    seen.push_back(path);
    try {
      Lexer in(path, kHead);
      if (const auto found = find_evidence(in, names)) return *found;
    } catch (const ReadError&) {
      continue;  // the reader reports it
    }
  }
  return v4;
}

}  // namespace duet::pbrt
