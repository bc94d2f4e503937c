#include "integrators/make_integrator.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include "integrators/auto.h"
#include "integrators/bidirectional.h"
#include "integrators/depth.h"
#include "integrators/direct.h"
#include "integrators/method_rules.h"
#include "integrators/occlusion.h"
#include "integrators/parameters.h"
#include "integrators/path.h"
#include "integrators/volpath.h"
#include "scene/description.h"
#include "scene/features.h"

namespace duet {

namespace {

using Method = decltype(IntegratorDescription::method);

/// The method of that name with its presets; nothing if there is none. Layers alone come from
/// camera rays, which any method that starts at the camera has.
std::optional<Method> find_method(const std::string& name) {
  if (name == "auto") return AutoIntegratorDescription{};
  if (name == "path" || name == "aov") return PathIntegratorDescription{};
  if (name == "volpath") return VolumePathIntegratorDescription{};
  if (name == "volpathmis") return VolumePathIntegratorDescription{{}, VolumePathName::volpathmis};
  if (name == "direct") return DirectIntegratorDescription{};
  if (name == "depth") return DepthIntegratorDescription{};
  if (name == "ao") return OcclusionIntegratorDescription{};
  constexpr auto& methods = BidirectionalIntegratorDescription::kMethods;
  for (size_t i = 0; i < std::size(methods); ++i)
    if (name == methods[i])
      return BidirectionalIntegratorDescription{.method = BidirectionalMethod(i)};
  return std::nullopt;
}

/// Whether a parameter asks for the same in every method that has it.
bool is_shared(const std::string& parameter) {
  return parameter == "max_depth" || parameter == "rr_depth" || parameter == "hide_emitters" ||
         parameter == "strict_normals" || parameter == "light_selection";
}

/// Keeps what another method of the scene already said.
void select_method(IntegratorDescription& integrator, const std::string& name) {
  if (name == integrator_name(integrator)) return;
  const std::optional<Method> method = find_method(name);
  if (!method) {
    std::vector<std::string> known;
    for (const IntegratorName& n : integrator_names()) known.push_back(n.name);
    throw std::invalid_argument(fmt::format("there is no integrator \"{}\"{}; there are {}", name,
                                            did_you_mean(name, known), fmt::join(known, ", ")));
  }
  IntegratorDescription selected = integrator;
  selected.method = *method;
  selected.image = name != "aov";
  for (const MethodParameter& from : method_parameters(integrator))
    for (const MethodParameter& to : method_parameters(selected))
      if (from.name == to.name && is_shared(to.name)) to.set(from.get());
  integrator = std::move(selected);
}

/// In the order of the method's parameters, because some depend on others before them.
void set_parameters(IntegratorDescription& integrator,
                    const std::vector<std::pair<std::string, std::string>>& values) {
  const std::vector<MethodParameter> parameters = method_parameters(integrator);
  std::vector<std::string> names;
  for (const MethodParameter& p : parameters) names.push_back(p.name);
  for (const auto& [name, value] : values)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw std::invalid_argument(fmt::format("integrator \"{}\" has no parameter \"{}\"{}",
                                              integrator_name(integrator), name,
                                              did_you_mean(name, names)));
  for (const MethodParameter& p : parameters)
    for (const auto& [name, value] : values)
      if (p.name == name) p.set(value);
}

CameraOutput camera_output(const IntegratorDescription& integrator) {
  CameraOutput output;
  output.image = integrator.image;
  output.frame = Transform(integrator.aovs.frame);
  for (const AovDescription::Layer& layer : integrator.aovs.layers) {
    const auto kind = find_layer(layer.kind);
    if (!kind)
      throw std::invalid_argument(fmt::format("there is no layer \"{}\"{}; there are {}",
                                              layer.kind, did_you_mean(layer.kind, layer_names()),
                                              fmt::join(layer_names(), ", ")));
    if (!output.image && layer_needs_image(*kind))
      throw std::invalid_argument(
          fmt::format("layer \"{}\" needs an image, which \"aov\" does not make", layer.kind));
    for (const Layer& other : output.layers)
      if (other.name == layer.name)
        throw std::invalid_argument(fmt::format("two layers are called \"{}\"", layer.name));
    output.layers.push_back({*kind, layer.name, layer.in_frame});
  }
  if (integrator.moments) output.layers.push_back({LayerKind::moments, "m2"});
  if (!output.image && output.layers.empty())
    throw std::invalid_argument("the aov integrator needs layers (--aov LIST)");
  return output;
}

/// Whether light samples end at surfaces that light passes straight through.
bool stops_at_passed_surfaces(const Method& method) {
  return std::holds_alternative<PathIntegratorDescription>(method) ||
         std::holds_alternative<DirectIntegratorDescription>(method);
}

/// Where a scene first has what not every method can render, or null.
struct LimitLocations {
  const SourceLocation* medium = nullptr;
  const SourceLocation* emissive_medium = nullptr;
  const SourceLocation* one_way_surface = nullptr;
};

LimitLocations find_limits(const SceneDescription& scene) {
  LimitLocations found;
  const auto look_into = [&](std::optional<MediumId> id) {
    if (!id) return;
    const MediumDescription& m = scene.media[size_t(*id)];
    if (!found.medium) found.medium = &m.where;
    if (!found.emissive_medium && m.emission) found.emissive_medium = &m.where;
  };
  const auto look_at = [&](const std::vector<ShapeDescription>& shapes) {
    for (const ShapeDescription& s : shapes) {
      look_into(s.interior), look_into(s.exterior);
      if (!found.one_way_surface && is_one_way(scene, s)) found.one_way_surface = &s.where;
    }
  };
  for (const SensorDescription& s : scene.sensors) look_into(s.medium);
  for (const ShapeGroupDescription& g : scene.groups) look_at(g.shapes);
  look_at(scene.shapes);
  return found;
}

}  // namespace

const std::vector<IntegratorName>& integrator_names() {
  static const std::vector<IntegratorName> names{
      {"auto", "path, volpath, bdpt, vcm or ppm, whichever suits the scene"},
      {"path", "path tracing with next event estimation"},
      {"volpath", "path tracing through participating media"},
      {"volpathmis", "the same by its second name in Mitsuba"},
      {"direct", "light seen directly or after one scattering"},
      {"ptracer", "light tracing: paths from the lights, connected to the camera"},
      {"bdpt", "bidirectional path tracing"},
      {"reuse", "bidirectional path tracing that reuses light sub-paths"},
      {"ppm", "progressive photon mapping"},
      {"bpm", "bidirectional photon mapping"},
      {"vcm", "vertex connection and merging"},
      {"depth", "distance to the first surface"},
      {"ao", "ambient occlusion: how much of the space above a surface is free"},
      {"aov", "layers only, chosen with --aov"},
  };
  return names;
}

void apply_override(IntegratorDescription& integrator, const IntegratorOverride& with) {
  if (!with.name.empty()) select_method(integrator, with.name);
  set_parameters(integrator, with.parameters);
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
  return std::visit([](const auto& m) { return std::string(m.method_name()); }, integrator.method);
}

std::string integrator_parameters(const IntegratorDescription& integrator) {
  IntegratorDescription copy = integrator;
  std::vector<std::string> parts;
  for (const MethodParameter& p : method_parameters(copy))
    if (const std::string value = p.get(); !value.empty()) parts.push_back(p.name + "=" + value);
  return fmt::format("{}", fmt::join(parts, " "));
}

SurfaceNeeds integrator_needs(const IntegratorDescription& integrator) {
  SurfaceNeeds needs;
  for (const AovDescription::Layer& layer : integrator.aovs.layers)
    if (const auto kind = find_layer(layer.kind)) needs = needs | layer_needs(*kind);
  return needs;
}

void check_support(const SceneDescription& scene, const IntegratorDescription& integrator,
                   Diagnostics& diagnostics) {
  if (!integrator.image) return;
  const bool skips_masks = !scene.counts_passed_surfaces && scene_features(scene).skips_masks;
  if (skips_masks && stops_at_passed_surfaces(integrator.method))
    diagnostics.warning(integrator.where,
                        "integrator \"{}\" stops light samples at surfaces with alpha and counts "
                        "them for the depth of paths, as pbrt does not; \"volpath\" renders this "
                        "scene as pbrt does",
                        integrator_name(integrator));
  if (const MediumDescription* fog = endless_medium(scene);
      fog && scene_features(scene).far_lights())
    diagnostics.warning(fog->where,
                        "this medium around the sensor has no end: nothing of the light that comes "
                        "from infinitely far away gets through it");
  const LimitLocations found = find_limits(scene);
  const SceneLimits limits{.media = found.medium != nullptr,
                           .one_way_surfaces = found.one_way_surface != nullptr,
                           .emissive_media = found.emissive_medium != nullptr,
                           .skips_masks = skips_masks};
  switch (find_obstacle(limits, integrator.method)) {
    case Obstacle::media:
      return diagnostics.error(
          found.medium ? *found.medium : integrator.where,
          "integrator \"{}\" cannot render this scene: {}; \"volpath\", \"bdpt\" and \"vcm\" can",
          integrator_name(integrator),
          std::get<BidirectionalIntegratorDescription>(integrator.method).method ==
                  BidirectionalMethod::reuse
              ? "the weights of the thesis know no participating media, nor surfaces with alpha "
                "that are no vertices"
              : "it has no photons in participating media, only on surfaces");
    case Obstacle::emissive_media:
      return diagnostics.error(
          *found.emissive_medium,
          "integrator \"{}\" has no light sub-paths that start in this medium, "
          "which emits; \"volpath\" finds its light",
          integrator_name(integrator));
    case Obstacle::one_way_surfaces:
      return diagnostics.error(*found.one_way_surface,
                               "integrator \"{}\" cannot follow light through curves of this "
                               "kind from its source, because rays see them from outside only, "
                               "or as ribbons that face each of them; \"{}\" can",
                               integrator_name(integrator), limits.media ? "volpath" : "path");
    case Obstacle::none:
    case Obstacle::sensor:
      return;
  }
}

void check_support(const SensorDescription& sensor, const IntegratorDescription& integrator,
                   Diagnostics& diagnostics) {
  const SceneLimits limits{.connectible = is_connectible(sensor.kind)};
  if (integrator.image && find_obstacle(limits, integrator.method) == Obstacle::sensor)
    diagnostics.error(sensor.where,
                      "integrator \"{}\" needs a sensor with which light sub-paths can be "
                      "connected: this one only sends rays, as \"path\" and \"bdpt\" need it",
                      integrator_name(integrator));
}

std::unique_ptr<Integrator> make_integrator(const IntegratorDescription& integrator,
                                            TechniqueOutput techniques) {
  struct Make {
    const IntegratorDescription& whole;
    CameraOutput output;
    std::unique_ptr<Integrator> operator()(const PathIntegratorDescription& d) const {
      return std::make_unique<PathIntegrator>(d, output);
    }
    std::unique_ptr<Integrator> operator()(const VolumePathIntegratorDescription& d) const {
      return std::make_unique<VolumePathIntegrator>(d, output);
    }
    std::unique_ptr<Integrator> operator()(const DirectIntegratorDescription& d) const {
      const DirectOptions o{d.emitter_samples, d.bsdf_samples, d.hide_emitters, d.strict_normals};
      return std::make_unique<DirectIntegrator>(o, output);
    }
    std::unique_ptr<Integrator> operator()(const DepthIntegratorDescription&) const {
      return std::make_unique<DepthIntegrator>(output);
    }
    std::unique_ptr<Integrator> operator()(const OcclusionIntegratorDescription& d) const {
      return std::make_unique<OcclusionIntegrator>(d, output);
    }
    std::unique_ptr<Integrator> operator()(const BidirectionalIntegratorDescription& d) const {
      return make_bidirectional(d, output);
    }
    std::unique_ptr<Integrator> operator()(const AutoIntegratorDescription& d) const {
      return std::make_unique<AutoIntegrator>(d, whole);
    }
  };
  CameraOutput output = camera_output(integrator);
  output.techniques = techniques;
  if (techniques != TechniqueOutput::none &&
      !std::holds_alternative<BidirectionalIntegratorDescription>(integrator.method))
    throw std::invalid_argument(
        fmt::format("integrator \"{}\" has no techniques to show", integrator_name(integrator)));
  return std::visit(Make{integrator, output}, integrator.method);
}

}  // namespace duet
