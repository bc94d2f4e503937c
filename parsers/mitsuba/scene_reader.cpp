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

template <class Read>
std::optional<uint32_t> SceneReader::once(const Node& node, Read read) {
  if (const auto known = ids_.find(&node); known != ids_.end()) return known->second;
  const std::optional<uint32_t> id = read();
  ids_[&node] = id;
  return id;
}

std::optional<TextureId> SceneReader::texture(const Node& node) {
  const auto id = once(node, [&]() -> std::optional<uint32_t> {
    TextureDescription texture{node.where, {node.id}, BitmapTexture{}};
    if (!read_into(node, texture)) return std::nullopt;
    description_.textures.push_back(std::move(texture));
    return uint32_t(description_.textures.size() - 1);
  });
  return id ? std::optional(TextureId{*id}) : std::nullopt;
}

std::optional<MaterialId> SceneReader::material(const Node& node) {
  const auto id = once(node, [&]() -> std::optional<uint32_t> {
    MaterialDescription material{node.where, {node.id}};
    if (!read_into(node, material)) return std::nullopt;
    description_.materials.push_back(std::move(material));
    return uint32_t(description_.materials.size() - 1);
  });
  return id ? std::optional(MaterialId{*id}) : std::nullopt;
}

std::optional<MediumId> SceneReader::medium(const Node& node) {
  const auto id = once(node, [&]() -> std::optional<uint32_t> {
    MediumDescription medium;
    medium.where = node.where;
    medium.label = {node.id};
    if (!read_into(node, medium)) return std::nullopt;
    description_.media.push_back(std::move(medium));
    return uint32_t(description_.media.size() - 1);
  });
  return id ? std::optional(MediumId{*id}) : std::nullopt;
}

std::optional<PhaseId> SceneReader::phase(const Node& node) {
  const auto id = once(node, [&]() -> std::optional<uint32_t> {
    PhaseDescription phase{node.where, {node.id}, IsotropicPhase{}};
    if (!read_into(node, phase)) return std::nullopt;
    return uint32_t(add_phase(std::move(phase)));
  });
  return id ? std::optional(PhaseId{*id}) : std::nullopt;
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
  if (is_new) {
    MeantVolume volume{meaning, {}};
    if (read_into(node, volume)) volumes_[{&node, meaning}] = volume.value;
  }
  return volumes_[{&node, meaning}];
}

std::shared_ptr<const VolumeGrid> SceneReader::volume_grid(const std::string& file,
                                                           const SourceLocation& where,
                                                           bool& is_float32) {
  const auto [entry, is_new] = volume_files_.try_emplace(file);
  if (is_new) try {
      entry->second = std::make_shared<VolumeFile>(access_.read_volume(file));
    } catch (const ReadError& error) {
      report_.error(where, "{}", error.what());
    }
  if (!entry->second) return nullptr;
  is_float32 = entry->second->is_float32;
  return {entry->second, &entry->second->grid};
}

std::optional<uint32_t> SceneReader::shape_group(const Node& node) {
  return once(node, [&]() -> std::optional<uint32_t> {
    ShapeGroupDescription group{node.where, {node.id}, {}};
    if (!read_into(node, group)) return std::nullopt;
    description_.groups.push_back(std::move(group));
    return uint32_t(description_.groups.size() - 1);
  });
}

MaterialId SceneReader::grey_material(float reflectance, const SourceLocation& where) {
  const auto [entry, is_new] = greys_.try_emplace(reflectance);
  if (is_new) {
    entry->second = MaterialId{uint32_t(description_.materials.size())};
    description_.materials.push_back({where, {}, DiffuseMaterial{Spectrum(reflectance)}});
  }
  return entry->second;
}

MaterialId SceneReader::null_material(const SourceLocation& where) {
  if (!null_) {
    null_ = MaterialId{uint32_t(description_.materials.size())};
    description_.materials.push_back({where, {}, NullMaterial{}});
  }
  return *null_;
}

std::shared_ptr<const TriangleMesh> SceneReader::mesh(const std::string& plugin,
                                                      const std::string& file,
                                                      const MeshOptions& options,
                                                      const SourceLocation& where) {
  const std::string key =
      fmt::format("{} {} {} {} {} {}\n{}", plugin, options.face_normals, options.flip_tex_coords,
                  options.max_smooth_angle.value_or(-1), options.shape_index,
                  options.obj_part.value_or(-1), file);
  const auto [entry, is_new] = meshes_.try_emplace(key);
  if (is_new) try {
      entry->second = std::make_shared<TriangleMesh>(access_.read_mesh(plugin, file, options));
    } catch (const ReadError& error) {
      report_.error(where, "{}", error.what());
    }
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
  for (PluginKind kind :
       {PluginKind::texture, PluginKind::bsdf, PluginKind::shape, PluginKind::emitter,
        PluginKind::sensor, PluginKind::medium, PluginKind::phase, PluginKind::volume,
        PluginKind::film, PluginKind::sampler, PluginKind::rfilter})
    p.children(kind);
  for (const Property& property : scene.properties) {
    const Node* const* child = std::get_if<const Node*>(&property.value);
    if (!child || !(*child)->plugin) continue;
    const Node& node = **child;
    switch (node.kind) {
      case PluginKind::texture:
        if (MeantColor constant{ColorMeaning::unbounded, {}};
            std::holds_alternative<ReadInto<MeantColor>>(node.plugin->reader))
          read_into(node, constant);
        else
          texture(node);
        break;
      case PluginKind::bsdf:
        material(node);
        break;
      case PluginKind::medium:
        medium(node);
        break;
      case PluginKind::phase:
        phase(node);
        break;
      case PluginKind::shape:
        shape(node, description_.shapes, false);
        break;
      case PluginKind::emitter:
        // One that belongs to a surface may stand here to be referred to.
        if (std::holds_alternative<ReadInto<AreaEmission>>(node.plugin->reader))
          surface_lights_.try_emplace(&node, false);
        else if (LightDescription light{node.where, {node.id}, PointLight{}, {}, {}, 1, {}};
                 read_into(node, light))
          description_.lights.push_back(std::move(light));
        break;
      case PluginKind::sensor:
        if (SensorDescription sensor; read_into(node, sensor)) {
          if (sensor.kind == SensorKind::irradiancemeter)
            report_.error(node.where, "{} must stand in a shape", describe(node));
          description_.sensors.push_back(std::move(sensor));
        }
        break;
      case PluginKind::film:
        if (FilmDescription film; true) read_into(node, film);
        break;
      case PluginKind::sampler:
        if (SamplerDescription sampler; true) read_into(node, sampler);
        break;
      case PluginKind::rfilter:
        if (FilterDescription filter; true) read_into(node, filter);
        break;
      default:
        break;
    }
  }
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

std::optional<AreaEmission> SceneReader::emission(const Node& node) {
  if (const auto known = surface_lights_.find(&node); known != surface_lights_.end())
    known->second = true;
  AreaEmission emission;
  emission.where = node.where;
  return read_into(node, emission) ? std::optional(emission) : std::nullopt;
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
