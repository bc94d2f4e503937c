// Turns a pbrt scene into a scene description, directive by directive.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "pbrt/graphics_state.h"
#include "pbrt/parameter.h"
#include "pbrt/pbrt.h"
#include "scene/description.h"
#include "values/color.h"
#include "values/report.h"

namespace duet::pbrt {

/// What a mesh file is read for: `with_uv` has texture coordinates in any case, `displaced` those
/// of the file, and vertices that faces share.
enum class PlyUse { plain, with_uv, displaced };

/// A mesh file once it was read; the mesh is null after an error.
struct PlyMesh {
  std::shared_ptr<const TriangleMesh> mesh;
  bool own_normals = false;    ///< as in ShapeParts
  bool is_whole_file = false;  ///< another program makes the same of the file
};

/// A texture or material by name, and where it was asked for before it was defined.
using Undefined = std::map<std::string, SourceLocation, std::less<>>;

/// How a shape is given to Reader::add_shape().
struct ShapeParts {
  decltype(ShapeDescription::geometry) geometry;
  /// From the shape's own space, as the description means it, to pbrt's object space.
  Matrix4 to_object = {};
  /// Its vertex normals are the file's own: the handedness of the transform does not turn them.
  bool has_normals = false;
  /// Whether mirroring transforms turn the description's shape inside out by themselves.
  bool mirrors = false;
};

/// What the readers of the plugins share: the description that grows, the graphics state and what
/// has a name.
class Reader {
 public:
  Reader(const std::string& file, const Options& options, Version version, Report& report);

  /// Reads the main file. What is wrong is reported.
  void read();
  SceneDescription take() { return std::move(scene_); }

  SceneDescription& scene() { return scene_; }
  Report& report() { return report_; }
  const Options& options() const { return options_; }
  Version version() const { return version_; }
  GraphicsState& state() { return state_; }

  /// Records what is rendered differently from what the file says.
  void approximate(const SourceLocation& where, std::string what);
  /// The path of a file; "" after an error. Relative names are looked for beside the main file.
  std::string file(const std::string& name, const SourceLocation& where);

  // ---- Colours (colors.cpp) ----
  /// What makes the colours of an image those of the film; nothing if they are already. OpenEXR
  /// files may name their space, others are sRGB.
  std::optional<ColorMatrix> image_colors(const std::string& file, ColorMeaning meaning,
                                          const SourceLocation& where);
  Spectrum constant_color(const Parameter& p, ColorMeaning meaning);
  /// Light of a black body whose spectrum is 1 at its peak.
  Spectrum black_body(double kelvin);

  // ---- Named things (names.cpp) ----
  /// The names of the state (v3) or of the whole file (v4).
  const NameTables& names() const;
  NameTables& change_names();
  /// What the name stands for, or will stand for once it is defined.
  MaterialId named_material(const std::string& name, const SourceLocation& where);
  MediumId named_medium(const std::string& name, const SourceLocation& where);
  void define_material(const std::string& name, MaterialId made, const SourceLocation& where);
  /// A texture that is defined later (v4): ColorInput or FloatInput. Other textures can only use
  /// images so, which pbrt loads before it makes any of the others.
  template <class Input>
  const Input& await_texture(const std::string& name, const SourceLocation& where, bool by_texture);
  template <class Input>
  void define_texture(const std::string& name, const Input& made, bool is_image,
                      const SourceLocation& where);
  void define_medium(const std::string& name, MediumDescription medium);
  /// Reports what was asked for and never defined.
  void check_names();

  // ---- Materials and textures ----
  MaterialId add_material(MaterialModel model, const SourceLocation& where);
  TextureId add_texture(decltype(TextureDescription::model) model, const SourceLocation& where);
  /// Called for each texture that a plugin refers to.
  void count_texture() { ++texture_count_; }
  /// Whether colours are used that a texture further on defines.
  bool awaits_colors() const { return !undefined_colors_.empty(); }
  /// How many there were; what differs before and after reading a material says if it has any.
  size_t texture_count() const { return texture_count_; }
  /// Whether the surface described now looks at texture coordinates.
  bool needs_uv(const Plugin& shape) const;
  void set_material(MaterialId id);
  void set_looks_at_uv(MaterialId id, bool looks);
  /// The material bounds a medium of its own.
  void set_interior(MaterialId id, MediumDescription medium);
  /// Whether some material does.
  bool has_interiors() const { return !interiors_.empty(); }
  /// Whether some material bounds it.
  bool is_interior(MediumId medium) const;
  /// `to` bounds what `from` does.
  void share_interior(MaterialId from, MaterialId to);

  // ---- Shapes (reader_shapes.cpp) ----
  /// Adds a shape with what the state says of it: transform, orientation, material, light, media.
  void add_shape(const Plugin& from, ShapeParts parts);
  /// Null after an error.
  const PlyMesh* ply_mesh(const std::string& path, PlyUse use, const SourceLocation& where);
  void begin_object(const std::string& name, const SourceLocation& where);
  void end_object(const SourceLocation& where);
  void add_instance(const std::string& name, const SourceLocation& where);
  bool in_object() const { return object_.has_value(); }

  /// The way of what has the state's transform; none if it stands still.
  Motion motion(const Plugin& what);
  /// Whether the matrix can be inverted; an error if not.
  bool check_transform(const Matrix4& m, const SourceLocation& where);

  std::array<double, 2> transform_times{0, 1};

  // ---- What the directives before WorldBegin leave for its end ----
  std::optional<Plugin> camera, film, filter, sampler, integrator;
  GraphicsState camera_state;  ///< as it was at Camera
  /// The film's, and so that in which all colours of the description are.
  uint8_t film_color_space = 0;
  /// Multiplies the edges of displaced meshes.
  double displacement_edge_scale = 1;

 private:
  Spectrum triple_color(const Parameter& p, ColorMeaning meaning);
  std::string spectrum_file(const std::string& name, const SourceLocation& where);
  bool is_awaited(MaterialId material) const;
  void finish_shapes();
  /// Whether there is such an object by now; an error if not.
  bool knows_object(const std::string& name, const SourceLocation& where);
  void add_awaited_instances();
  /// Hair knows by the direction of its normal how far from the middle light meets it, and a tube
  /// has the normals that pbrt's model takes for granted on its ribbons.
  void make_hair_round();
  /// The "alpha" of a shape, unless it is opaque.
  std::optional<FloatInput> alpha_of(const Plugin& shape);
  MaterialId with_alpha(const Plugin& shape, MaterialId material);
  /// What else the light of a shape depends on: the side by its normals, the areas of its triangles
  /// if it has "power", its alpha.
  void finish_emission(const Plugin& from, ShapeDescription& shape, bool has_normals);
  /// The area that pbrt's "power" is spread over: that of the first triangle of a mesh in the
  /// world, of others that of all in their own space.
  double area_of_light(const Plugin& from, const ShapeDescription& shape, const ShapeParts& parts);

  std::string file_;
  const Options& options_;
  Version version_;
  Report& report_;
  SceneDescription scene_;
  GraphicsState state_;
  NameTables global_names_;
  std::map<std::string, MediumId, std::less<>> media_;
  Undefined undefined_materials_, undefined_media_, undefined_colors_, undefined_numbers_;
  /// Undefined textures that a texture uses.
  Undefined awaited_images_;
  /// A shape whose material is defined later.
  struct Waiting {
    MaterialId material;
    std::optional<uint32_t> group;
    size_t index;  ///< among the group's shapes or those of the scene
    std::optional<MediumId> outside;
  };
  std::vector<Waiting> waiting_;
  size_t texture_count_ = 0;
  /// Per material: whether it has textures or is anisotropic.
  std::vector<bool> looks_at_uv_;
  std::map<MaterialId, MediumId> interiors_;
  std::map<std::pair<std::string, PlyUse>, PlyMesh> ply_meshes_;
  std::unordered_map<std::string, uint32_t> objects_;
  /// A use of an object that is defined later (v4).
  struct AwaitedObject {
    std::string name;
    SourceLocation where;
    std::array<Matrix4, 2> ctm;
  };
  std::vector<AwaitedObject> awaited_objects_;
  /// The group that ObjectBegin has begun.
  std::optional<uint32_t> object_;
  /// A shape of an object that moves in it: the only one of a group of its own.
  struct MovingPart {
    uint32_t group;
    Motion motion;
  };
  std::map<uint32_t, std::vector<MovingPart>> moving_parts_;  ///< by the object's group
  /// Materials with alpha on shapes, by what they are made of.
  std::map<std::pair<MaterialId, FloatInput>, MaterialId> masked_;
};

// The families of plugins, a file each.
void read_shape(Reader& reader, Plugin plugin);
/// `area` is that of the surface in the world.
Boxed<AreaEmission> read_area_light(Reader& reader, const Plugin& plugin,
                                    const std::function<double()>& area);
void read_light(Reader& reader, const Plugin& plugin);
std::optional<MaterialId> read_material(Reader& reader, const Plugin& plugin);
/// `plugin` has the texture's class as its name; `name` and `kind` ("float" …) precede that.
void read_texture(Reader& reader, const Plugin& plugin, const std::string& name,
                  const std::string& kind);
void read_medium(Reader& reader, const Plugin& plugin);
/// The sensor and the integrator, from what was said before WorldBegin.
void finish_camera(Reader& reader);
void finish_integrator(Reader& reader);
/// Reports what there is not; accelerators make no difference here.
void check_accelerator(Reader& reader, const Plugin& plugin);

}  // namespace duet::pbrt
