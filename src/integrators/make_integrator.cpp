#include "integrators/make_integrator.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <limits>
#include <stdexcept>

#include "integrators/depth.h"
#include "integrators/direct.h"
#include "integrators/path.h"

namespace duet {

namespace {

/// A parameter of a method: how it is called, shown and set.
struct Parameter {
  std::string name;
  std::function<std::string()> get;
  std::function<void(const std::string&)> set;
};

int parse_int(const std::string& name, const std::string& text, int least, int most) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < least || value > most)
    throw std::invalid_argument(
        fmt::format("parameter \"{}\" needs a whole number from {} to {}, not \"{}\"", name, least,
                    most, text));
  return value;
}

bool parse_bool(const std::string& name, const std::string& text) {
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  throw std::invalid_argument(
      fmt::format("parameter \"{}\" needs true or false, not \"{}\"", name, text));
}

constexpr int kMaxDepth = std::numeric_limits<int>::max();
/// As many as the reader of scene files allows.
constexpr int kMaxDirectSamples = 1 << 16;

Parameter integer(const std::string& name, int& value, int least, int most) {
  return {name, [&value] { return fmt::to_string(value); },
          [&value, name, least, most](const std::string& t) {
            value = parse_int(name, t, least, most);
          }};
}

Parameter boolean(const std::string& name, bool& value) {
  return {name, [&value] { return std::string(value ? "true" : "false"); },
          [&value, name](const std::string& t) { value = parse_bool(name, t); }};
}

std::vector<Parameter> parameters(PathIntegratorDescription& d) {
  return {integer("max_depth", d.max_depth, -1, kMaxDepth),
          integer("rr_depth", d.rr_depth, 1, kMaxDepth),

          boolean("hide_emitters", d.hide_emitters), boolean("strict_normals", d.strict_normals)};
}
std::vector<Parameter> parameters(DirectIntegratorDescription& d) {
  return {integer("emitter_samples", d.emitter_samples, 0, kMaxDirectSamples),
          integer("bsdf_samples", d.bsdf_samples, 0, kMaxDirectSamples),
          boolean("hide_emitters", d.hide_emitters), boolean("strict_normals", d.strict_normals)};
}
std::vector<Parameter> parameters(DepthIntegratorDescription&) {
  return {};
}

/// Keeps what another method of the scene already said.
void select_method(IntegratorDescription& integrator, const std::string& name) {
  if (name == integrator_name(integrator)) return;
  integrator.image = name != "aov";
  if (name == "path")
    integrator.method = PathIntegratorDescription{};
  else if (name == "direct")
    integrator.method = DirectIntegratorDescription{};
  else if (name == "depth")
    integrator.method = DepthIntegratorDescription{};
  else if (name != "aov") {
    std::vector<std::string> known;
    for (const IntegratorName& n : integrator_names()) known.push_back(n.name);
    throw std::invalid_argument(fmt::format("there is no integrator \"{}\"{}; there are {}", name,
                                            did_you_mean(name, known), fmt::join(known, ", ")));
  }
}

CameraOutput camera_output(const IntegratorDescription& integrator) {
  CameraOutput output;
  output.image = integrator.image;
  for (const AovDescription::Layer& layer : integrator.aovs.layers) {
    const auto kind = find_layer(layer.kind);
    if (!kind)
      throw std::invalid_argument(fmt::format("there is no layer \"{}\"{}; there are {}",
                                              layer.kind, did_you_mean(layer.kind, layer_names()),
                                              fmt::join(layer_names(), ", ")));
    if (!output.image && (*kind == LayerKind::moments || *kind == LayerKind::variance))
      throw std::invalid_argument(
          fmt::format("layer \"{}\" needs an image, which \"aov\" does not make", layer.kind));
    for (const Layer& other : output.layers)
      if (other.name == layer.name)
        throw std::invalid_argument(fmt::format("two layers are called \"{}\"", layer.name));
    output.layers.push_back({*kind, layer.name});
  }
  if (integrator.moments) output.layers.push_back({LayerKind::moments, "m2"});
  if (!output.image && output.layers.empty())
    throw std::invalid_argument("the aov integrator needs layers (--aov LIST)");
  return output;
}

}  // namespace

const std::vector<IntegratorName>& integrator_names() {
  static const std::vector<IntegratorName> names{
      {"path", "path tracing with next event estimation"},
      {"direct", "light seen directly or after one scattering"},
      {"depth", "distance to the first surface"},
      {"aov", "layers only, chosen with --aov"},
  };
  return names;
}

void apply_override(IntegratorDescription& integrator, const IntegratorOverride& with) {
  if (!with.name.empty()) select_method(integrator, with.name);
  std::vector<Parameter> known =
      std::visit([](auto& m) { return parameters(m); }, integrator.method);
  for (const auto& [name, value] : with.parameters) {
    bool found = false;
    for (Parameter& p : known)
      if (p.name == name) p.set(value), found = true;
    if (found) continue;
    std::vector<std::string> names;
    for (const Parameter& p : known) names.push_back(p.name);
    throw std::invalid_argument(fmt::format("integrator \"{}\" has no parameter \"{}\"{}",
                                            integrator_name(integrator), name,
                                            did_you_mean(name, names)));
  }
  if (const auto* direct = std::get_if<DirectIntegratorDescription>(&integrator.method);
      direct && direct->emitter_samples + direct->bsdf_samples == 0)
    throw std::invalid_argument("integrator \"direct\" needs samples of emitters or of BSDFs");
  std::vector<AovDescription::Layer>& layers = integrator.aovs.layers;
  for (const std::string& name : with.layers) {
    const AovDescription::Layer layer{name, name};
    if (std::find(layers.begin(), layers.end(), layer) == layers.end()) layers.push_back(layer);
  }
}

std::string integrator_name(const IntegratorDescription& integrator) {
  if (!integrator.image) return "aov";
  struct Name {
    const char* operator()(const PathIntegratorDescription&) const { return "path"; }
    const char* operator()(const DirectIntegratorDescription&) const { return "direct"; }
    const char* operator()(const DepthIntegratorDescription&) const { return "depth"; }
  };
  return std::visit(Name{}, integrator.method);
}

std::string integrator_parameters(const IntegratorDescription& integrator) {
  IntegratorDescription copy = integrator;
  std::vector<std::string> parts;
  for (const Parameter& p : std::visit([](auto& m) { return parameters(m); }, copy.method))
    parts.push_back(p.name + "=" + p.get());
  return fmt::format("{}", fmt::join(parts, " "));
}

SurfaceNeeds integrator_needs(const IntegratorDescription& integrator) {
  SurfaceNeeds needs;
  for (const AovDescription::Layer& layer : integrator.aovs.layers)
    if (const auto kind = find_layer(layer.kind)) needs = needs | layer_needs(*kind);
  return needs;
}

std::unique_ptr<Integrator> make_integrator(const IntegratorDescription& integrator) {
  struct Make {
    CameraOutput output;
    std::unique_ptr<Integrator> operator()(const PathIntegratorDescription& d) const {
      const PathOptions o{d.max_depth, d.rr_depth, d.hide_emitters, d.strict_normals};
      return std::make_unique<PathIntegrator>(o, output);
    }
    std::unique_ptr<Integrator> operator()(const DirectIntegratorDescription& d) const {
      const DirectOptions o{d.emitter_samples, d.bsdf_samples, d.hide_emitters, d.strict_normals};
      return std::make_unique<DirectIntegrator>(o, output);
    }
    std::unique_ptr<Integrator> operator()(const DepthIntegratorDescription&) const {
      return std::make_unique<DepthIntegrator>(output);
    }
  };
  return std::visit(Make{camera_output(integrator)}, integrator.method);
}

}  // namespace duet
