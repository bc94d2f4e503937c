// The stages of build_scene(): one function per kind of thing.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "cameras/lens_stop.h"
#include "materials/materials.h"
#include "media/phase_functions.h"
#include "scene/build.h"
#include "scene/texture_value.h"
#include "textures/bitmap.h"
#include "textures/shape_texture.h"

namespace duet {

struct HeightField;

/// A file and how it is decoded.
using ImageKey = std::pair<std::string, BitmapDecoding>;
struct ReadImage {
  std::shared_ptr<const BitmapPixels> pixels;  ///< null after an error
  std::string error;
  bool is_told = false;  ///< the error, if there was one
};

/// Instantiates lazily what shapes and lights ask for, each thing once. After an error a function
/// returns null or something harmless, so that the remaining errors are found too.
class SceneBuilder {
 public:
  /// `use` says whether the place_…() functions will be called. Then the caller holds the meshes of
  /// shapes that move, so that the builder takes copies.
  SceneBuilder(SceneDescription description, const BuildOptions& options,
               AccelUse use = AccelUse::still);

  /// Null if there were errors.
  std::unique_ptr<Scene> build();
  Diagnostics& diagnostics() { return diagnostics_; }
  /// Instead of building: texture_value.h.
  std::optional<TextureValue> texture_at_origin(TextureId id);
  /// What build() does first, for displacement.h.
  void displace_meshes();
  SceneDescription take_description() { return std::move(description_); }

  // For what builds plugins. Null after an error.
  const Material* material(MaterialId id);
  const Texture* texture(TextureId id);
  ColorSlot slot(const ColorInput& input);
  FloatSlot slot(const FloatInput& input);
  const GridVolume* volume(VolumeId id);
  const VolumeGrid& grid(VolumeId id) const { return *description_.volumes[size_t(id)].grid; }
  const PhaseFunction* phase(PhaseId id);
  ColorVolumeSlot slot(const ColorVolume& input);
  FloatVolumeSlot slot(const FloatVolume& input);
  /// `nonfinite`: what numbers that are not finite are.
  std::shared_ptr<const BitmapPixels> pixels(const std::string& file,
                                             const BitmapDecoding& decoding,
                                             const SourceLocation& where,
                                             Severity nonfinite = Severity::warning);
  /// Forgets an image that nobody else reads in this form.
  void drop_pixels(const std::string& file, const BitmapDecoding& decoding) {
    images_.erase({file, decoding});
  }
  /// The texture must be told on which shapes it is used.
  template <class T>
  std::unique_ptr<T> on_shapes(std::unique_ptr<T> texture) {
    shape_textures_.insert(texture.get());
    return texture;
  }
  RoughnessOptions roughness(const Roughness& r);

  // place.cpp: once the scene is built, to move what is in it. Shapes and instances are numbered as
  // in the scene, lights as in the description; the transforms can be inverted.
  void place_instance(uint32_t index, const Matrix4& to_world);
  /// A mesh or analytic shape; `local` is the mesh in its own space.
  void place_shape(uint32_t index, const Matrix4& to_world, const TriangleMesh* local);
  void place_light(uint32_t index, const Matrix4& to_world);
  void place_sensor(const Matrix4& to_world);
  /// After some of them, once.
  void settle();

 private:
  using ShapeTextureSet = std::set<ShapeTexture*>;
  /// A texture or material once it has been asked for.
  template <class T>
  struct Made {
    bool done = false;
    const T* thing = nullptr;  ///< null after an error
    uint32_t index = kNone;    ///< in the scene
    /// Textures within it that must be told on which shapes they are used.
    ShapeTextureSet shape_textures;
  };
  template <class T, class Make>
  const T* once(Made<T>& made, const Make& make);
  /// A shape that emits, by index in the scene. Its light has the same number as it has itself.
  struct Emission {
    size_t shape;
    ColorSlot radiance;
    double sampling_weight;
    bool directional;
    EmittingSide side;
    SourceLocation where;
  };

  /// What was built of a light of the description.
  struct DescribedLight {
    Light* light;    ///< null after an error; a part of the environment if there are several
    uint32_t index;  ///< among the lights of the scene
  };

  // build_textures.cpp
  /// Reads those of the textures of shapes, several at once.
  void read_images();

  // build_media.cpp
  /// The index of the medium in the scene; kNone for none or after an error.
  uint32_t medium(std::optional<MediumId> id);
  std::unique_ptr<Medium> make(const MediumDescription& m);

  // build_height_fields.cpp
  void height_fields();
  /// Makes a mesh of the shape if it is a height field; a rectangle after an error.
  void height_field(ShapeDescription& d);
  /// Columns, rows and heights by a texture times `scale`; false after an error.
  bool read_heights(TextureId id, const HeightFieldShape& shape, const Spectrum& scale,
                    HeightField& out);

  // build_displacement.cpp
  void displace(ShapeDescription& d);

  // build_shapes.cpp
  void shapes();
  void add_shape(ShapeDescription& d);
  /// The geometry of a description that has passed check_transform().
  Shape geometry(ShapeDescription& d, const SurfaceNeeds& needs);
  void add_instance(const ShapeDescription& d, uint32_t group);
  static Instance make_instance(uint32_t group, const Matrix4& to_world);
  std::shared_ptr<TriangleMesh> world_mesh(ShapeDescription& d);
  /// Tells the textures on a shape about it.
  void announce(const Shape& shape, const ShapeDescription& d);

  /// The index in the scene of a shape of the description that is no instance.
  uint32_t shape_index(uint32_t described) const;

  // build_lights.cpp
  void lights();
  std::unique_ptr<Light> make(const LightDescription& d);
  std::unique_ptr<Light> make(const Emission& e, const Shape& shape);
  void add_light(std::unique_ptr<Light> light, double sampling_weight);

  // build_cameras.cpp
  std::unique_ptr<Camera> camera(SensorDescription& d, const Point2i& film);
  std::unique_ptr<Camera> realistic(const SensorDescription& d, const Point2i& film);
  /// Nothing after an error.
  std::optional<LensStop> lens_stop(const SensorDescription& d);
  std::unique_ptr<Camera> irradiance_meter(const SensorDescription& d, const Point2i& film);
  std::unique_ptr<Camera> distant_meter(SensorDescription& d, const Point2i& film);
  std::unique_ptr<Camera> batch(SensorDescription& d, const Point2i& film);
  /// Whether a sensor's film has one pixel; an error if not.
  bool check_single_pixel(const SensorDescription& d, const Point2i& film);

  /// What depends on where everything is.
  void survey();
  /// Lets light samples know where the environment is seen.
  void guide_environment(Point2i film);

  // build_names.cpp
  void name_things(SceneNames& names) const;

  /// Whether the matrix can be made a Transform; an error if not.
  bool check_transform(const Matrix4& m, const SourceLocation& where);

  SceneDescription description_;
  BuildOptions options_;
  AccelUse use_;
  Diagnostics diagnostics_;
  std::unique_ptr<Scene> made_;  ///< until it is built
  Scene* scene_;
  std::vector<Made<Texture>> textures_;
  std::vector<Made<Material>> materials_;
  std::vector<Made<GridVolume>> volumes_;
  std::vector<Made<PhaseFunction>> phases_;
  std::vector<Made<Medium>> media_;
  /// Of what is being made.
  ShapeTextureSet shape_textures_;
  std::map<ImageKey, ReadImage> images_;
  std::vector<Emission> emissions_;
  bool lacks_texture_data_ = false;  ///< some shape, of what a texture on it reads
  std::vector<DescribedLight> described_lights_;
  /// Per light of the scene.
  std::vector<double> sampling_weights_;
  /// The meshes of shapes by their index in the scene, if place_shape() may move them.
  std::map<size_t, std::shared_ptr<TriangleMesh>> movable_meshes_;
  /// What place_shape() and place_instance() have moved, as Accel::update() needs it.
  std::vector<uint32_t> moved_shapes_, moved_instances_;
};

template <class T, class Make>
const T* SceneBuilder::once(Made<T>& made, const Make& make) {
  if (!made.done) {
    made.done = true;
    ShapeTextureSet outer = std::exchange(shape_textures_, {});
    made.thing = make();
    made.shape_textures = std::exchange(shape_textures_, std::move(outer));
  }
  shape_textures_.insert(made.shape_textures.begin(), made.shape_textures.end());
  return made.thing;
}

}  // namespace duet
