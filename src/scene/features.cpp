#include "scene/features.h"

#include <fmt/format.h>

#include <set>

#include "scene/description.h"

namespace duet {

namespace {

/// The place of a point, in double precision.
Point3f place(const Matrix4& m, const Point3f& p) {
  Point3f out;
  for (int i = 0; i < 3; ++i)
    out[i] = float(m[i][0] * double(p.x) + m[i][1] * double(p.y) + m[i][2] * double(p.z) + m[i][3]);
  return out;
}

class Survey {
 public:
  explicit Survey(const SceneDescription& scene) : scene_(scene) {
    for (const ShapeGroupDescription& g : scene.groups) {
      group_ = &groups_.emplace_back();
      for (const ShapeDescription& s : g.shapes) add(s, group_->bounds);
    }
    group_ = nullptr;
    for (const ShapeDescription& s : scene.shapes) add(s, features_.bounds);
    for (const LightDescription& l : scene.lights)
      std::visit([&](const auto& light) { light.count(features_); }, l.model);
    for (const SensorDescription& s : scene.sensors) {
      features_.depth_of_field |= s.aperture_radius > 0;
      add(s.medium);
    }
    features_.textures = scene.textures.size();
  }
  SceneFeatures result() const { return features_; }

 private:
  struct Group {
    size_t triangles = 0;
    Bounds bounds;
  };

  void add(MaterialId id) {
    if (!materials_.insert(id).second) return;
    const MaterialModel& model = scene_.materials[size_t(id)].model;
    const Scattering s = model.scattering();
    features_.diffuse += s.diffuse;
    features_.rough_reflection += s.rough_reflection;
    features_.rough_refraction += s.rough_refraction;
    features_.mirrors += s.mirror;
    features_.smooth_glass += s.smooth_glass;
    features_.masks += s.see_through;
    features_.skips_masks |=
        !scene_.counts_passed_surfaces && (model.is<NullMaterial>() || model.is<MaskMaterial>());
    features_.bumps += s.bumps;
    for (const MaterialId nested : model.nested()) add(nested);
  }

  void add(std::optional<MediumId> id) {
    if (!id || !media_.insert(*id).second) return;
    const MediumDescription& m = scene_.media[size_t(*id)];
    ++features_.media;
    features_.heterogeneous_media += m.varies();
    features_.emissive_media += m.emission.has_value();
    if (const auto* grid = std::get_if<VolumeId>(&m.sigma_t)) {
      features_.coloured_media |= scene_.volumes[size_t(*grid)].grid->channels == 3;
    } else {
      const Spectrum& s = std::get<Spectrum>(m.sigma_t);
      features_.coloured_media |= s.r != s.g || s.g != s.b;
    }
  }

  void add_triangles(size_t count) {
    features_.triangles += count;
    if (group_)
      group_->triangles += count;
    else
      features_.placed_triangles += double(count);
  }

  void add(const ShapeDescription& s, Bounds& bounds) {
    if (const auto* instance = std::get_if<InstanceShape>(&s.geometry)) {
      const Group& g = groups_[instance->group];
      ++features_.instances;
      features_.placed_triangles += double(g.triangles);
      if (g.bounds.empty()) return;
      for (int corner = 0; corner < 8; ++corner) {
        Point3f p;
        for (int i = 0; i < 3; ++i)
          p[i] = corner & (1 << i) ? g.bounds.upper[i] : g.bounds.lower[i];
        bounds.extend(place(s.to_world, p));
      }
      return;
    }
    add(s.material);
    add(s.interior), add(s.exterior);
    if (s.emission && s.emission->directional) {
      ++features_.beams;
    } else if (s.emission) {
      ++features_.area_lights;
      features_.textured_area_lights += std::holds_alternative<TextureId>(s.emission->radiance);
    }
    if (const auto mesh = own_triangles(s))
      add_mesh(*mesh, s.to_world, bounds);
    else if (std::holds_alternative<HeightFieldShape>(s.geometry))
      add_height_field(s.to_world, bounds);
    else if (const auto* tubes = std::get_if<CurvesShape>(&s.geometry)) {
      add_curves(*tubes->curves, s.to_world, bounds);
      features_.one_way_surfaces += is_one_way(scene_, s);
    } else
      add_analytic(s, bounds);
  }

  void add_mesh(const TriangleMesh& mesh, const Matrix4& to_world, Bounds& bounds) {
    ++features_.meshes;
    add_triangles(mesh.triangles.size());
    for (const Point3f& p : mesh.positions) bounds.extend(place(to_world, p));
  }

  /// Its image is not read yet: what is known is where the square lies whose heights it holds.
  void add_height_field(const Matrix4& to_world, Bounds& bounds) {
    ++features_.meshes;
    for (const Point3f& p : make_rectangle().positions) bounds.extend(place(to_world, p));
  }

  void add_curves(CurveSet curves, const Matrix4& to_world, Bounds& bounds) {
    features_.curve_segments += curves.segments.size();
    transform_curves(curves, to_world);
    bounds.extend(curve_bounds(curves));
  }

  void add_analytic(const ShapeDescription& s, Bounds& bounds) {
    ++features_.analytic_shapes;
    const auto to_local = s.to_world.inverse();
    if (!to_local) return;  // the build stage refuses it
    Shape shape;
    shape.kind = std::holds_alternative<SphereShape>(s.geometry)    ? ShapeKind::sphere
                 : std::holds_alternative<DiskShape>(s.geometry)    ? ShapeKind::disk
                 : std::holds_alternative<SdfGridShape>(s.geometry) ? ShapeKind::sdf_grid
                                                                    : ShapeKind::cylinder;
    shape.to_world = Transform(s.to_world);
    shape.to_local = *to_local;
    bounds.extend(analytic_bounds(shape));
  }

  const SceneDescription& scene_;
  SceneFeatures features_;
  std::vector<Group> groups_;
  Group* group_ = nullptr;  ///< the one whose shapes are looked at
  std::set<MaterialId> materials_;
  std::set<MediumId> media_;
};

/// Joins "3 things" for all counts but zero.
class List {
 public:
  List& add(size_t count, const char* one, const char* many) {
    if (count > 0) append(fmt::format("{} {}", count, count == 1 ? one : many));
    return *this;
  }
  List& add(bool present, const char* what) {
    if (present) append(what);
    return *this;
  }
  std::string text(const char* otherwise) const { return text_.empty() ? otherwise : text_; }

 private:
  void append(const std::string& part) { text_ += (text_.empty() ? "" : ", ") + part; }
  std::string text_;
};

}  // namespace

bool is_one_way(const SceneDescription& scene, const ShapeDescription& s) {
  const auto* tubes = std::get_if<CurvesShape>(&s.geometry);
  if (!tubes) return false;
  return tubes->curves->profile != CurveProfile::tube ||
         (tubes->curves->outside_only && transmits(scene, s.material));
}

const MediumDescription* endless_medium(const SceneDescription& scene) {
  std::set<MediumId> enclosed;
  for_each_shape(scene, [&](const ShapeDescription& s) {
    if (s.interior) enclosed.insert(*s.interior);
  });
  for (const SensorDescription& s : scene.sensors) {
    if (!s.medium || enclosed.contains(*s.medium)) continue;
    const MediumDescription& m = scene.media[size_t(*s.medium)];
    const auto* sigma_t = std::get_if<Spectrum>(&m.sigma_t);
    const bool is_thick = sigma_t && std::min({sigma_t->r, sigma_t->g, sigma_t->b}) > 0;
    if (is_thick && m.scale > 0 && !m.cloud) return &m;
  }
  return nullptr;
}

SceneFeatures scene_features(const SceneDescription& scene) {
  const size_t moving = count_moving(scene);
  if (moving == 0) return Survey(scene).result();
  const double time = scene.sensors.empty() ? 0 : scene.sensors[0].shutter[0];
  SceneFeatures features = Survey(scene_at(scene, time)).result();
  features.moving = moving;
  return features;
}

std::string describe(const SceneFeatures& f) {
  std::string text = List()
                         .add(f.meshes, "mesh", "meshes")
                         .add(f.triangles, "triangle", "triangles")
                         .add(f.analytic_shapes, "analytic shape", "analytic shapes")
                         .add(f.curve_segments, "curve segment", "curve segments")
                         .add(f.instances, "instance", "instances")
                         .text("no shapes");
  if (f.instances > 0) text += fmt::format(" ({:.0f} triangles in all copies)", f.placed_triangles);
  text += "; " + List()
                     .add(f.area_lights, "area light", "area lights")
                     .add(f.textured_area_lights, "of them textured", "of them textured")
                     .add(f.point_lights, "point light", "point lights")
                     .add(f.spot_lights, "spot light", "spot lights")
                     .add(f.projectors, "projector", "projectors")
                     .add(f.directional_lights, "directional light", "directional lights")
                     .add(f.constant_environment, "constant environment")
                     .add(f.environment_map, "environment map")
                     .add(f.sky, "sky")
                     .add(f.beams, "beam of light", "beams of light")
                     .text("no lights");
  text += "; " + List()
                     .add(f.diffuse > 0, "diffuse reflection")
                     .add(f.rough_reflection > 0, "rough reflection")
                     .add(f.rough_refraction > 0, "rough refraction")
                     .add(f.mirrors > 0, "perfect mirrors")
                     .add(f.smooth_glass > 0, "smooth glass")
                     .add(f.masks > 0, "transparent surfaces")
                     .add(f.bumps > 0, "bump or normal maps")
                     .add(f.textures, "texture", "textures")
                     .text("no materials");
  if (f.media > 0)
    text += "; " + List()
                       .add(f.media, f.coloured_media ? "coloured medium" : "medium",
                            f.coloured_media ? "media, some coloured" : "media")
                       .add(f.heterogeneous_media, "of them a grid", "of them grids")
                       .add(f.emissive_media, "of them emissive", "of them emissive")
                       .text("");
  if (f.depth_of_field) text += "; depth of field";
  if (f.moving > 0) text += "; " + List().add(f.moving, "moving thing", "moving things").text("");
  return text;
}

}  // namespace duet
