#include "mitsuba/scene_reader.h"

#include <algorithm>

#include "scene/texture_uses.h"

namespace duet {

namespace {

/// References lead no deeper than this into one another.
constexpr int kDeepest = 100;

}  // namespace

bool SceneReader::may_enter(const Node& node) {
  if (std::find(active_.begin(), active_.end(), &node) != active_.end())
    report_.error(node.where, "{} contains itself", describe(node));
  else if (active_.size() >= kDeepest)
    report_.error(node.where, "plugins refer to one another more than {} deep", kDeepest);
  else
    return true;
  return false;
}

template <class Id, class T>
std::optional<Id> SceneReader::once(const Node& node, std::vector<T>& list, T initial) {
  if (!ids_.contains(&node)) {
    initial.where = node.where;
    initial.label = {node.id};
    std::optional<uint32_t> id;
    if (read_into(node, initial)) {
      id = uint32_t(list.size());
      list.push_back(std::move(initial));
    }
    ids_[&node] = id;
  }
  const std::optional<uint32_t> id = ids_[&node];
  return id ? std::optional(Id{*id}) : std::nullopt;
}

std::optional<TextureId> SceneReader::texture(const Node& node) {
  return once<TextureId>(node, description_.textures);
}

std::optional<MaterialId> SceneReader::material(const Node& node) {
  return once<MaterialId>(node, description_.materials);
}

std::optional<MediumId> SceneReader::medium(const Node& node) {
  return once<MediumId>(node, description_.media);
}

std::optional<PhaseId> SceneReader::phase(const Node& node) {
  return once<PhaseId>(node, description_.phases);
}

std::optional<uint32_t> SceneReader::shape_group(const Node& node) {
  return once<uint32_t>(node, description_.groups);
}

PhaseId SceneReader::add_phase(PhaseDescription phase) {
  description_.phases.push_back(std::move(phase));
  return PhaseId{uint32_t(description_.phases.size() - 1)};
}

VolumeId SceneReader::add_volume(VolumeDescription volume) {
  description_.volumes.push_back(std::move(volume));
  return VolumeId{uint32_t(description_.volumes.size() - 1)};
}

std::optional<ColorVolume> SceneReader::volume(const Node& node, ColorMeaning meaning) {
  const auto [entry, is_new] = volumes_.try_emplace({&node, meaning});
  if (MeantVolume volume{meaning, {}}; is_new && read_into(node, volume))
    entry->second = volume.value;
  return entry->second;
}

MaterialId SceneReader::shared_material(std::optional<float> reflectance,
                                        const SourceLocation& where) {
  const auto [entry, is_new] = shared_materials_.try_emplace(
      reflectance, MaterialId{uint32_t(description_.materials.size())});
  if (is_new && reflectance)
    description_.materials.push_back({where, {}, DiffuseMaterial{Spectrum(*reflectance)}});
  else if (is_new)
    description_.materials.push_back({where, {}, NullMaterial{}});
  return entry->second;
}

void SceneReader::approximate(const SourceLocation& where, std::string what) {
  for (const Diagnostic& d : description_.approximations)
    if (d.message == what) return;
  description_.approximations.push_back({Severity::warning, where, std::move(what)});
}

void SceneReader::approximate_loudly(const SourceLocation& where, std::string what) {
  report_.warning(where, "{}", what);
  approximate(where, std::move(what));
}

SceneDescription SceneReader::read(const NodeTree& tree, const std::string& file) {
  description_.file = file;
  top_level(tree);
  settle_checkerboards(description_);
  return std::move(description_);
}

void SceneReader::top_level(const NodeTree& tree) {
  const Node& scene = tree.nodes.front();
  Properties p(scene, report_);
  // Everything is read in the order of the file, also what nobody refers to: Mitsuba does it, too.
  const Node* integrator = p.child(PluginKind::integrator);
  for (int kind = 0; kind < kPluginKinds; ++kind)
    if (PluginKind(kind) != PluginKind::subsurface) p.children(PluginKind(kind));
  for (const Property& property : scene.properties)
    if (const Node* const* node = std::get_if<const Node*>(&property.value))
      if ((*node)->plugin) top_level(**node);
  p.finish();
  for (const auto& [node, used] : surface_lights_)
    if (!used)
      report_.warning(node->where, "{} belongs to no shape and gives no light", describe(*node));
  if (integrator) {
    description_.integrator.where = integrator->where;
    read_into(*integrator, description_.integrator);
  }
  check_scene(tree, integrator != nullptr);
}

void SceneReader::top_level(const Node& node) {
  const auto checked_only = [&](auto unused) { read_into(node, unused); };
  switch (node.kind) {
    case PluginKind::texture:
      if (std::holds_alternative<ReadInto<MeantColor>>(node.plugin->reader))
        return checked_only(MeantColor{ColorMeaning::unbounded, {}});
      return void(texture(node));
    case PluginKind::bsdf:
      return void(material(node));
    case PluginKind::medium:
      return void(medium(node));
    case PluginKind::phase:
      return void(phase(node));
    case PluginKind::shape:
      return shape(node, description_.shapes, false);
    case PluginKind::emitter:
      // One that belongs to a surface may stand here to be referred to.
      if (std::holds_alternative<ReadInto<AreaEmission>>(node.plugin->reader))
        surface_lights_.try_emplace(&node, false);
      else if (LightDescription light{node.where, {node.id}, PointLight{}, {}, {}, 1, {}};
               read_into(node, light))
        description_.lights.push_back(std::move(light));
      return;
    case PluginKind::sensor:
      if (SensorDescription sensor; read_into(node, sensor)) {
        if (sensor.kind == SensorKind::irradiancemeter)
          report_.error(node.where, "{} must stand in a shape", describe(node));
        description_.sensors.push_back(std::move(sensor));
      }
      return;
    case PluginKind::film:
      return checked_only(FilmDescription{});
    case PluginKind::sampler:
      return checked_only(SamplerDescription{});
    case PluginKind::rfilter:
      return checked_only(FilterDescription{});
    default:
      return;
  }
}

Boxed<AreaEmission> SceneReader::emission(const Node& node) {
  if (const auto known = surface_lights_.find(&node); known != surface_lights_.end())
    known->second = true;
  AreaEmission emission;
  emission.where = node.where;
  if (!read_into(node, emission)) return {};
  return emission;
}

void SceneReader::check_scene(const NodeTree& tree, bool have_integrator) {
  if (report_.has_errors()) return;
  const Node& scene = tree.nodes.front();
  const bool old = scene.version.is_0x();
  if (description_.sensors.empty()) report_.error(scene.where, "the scene has no sensor");
  // Mitsuba 0.x renders the last sensor, Mitsuba 3 the first one.
  auto& sensors = description_.sensors;
  if (old && sensors.size() > 1) std::rotate(sensors.begin(), sensors.end() - 1, sensors.end());

  if (!have_integrator) {
    description_.integrator.where = scene.where;
    description_.integrator.method = AutoIntegratorDescription{};
    if (!tree.integrator_replaced)
      approximate_loudly(
          scene.where, old ? "the scene has no integrator: \"auto\" is used (Mitsuba 0.6 would use "
                             "\"direct\")"
                           : "the scene has no integrator: \"auto\" is used (Mitsuba 3 would use "
                             "\"path\")");
  }
  const LightDescription* environment = nullptr;
  for (const LightDescription& light : description_.lights) {
    if (!is_environment(light)) continue;
    if (environment)
      report_.error(light.where, "a scene can have one environment only; another is at {}",
                    environment->where.to_string());
    environment = &light;
  }
  const bool dark = description_.lights.empty() &&
                    std::none_of(description_.shapes.begin(), description_.shapes.end(),
                                 [](const ShapeDescription& s) { return s.emission.has_value(); });
  if (dark && old)
    approximate_loudly(scene.where,
                       "the scene has no light and stays dark (Mitsuba 0.6 would add sun and sky)");
}

}  // namespace duet
