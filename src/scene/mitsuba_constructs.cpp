#include "scene/mitsuba_constructs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace duet {

namespace {

// ---- What a scene uses ----

/// Those of the shapes, with their parts.
std::set<MaterialId> used_materials(const SceneDescription& scene) {
  std::set<MaterialId> used;
  std::vector<MaterialId> open;
  for_each_shape(scene, [&](const ShapeDescription& s) {
    if (!std::holds_alternative<InstanceShape>(s.geometry)) open.push_back(s.material);
  });
  while (!open.empty()) {
    const MaterialId id = open.back();
    open.pop_back();
    if (!used.insert(id).second) continue;
    for (const MaterialId part : scene.materials[size_t(id)].model.nested()) open.push_back(part);
  }
  return used;
}

std::set<MediumId> used_media(const SceneDescription& scene) {
  std::set<MediumId> used;
  const auto use = [&](std::optional<MediumId> id) {
    if (id) used.insert(*id);
  };
  for_each_shape(scene, [&](const ShapeDescription& s) { use(s.interior), use(s.exterior); });
  for (const SensorDescription& s : scene.sensors) use(s.medium);
  return used;
}

// ---- Blends with a delta lobe ----

/// Which kinds of lobes reflect light.
struct Lobes {
  bool delta = false, other = false;
};

class LobesOf {
 public:
  explicit LobesOf(const SceneDescription& scene) : scene_(scene) {}

  Lobes operator()(MaterialId id) {
    if (const auto known = known_.find(id); known != known_.end()) return known->second;
    const MaterialModel& model = scene_.materials[size_t(id)].model;
    const Scattering own = model.scattering();
    Lobes l{own.has_delta_lobe(), own.has_smooth_lobe()};
    for (const MaterialId part : model.nested()) {
      const Lobes p = (*this)(part);
      l.delta |= p.delta;
      l.other |= p.other;
    }
    return known_[id] = l;
  }

 private:
  const SceneDescription& scene_;
  std::map<MaterialId, Lobes> known_;
};

}  // namespace

bool blends_delta(const SceneDescription& scene, const SceneFeatures&) {
  LobesOf lobes(scene);
  const auto ids = used_materials(scene);
  return std::any_of(ids.begin(), ids.end(), [&](MaterialId id) {
    const auto* blend = scene.materials[size_t(id)].model.get_if<BlendMaterial>();
    if (!blend || blend->weight == FloatInput(0.0) || blend->weight == FloatInput(1.0))
      return false;
    const Lobes a = lobes(blend->first), b = lobes(blend->second);
    return (a.delta && b.other) || (b.delta && a.other);
  });
}

// ---- Bumps ----

namespace {

bool is_anisotropic(const Roughness& r) {
  return !(r.alpha_u == r.alpha_v);
}

/// Whether the BSDF, or one within it, depends on the tangent.
bool has_tangent(const SceneDescription& scene, MaterialId id) {
  const MaterialModel& model = scene.materials[size_t(id)].model;
  if (model.scattering().bumps) return true;
  if (const auto* m = model.get_if<ConductorMaterial>())
    return m->roughness && is_anisotropic(*m->roughness);
  if (const auto* m = model.get_if<DielectricMaterial>())
    return m->roughness && is_anisotropic(*m->roughness);
  if (const auto* m = model.get_if<PrincipledMaterial>()) return m->anisotropic != FloatInput(0.0);
  if (const auto* m = model.get_if<PrincipledThinMaterial>())
    return m->anisotropic != FloatInput(0.0);
  const auto& parts = model.nested();
  return std::any_of(parts.begin(), parts.end(),
                     [&](MaterialId part) { return has_tangent(scene, part); });
}

}  // namespace

bool bumps_tangents(const SceneDescription& scene, const SceneFeatures&) {
  const auto ids = used_materials(scene);
  return std::any_of(ids.begin(), ids.end(), [&](MaterialId id) {
    const auto* bumps = scene.materials[size_t(id)].model.get_if<BumpMapMaterial>();
    return bumps && has_tangent(scene, bumps->nested);
  });
}

// ---- Null lobes ----

bool drops_null_paths(const SceneDescription& scene, const SceneFeatures& f) {
  const auto* path = std::get_if<PathIntegratorDescription>(&scene.integrator.method);
  if (!path) return false;
  if ((f.constant_environment || f.environment_map || f.sky) && !path->hide_emitters) return false;
  const auto ids = used_materials(scene);
  return std::any_of(ids.begin(), ids.end(), [&](MaterialId id) {
    const MaterialModel& model = scene.materials[size_t(id)].model;
    return model.is<MaskMaterial>() || model.is<NullMaterial>() ||
           model.is<ThinDielectricMaterial>();
  });
}

// ---- Lights ----

bool emits_from_smooth_meshes(const SceneDescription& scene, const SceneFeatures&) {
  return std::any_of(scene.shapes.begin(), scene.shapes.end(), [](const ShapeDescription& s) {
    const auto* m = std::get_if<MeshShape>(&s.geometry);
    return s.emission && m && m->mesh && !m->mesh->normals.empty() && !has_flat_normals(*m->mesh);
  });
}

bool emits_from_elliptic_cylinders(const SceneDescription& scene, const SceneFeatures&) {
  return std::any_of(scene.shapes.begin(), scene.shapes.end(), [](const ShapeDescription& s) {
    if (!s.emission || !std::holds_alternative<CylinderShape>(s.geometry)) return false;
    const Transform to_world(s.to_world);
    const Vector3f x = to_world(Vector3f(1, 0, 0)), y = to_world(Vector3f(0, 1, 0));
    return std::abs(dot(x, y)) + std::abs(dot(x, x) - dot(y, y)) > 1e-4f * dot(x, x);
  });
}

bool emits_attributes(const SceneDescription& scene, const SceneFeatures&) {
  return std::any_of(scene.shapes.begin(), scene.shapes.end(), [&](const ShapeDescription& s) {
    const auto* id = s.emission ? std::get_if<TextureId>(&s.emission->radiance) : nullptr;
    return id && std::holds_alternative<MeshAttributeTexture>(scene.textures[size_t(*id)].model);
  });
}

bool emits_texture_repeatedly(const SceneDescription& scene, const SceneFeatures&) {
  return std::any_of(scene.shapes.begin(), scene.shapes.end(), [](const ShapeDescription& s) {
    if (!s.emission || !std::holds_alternative<TextureId>(s.emission->radiance)) return false;
    const auto mesh = own_triangles(s);
    if (!mesh || mesh->uvs.empty()) return false;
    // Triangles that share nothing of the unit square fit into it.
    double area = 0;
    for (const auto& t : mesh->triangles) {
      const Point2f a = mesh->uvs[t[0]], b = mesh->uvs[t[1]], c = mesh->uvs[t[2]];
      area += 0.5 * std::abs(double(b.x - a.x) * double(c.y - a.y) -
                             double(c.x - a.x) * double(b.y - a.y));
    }
    return area > 1.001;
  });
}

bool repeats_delta_lights(const SceneDescription& scene, const SceneFeatures& f) {
  const auto* direct = std::get_if<DirectIntegratorDescription>(&scene.integrator.method);
  return direct && direct->emitter_samples > 1 &&
         f.point_lights + f.spot_lights + f.projectors + f.directional_lights > 0;
}

bool has_light_behind_fog(const SceneDescription& scene, const SceneFeatures& f) {
  return f.far_lights() > 0 && endless_medium(scene);
}

// ---- Offsets of rays ----

namespace {

/// By how far Mitsuba 3 moves the origin of a ray off a surface: 1500 · 2⁻²⁴ of 1 and the largest
/// coordinate.
double ray_offset(const SceneFeatures& f) {
  if (f.bounds.empty()) return 0;
  double largest = 0;
  for (int i = 0; i < 3; ++i)
    largest = std::max(
        {largest, double(std::abs(f.bounds.lower[i])), double(std::abs(f.bounds.upper[i]))});
  return 1500 * 0x1p-24 * (1 + largest);
}

double largest_extinction(const SceneDescription& scene, const MediumDescription& m) {
  if (const auto* colour = std::get_if<Spectrum>(&m.sigma_t))
    return double(colour->max()) * m.scale;
  const auto& grid = scene.volumes[size_t(std::get<VolumeId>(m.sigma_t))].grid;
  if (!grid || grid->values.empty()) return 0;
  return double(*std::max_element(grid->values.begin(), grid->values.end())) * m.scale;
}

}  // namespace

bool has_short_free_path(const SceneDescription& scene, const SceneFeatures& f) {
  const double offset = ray_offset(f);
  const auto ids = used_media(scene);
  return std::any_of(ids.begin(), ids.end(), [&](MediumId id) {
    return offset * largest_extinction(scene, scene.media[size_t(id)]) > 0.02;
  });
}

bool is_small(const SceneDescription&, const SceneFeatures& f) {
  return !f.bounds.empty() && ray_offset(f) > 0.01 * double(f.bounds.radius());
}

// ---- Phase functions ----

namespace {

/// Whether flakes with this matrix (xx, yy, zz, xy, xz, yz) are no balls.
template <class T>
bool is_uneven(const T* s) {
  return s[0] != s[1] || s[1] != s[2] || s[3] != 0 || s[4] != 0 || s[5] != 0;
}

bool is_uneven(const SceneDescription& scene, const SggxPhase& phase) {
  if (const auto* matrix = std::get_if<std::array<double, 6>>(&phase.matrix))
    return is_uneven(matrix->data());
  const auto& grid = scene.volumes[size_t(std::get<VolumeId>(phase.matrix))].grid;
  if (!grid || grid->channels != 6) return false;
  for (size_t i = 0; i < grid->node_count(); ++i)
    if (is_uneven(&grid->values[6 * i])) return true;
  return false;
}

}  // namespace

bool has_uneven_flakes(const SceneDescription& scene, const SceneFeatures&) {
  std::vector<PhaseId> open;
  for (const MediumId id : used_media(scene)) open.push_back(scene.media[size_t(id)].phase);
  std::set<PhaseId> seen;
  while (!open.empty()) {
    const PhaseId id = open.back();
    open.pop_back();
    if (!seen.insert(id).second) continue;
    const auto& model = scene.phases[size_t(id)].model;
    if (const auto* blend = std::get_if<BlendPhase>(&model))
      open.insert(open.end(), {blend->first, blend->second});
    if (const auto* flakes = std::get_if<SggxPhase>(&model); flakes && is_uneven(scene, *flakes))
      return true;
  }
  return false;
}

// ---- Motion ----

namespace {

/// Whether the stretch of the pose is along other axes than those of the object: its columns are
/// not at right angles then.
bool is_sheared(const Matrix4& m) {
  const auto dot = [&](size_t a, size_t b) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += m[i][a] * m[i][b];
    return sum;
  };
  for (size_t a = 0; a < 3; ++a)
    for (size_t b = 0; b < a; ++b)
      if (std::abs(dot(a, b)) > 1e-5 * std::sqrt(dot(a, a) * dot(b, b))) return true;
  return false;
}

}  // namespace

bool moves_sheared(const SceneDescription& scene, const SceneFeatures&) {
  const auto sheared = [](const auto& thing) {
    const auto& frames = thing.motion.keyframes();
    return std::any_of(frames.begin(), frames.end(),
                       [](const Keyframe& k) { return is_sheared(k.pose); });
  };
  bool any = std::any_of(scene.lights.begin(), scene.lights.end(), sheared) ||
             std::any_of(scene.sensors.begin(), scene.sensors.end(), sheared);
  for_each_shape(scene, [&](const ShapeDescription& s) { any |= sheared(s); });
  return any;
}

}  // namespace duet
