// The parts of writing a pbrt file; use writer.h.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pbrt/grid_cells.h"
#include "pbrt/statement.h"
#include "scene/description.h"
#include "values/writing.h"

namespace duet::pbrt {

/// Collects the text, part by part, and what is lost.
class SceneWriter {
 public:
  SceneWriter(const SceneDescription& description, const std::array<double, 2>& times)
      : d_(description), times_(times) {}
  void write();
  /// What comes before WorldBegin and what follows it.
  std::string text() const;
  const std::vector<std::string>& losses() const { return losses_.list(); }

 private:
  void lose(std::string what) { losses_.add(std::move(what)); }
  std::string unique_name(const std::string& wanted, std::string_view otherwise, size_t index) {
    return names_.take(wanted, fmt::format("{}{}", otherwise, index));
  }

  // write_film.cpp
  void film(const SensorDescription& s, double exposure_time);
  /// What the film makes of colours, and what it cuts off samples.
  void response(Statement& film, const FilmDescription& f, double exposure_time);
  void filter(const FilterDescription& f);
  void sampler(const SamplerDescription& s);

  // write_camera.cpp
  void camera(const SensorDescription& s);
  void pose(const SensorDescription& s, const Matrix4& to_description);
  void integrator();
  /// Radius and focus, where distances in the camera's space are `scale` times as long.
  void lens(Statement& c, const SensorDescription& s, double scale);

  // write_textures.cpp
  /// Gives the parameter its value. Reflectances are at most 1.
  void put(Statement& s, std::string_view name, const ColorInput& value, bool is_reflectance);
  void put(Statement& s, std::string_view name, const FloatInput& value);
  /// The name of the texture, which is written if it was not. Colours and numbers have names of
  /// their own in pbrt.
  std::string texture(TextureId id, bool is_color);
  /// What is being written: the name and kind of a texture, and how its coordinates are found.
  struct Target {
    std::string name;
    bool is_color = false;
    const MappedTextureDescription* map = nullptr;
    Statement begin(std::string_view plugin) const {
      return Statement::texture(name, is_color, plugin);
    }
  };
  void texture(const TextureDescription& t, const Target& target);
  void add_texture(const Statement& s, const std::optional<Matrix4>& to_world);

  struct Scaling {
    double u_scale = 1, u_delta = 0, v_scale = 1, v_delta = 0;
  };
  Scaling scaling(const UvTransform& to_uv);
  /// Writes how coordinates are found; what must be the transform then.
  std::optional<Matrix4> mapping(Statement& s, const Scaling& m,
                                 const MappedTextureDescription* map);
  /// A texture's own parameter: a colour, or the number that stands for it.
  void input(Statement& s, std::string_view name, const ColorInput& value, const Target& target);
  /// Whether the three channels of the texture are the same by what it is.
  bool is_grey(const ColorInput& input) const;

  void write(const BitmapTexture& t, const Target& target);
  void image(Statement& s, const BitmapTexture& b, bool is_color);
  void write(const MappedTextureDescription& t, const Target& target);
  void write(const ScaledTextureDescription& t, const Target& target);
  void write(const ProductDescription& t, const Target& target);
  void write(const MixDescription& t, const Target& target);
  void write(const DirectionMixDescription& t, const Target& target);
  void write(const FunctionDescription& t, const Target& target);
  /// The image of which the function is one minus it, or no more than one, as images of pbrt have
  /// it: whether it is one.
  bool write_image(const FunctionDescription& t, const Target& target);

  // write_patterns.cpp
  void write(const CheckerboardTexture& t, const Target& target);
  void write(const DotsDescription& t, const Target& target);
  void write(const BilerpDescription& t, const Target& target);
  void write(const NoiseTextureDescription& t, const Target& target);
  void write(const SolidCheckerboardDescription& t, const Target& target);
  /// A mixture by a pattern that has a mapping of its own, which is one texture in pbrt: whether it
  /// is one.
  bool write_mapped_pattern(const MixDescription& t, const Target& target);

  // write_material_tree.cpp
  /// What surrounds a BSDF in the description and belongs to it in pbrt.
  struct Around {
    bool two_sided = false;
    const BumpMapMaterial* bumps = nullptr;
    const NormalMapMaterial* normals = nullptr;
  };
  /// A material that has a name, and what of it belongs to the shape.
  struct Surface {
    std::string material;
    FloatInput alpha = 1.0;
  };
  Surface surface(const ShapeDescription& s);
  std::string material(MaterialId id, bool two_sided = false);
  void write_material(MaterialId id, const std::string& name, Around around);
  void mixture(const MixtureMaterial& m, const std::string& name, const Around& around);
  void write(const BlendMaterial& m, const std::string& name, const Around& around);
  /// A blend of diffuse reflection and diffuse transmission, which is one material in pbrt.
  bool write_both_ways(const BlendMaterial& m, const std::string& name, const Around& around);
  /// Whether it is one of the materials that the rest of the code knows; it is written then.
  template <class... T>
  bool write_known(MaterialId id, const std::string& name, const Around& around);
  /// A diffuse BSDF in the place of one that pbrt does not have.
  void write_unknown(const MaterialModel& m, const std::string& name, Around around);

  // write_materials.cpp
  static Statement named_material(const std::string& name, std::string_view plugin) {
    return Statement::named("MakeNamedMaterial", "Material", name, plugin);
  }
  /// Adds what surrounds it, and ends it.
  void end_material(Statement& s, const Around& around);
  void normal_map(Statement& s, const NormalMapMaterial& n);
  void roughness(Statement& s, const std::optional<Roughness>& r);
  /// Names of parameters and the α of each: one flag says for all of them whether they are squared.
  using Alphas = std::vector<std::pair<std::string_view, FloatInput>>;
  void roughness(Statement& s, const Alphas& alphas);
  void microfacets(MicrofacetDistribution distribution);
  void one_sided(const Around& around);
  void lost_factor(const ColorInput& factor, std::string_view what);
  template <class Material>
  void lost_dielectric_factors(const Material& m);
  void write(const DiffuseMaterial& m, const std::string& name, const Around& around);
  void write(const DiffuseTransmitterMaterial& m, const std::string& name, const Around& around);
  void write(const ConductorMaterial& m, const std::string& name, const Around& around);
  void write(const DielectricMaterial& m, const std::string& name, const Around& around);
  void write(const ThinDielectricMaterial& m, const std::string& name, const Around& around);
  void write(const HairMaterial& m, const std::string& name, const Around& around);
  void write(const MeasuredMaterial& m, const std::string& name, const Around& around);

  // write_coats.cpp
  void coat(Statement& s, const CoatLayer& c, std::string_view prefix);
  void write(const CoatedDiffuseMaterial& m, const std::string& name, const Around& around);
  void write(const CoatedConductorMaterial& m, const std::string& name, const Around& around);
  void write(const PlasticMaterial& m, const std::string& name, const Around& around);
  void write(const UberMaterial& m, const std::string& name, const Around& around);
  void write(const SubstrateMaterial& m, const std::string& name, const Around& around);

  // write_media.cpp
  static Statement named_medium(const std::string& name, std::string_view plugin) {
    return Statement::named("MakeNamedMedium", "MakeNamedMedium", name, plugin);
  }
  void medium(size_t index);
  void cloud_medium(const MediumDescription& m, const std::string& name, double g);
  /// Names of the media on both sides.
  std::string media(const std::optional<MediumId>& inside, const std::optional<MediumId>& outside);

  // write_grids.cpp
  void grid_medium(const MediumDescription& m, const std::string& name, double g);
  /// Absorption and scattering of each cell, by colour.
  void coefficients(Statement& s, const MediumDescription& m, const GridCells& cells);

  // write_grid_emission.cpp
  void grid_emission(Statement& s, const EmissionDescription& e, const GridCells& cells,
                     bool is_uniform);
  /// Le of an "rgbgrid", and Le and Lescale of a "uniformgrid"; false if that is not possible.
  bool rgb_emission(Statement& s, const EmissionDescription& e, const GridCells& cells);
  bool uniform_emission(Statement& s, const EmissionDescription& e, const GridCells& cells);

  // write_lights.cpp
  void light(const LightDescription& l);
  /// The light of a model; to_world becomes that of pbrt's light. Nothing if pbrt has none.
  using MaybeLight = std::optional<Statement>;
  MaybeLight light(const PointLight& m, const LightDescription& l, Matrix4& to_world);
  MaybeLight light(const SpotLight& m, const LightDescription& l, Matrix4& to_world);
  MaybeLight light(const DirectionalLight& m, const LightDescription& l, Matrix4& to_world);
  MaybeLight light(const ConstantLight& m, const LightDescription& l, Matrix4& to_world);
  MaybeLight light(const EnvironmentMapLight& m, const LightDescription& l, Matrix4& to_world);
  MaybeLight light(const GoniometricLight& m, const LightDescription& l, Matrix4& to_world);
  MaybeLight light(const ProjectorLight& m, const LightDescription& l, Matrix4& to_world);
  void emission(const AreaEmission& e, const FloatInput& alpha);
  /// pbrt multiplies a light by the surface's alpha itself.
  ColorInput radiance_before_alpha(const AreaEmission& e, const FloatInput& alpha);
  /// A constant factor before an image; nothing for another texture.
  struct ScaledImage {
    const BitmapTexture* image = nullptr;
    Spectrum scale{1.0f};
  };
  std::optional<ScaledImage> scaled_image(TextureId id) const;
  /// The scale as one number; a loss if it has a colour.
  double grey_scale(const Spectrum& scale, std::string_view of_what);

  // write_shapes.cpp
  void shape(const ShapeDescription& s, bool in_group);
  /// `own` is the part of the transform that the geometry itself takes.
  void mesh(const MeshShape& m, const FloatInput& alpha, const Matrix4& own);
  void trianglemesh(const TriangleMesh& m, const FloatInput& alpha);
  void curves(const ShapeDescription& s, const CurveSet& c, const FloatInput& alpha);
  void geometry(const ShapeDescription& s, const FloatInput& alpha, const Matrix4& own);
  /// Whether texture coordinates matter to what the surface is made of.
  bool looks_at_uv(const ShapeDescription& s) const;
  /// The transform, also of what moves.
  void place(std::string& out, const Matrix4& to_world, const Motion& motion);

  const SceneDescription& d_;
  Losses losses_;
  UniqueNames names_;
  std::map<std::pair<MaterialId, bool>, std::string> materials_;
  std::vector<std::string> media_names_, group_names_;
  std::set<std::pair<TextureId, bool>> textures_;
  /// The two times between which all motion happens.
  std::array<double, 2> times_;
  // Parts of the text, in their order.
  std::string media_text_, head_text_, textures_text_, materials_text_, world_text_;
};

}  // namespace duet::pbrt
