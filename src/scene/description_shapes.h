// Shapes as plain data.
#pragma once

#include <concepts>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/boxed.h"
#include "geometry/curves.h"
#include "geometry/mesh.h"
#include "geometry/sdf_grid.h"
#include "image/filter.h"
#include "lights/emitting_side.h"
#include "math/motion.h"
#include "math/transform.h"
#include "scene/description_base.h"
#include "scene/emission_parameters.h"
#include "scene/model.h"

namespace duet {

/// Where a mesh came from, so that a description can be written out again; it does not count in
/// comparisons.
struct MeshSource {
  std::string file;     ///< resolved path, or "" for a mesh made by the program
  std::string plugin;   ///< obj, ply, serialized
  int shape_index = 0;  ///< of a serialized file
  bool face_normals = false;
  bool flip_tex_coords = true;
  std::optional<double> max_smooth_angle;
  /// The PLY file that pbrt reads as this mesh, or "".
  std::string pbrt_file;
  /// Not the whole OBJ file: one of its parts, or those of one material.
  bool is_part = false;
  friend bool operator==(const MeshSource&, const MeshSource&) { return true; }
};

/// The mesh in its own space. Shapes may share one.
struct MeshShape {
  std::shared_ptr<const TriangleMesh> mesh;
  Boxed<MeshSource> source;  ///< never empty
  /// How far the surface moves along its normals, in its own space, after edges are split until all
  /// are shorter than `edge_length` in the world. The normals are those of the moved triangles.
  FloatInput displacement = 0.0;
  double edge_length = 1;

  MeshShape() : MeshShape(nullptr) {}
  explicit MeshShape(std::shared_ptr<const TriangleMesh> triangles, MeshSource from = {})
      : mesh(std::move(triangles)), source(std::move(from)) {}
  static constexpr auto fields() {
    return plain_fields(&MeshShape::mesh, &MeshShape::source, &MeshShape::displacement,
                        &MeshShape::edge_length);
  }
  const std::string& name() const { return source->plugin; }
  const std::shared_ptr<const TriangleMesh>& triangles() const { return mesh; }
};
// A shape that is made of triangles has them in its own space: triangles().
struct RectangleShape {
  static constexpr auto fields() { return FieldList(); }
  static constexpr const char* name() { return "rectangle"; }
  static std::shared_ptr<const TriangleMesh> triangles() {
    return std::make_shared<TriangleMesh>(make_rectangle());
  }
};
struct CubeShape {
  static constexpr auto fields() { return FieldList(); }
  static constexpr const char* name() { return "cube"; }
  static std::shared_ptr<const TriangleMesh> triangles() {
    return std::make_shared<TriangleMesh>(make_cube());
  }
};
/// Unit shapes; a centre, radius or end points are part of `to_world`.
struct SphereShape {
  static constexpr auto fields() { return FieldList(); }
  static constexpr const char* name() { return "sphere"; }
};
struct DiskShape {
  static constexpr auto fields() { return FieldList(); }
  static constexpr const char* name() { return "disk"; }
};
struct CylinderShape {
  static constexpr auto fields() { return FieldList(); }
  static constexpr const char* name() { return "cylinder"; }
};
/// A surface of zero distance.
struct SdfGridShape {
  std::shared_ptr<const SdfGrid> grid;
  std::string file;
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    return FieldList(field(&SdfGridShape::grid),
                     field(&SdfGridShape::file, Parameter{"filename", string, "",
                                                          "a volume with one channel: distances"})
                         .not_compared()
                         .shown(" "));
  }
  static constexpr const char* name() { return "sdfgrid"; }
};
/// Tubes, in the shape's own space; `to_world` moves their points but leaves the radii.
struct CurvesShape {
  std::shared_ptr<const CurveSet> curves;
  std::string file;
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    return FieldList(
        field(&CurvesShape::curves),
        field(&CurvesShape::file,
              Parameter{.name = "filename",
                        .type = ParameterType::file,
                        .note = "a point and a radius per line, an empty line between curves",
                        .required = true})
            .not_compared());
  }
  const char* name() const {
    return curves && curves->kind == CurveKind::bspline ? "bsplinecurve" : "linearcurve";
  }
  std::vector<std::string> losses() const {
    if (curves && curves->profile != CurveProfile::tube)
      return {"curves that are ribbons facing each ray are tubes"};
    if (!curves || curves->outside_only) return {};
    return {"the hair of Mitsuba 0.6 has to be written as a file of curves with their radius"};
  }
};
/// Bilinear patches over the square from (−1, −1) to (1, 1), facing +z, between heights that are
/// the luminance of a texture's texels times `scale`; its first row lies along y = −1.
struct HeightFieldShape {
  TextureId heights{};
  double scale = 1;
  int width = 32, height = 32;  ///< of a texture that is no image
  bool shading_normals = true;  ///< smooth from patch to patch
  /// Makes a number of heights that is one more than a power of two along either side.
  Boxed<FilterDescription> filter = FilterDescription{.kind = FilterKind::lanczos, .lobes = 2};
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using H = HeightFieldShape;
    return FieldList(
        field(&H::heights).read_by_plugin(),
        field(&H::scale, Parameter{"scale", number, kInitial, "multiplies the heights"}),
        field(&H::width, Parameter{"width", integer, kInitial,
                                   "columns of a texture that is no image, with height", size})
            .read_by_plugin(),
        field(&H::height, Parameter{"height", integer, kInitial,
                                    "rows of a texture that is no image, with width", size})
            .read_by_plugin(),
        field(&H::shading_normals, Parameter{"shading_normals", boolean, kInitial,
                                             "smooth, not those of each bilinear patch"}),
        field(&H::filter));
  }
  static constexpr const char* name() { return "heightfield"; }
  static constexpr bool kOnlyIn0x = true;
};
/// A copy of SceneDescription::groups[group].
struct InstanceShape {
  uint32_t group = 0;
  static constexpr auto fields() { return plain_fields(&InstanceShape::group); }
  static constexpr const char* name() { return "instance"; }
};

/// What the struct of a shape must have besides its fields and its name.
template <class T>
concept ShapeData = PluginData<T> && requires(const T& shape) {
  { shape.triangles() } -> std::convertible_to<std::shared_ptr<const TriangleMesh>>;
};
struct ShapeOperations {
  std::shared_ptr<const TriangleMesh> (*triangles)(const void*);
  template <ShapeData T>
  static constexpr ShapeOperations of() {
    return {[](const void* t) -> std::shared_ptr<const TriangleMesh> {
      return static_cast<const T*>(t)->triangles();
    }};
  }
};
/// A shape of any other plugin: whoever has a struct with a record, and triangles, has a shape.
class ForeignShape : public Model<ShapeOperations> {
 public:
  using Model::Model;
  std::shared_ptr<const TriangleMesh> triangles() const { return operations().triangles(data()); }
};

/// Radiance of a surface that emits.
struct AreaEmission {
  SourceLocation where;
  ColorInput radiance = Spectrum(1.0f);
  double sampling_weight = 1;  ///< as in LightDescription
  /// Light leaves along the normals only; `radiance` is power per unit area.
  bool directional = false;
  EmittingSide side = EmittingSide::shading;
  static constexpr auto fields() {
    using namespace parameter_words;
    using A = AreaEmission;
    return FieldList(field(&A::where), field(&A::radiance, kRadiance),
                     field(&A::sampling_weight, kSamplingWeight).terse(), field(&A::directional),
                     field(&A::side).words(kEmittingSides));
  }
  const char* name() const { return directional ? "directionalarea" : "area"; }
  std::vector<std::string> losses() const {
    if (side == EmittingSide::both) return {"light leaves a surface on one side only"};
    if (side == EmittingSide::shading) return {};
    return {"light leaves a mesh with normals on the side of its shading normals"};
  }
};

struct ShapeDescription {
  SourceLocation where;
  Label label;
  std::variant<MeshShape, RectangleShape, CubeShape, SphereShape, DiskShape, CylinderShape,
               InstanceShape, SdfGridShape, CurvesShape, HeightFieldShape, ForeignShape>
      geometry;
  Matrix4 to_world;
  Motion motion;  ///< of what `to_world` has placed
  bool flip_normals = false;
  MaterialId material{};  ///< not used by instances
  Boxed<AreaEmission> emission;
  /// What fills the space behind and before the surface. A surface with neither of them changes
  /// nothing; one with either stands between the two, and the one that is absent is empty space.
  std::optional<MediumId> interior, exterior;
  static constexpr auto fields() {
    return plain_fields(&ShapeDescription::where, &ShapeDescription::label,
                        &ShapeDescription::geometry, &ShapeDescription::to_world,
                        &ShapeDescription::motion, &ShapeDescription::flip_normals,
                        &ShapeDescription::material, &ShapeDescription::emission,
                        &ShapeDescription::interior, &ShapeDescription::exterior);
  }
};

/// The triangles of a shape that is made of them, in its own space; null for any other.
inline std::shared_ptr<const TriangleMesh> own_triangles(const ShapeDescription& shape) {
  return std::visit(
      [](const auto& g) -> std::shared_ptr<const TriangleMesh> {
        if constexpr (requires { g.triangles(); })
          return g.triangles();
        else
          return nullptr;
      },
      shape.geometry);
}

struct ShapeGroupDescription {
  SourceLocation where;
  Label label;
  std::vector<ShapeDescription> shapes;
  static constexpr auto fields() {
    return plain_fields(&ShapeGroupDescription::where, &ShapeGroupDescription::label,
                        &ShapeGroupDescription::shapes);
  }
};

}  // namespace duet
