// Turns a tree of plugins into a scene description.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>

#include "files/file_cache.h"
#include "mitsuba/material_library.h"
#include "mitsuba/mitsuba.h"
#include "mitsuba/properties.h"
#include "scene/texture_value.h"

namespace duet {

/// What the readers of the plugins share: the description that grows, and the ways to read a
/// parameter that may be another plugin.
class SceneReader {
 public:
  SceneReader(const FileAccess& access, Report& report)
      : access_(access), report_(report), cache_(access, report) {}

  SceneDescription read(const NodeTree& tree, const std::string& file);

  SceneDescription& description() { return description_; }
  const FileAccess& files() const { return access_; }
  FileCache& cache() { return cache_; }
  Report& report() { return report_; }

  // ---- Parameters (read_values.cpp) ----
  /// A colour or texture; how a spectrum is converted follows from the parameter's type.
  ColorInput color(Properties& p, std::string_view name);
  /// A colour where a texture is not possible.
  Spectrum constant_color(Properties& p, std::string_view name);
  FloatInput number_or_texture(Properties& p, std::string_view name);
  std::optional<TextureId> texture(Properties& p, std::string_view name);
  /// What the plugin of a texture is as a colour parameter; nothing after an error.
  std::optional<ColorInput> color(const Node& node, ColorMeaning meaning);
  /// A colour or volume, and a number or volume.
  ColorVolume color_volume(Properties& p, std::string_view name);
  FloatVolume float_volume(Properties& p, std::string_view name);
  /// An index of refraction by number or name.
  double index_of_refraction(Properties& p, std::string_view name);
  /// The path of a file that exists; "" after an error.
  std::string file(Properties& p, std::string_view name);

  // ---- Plugins ----
  std::optional<TextureId> texture(const Node& node);
  std::optional<MaterialId> material(const Node& node);
  /// A diffuse grey, or one that lets everything pass; all that ask for the same share it.
  MaterialId shared_material(std::optional<float> reflectance, const SourceLocation& where);
  std::optional<MediumId> medium(const Node& node);
  std::optional<PhaseId> phase(const Node& node);
  /// What a volume yields; nothing after an error.
  std::optional<ColorVolume> volume(const Node& node, ColorMeaning meaning);
  PhaseId add_phase(PhaseDescription phase);
  VolumeId add_volume(VolumeDescription volume);
  std::optional<uint32_t> shape_group(const Node& node);
  /// The library that an OBJ file in `file` names; null, after a warning or an error, if it cannot
  /// be read. `where` is the file's name in the scene.
  MaterialLibrary* material_library(const std::string& name, const std::string& file, Properties& p,
                                    const SourceLocation& where);
  /// Appends the shape; a shape group goes where the groups are.
  void shape(const Node& node, std::vector<ShapeDescription>& shapes, bool in_group);
  /// What all surfaces have: transform, orientation, light, media and material.
  void attach_to_surface(Properties& p, ShapeDescription& shape);
  /// The same without the material, and the one that holds where the shape is given none.
  void attach_without_material(Properties& p, ShapeDescription& shape);
  MaterialId default_material(Properties& p, const ShapeDescription& shape);
  /// What emits on a shape; nothing after an error.
  Boxed<AreaEmission> emission(const Node& node);
  /// Reads `node` with its plugin's function if that makes a T; false after an error.
  template <class T>
  bool read_into(const Node& node, T& result);

  /// Records what is rendered differently from what the file says, once.
  void approximate(const SourceLocation& where, std::string what);
  /// The same, with a warning.
  void approximate_loudly(const SourceLocation& where, std::string what);

 private:
  void top_level(const NodeTree& tree);
  /// A plugin at the top of the scene, but for its integrator.
  void top_level(const Node& node);
  /// Reads the irradiance meters on a shape of the scene.
  void sensors_on_shape(const Node& node, bool misplaced, size_t shape);
  void check_scene(const NodeTree& tree, bool have_integrator);
  /// The colour of a property, or the texture it names; nothing after an error.
  std::optional<ColorInput> color_of(Properties& p, std::string_view name, const Property& property,
                                     ColorMeaning meaning);
  /// What a texture is where a volume is asked for, with a warning; nothing after an error.
  std::optional<TextureValue> value_for_volume(Properties& p, std::string_view name,
                                               TextureId texture);
  /// RGB from the file, if it is one that the parameter can have. `limited` colours are errors
  /// above 1 in Mitsuba 3.
  Spectrum checked(Properties& p, std::string_view name, const Triple& rgb, ColorMeaning meaning,
                   bool limited);

  const FileAccess& access_;
  Report& report_;
  FileCache cache_;
  SceneDescription description_;
  /// Indices of the textures, materials and groups that have been read.
  std::unordered_map<const Node*, std::optional<uint32_t>> ids_;
  /// The plugins that are being read, outermost first.
  std::vector<const Node*> active_;
  /// Lights at the top of the scene that belong to surfaces, and whether a shape refers to them.
  std::unordered_map<const Node*, bool> surface_lights_;
  /// Those that shapes without a BSDF share: by their reflectance, and the one that is invisible.
  std::map<std::optional<float>, MaterialId> shared_materials_;
  /// Volumes that have been read, by the meaning that was asked for.
  std::map<std::pair<const Node*, ColorMeaning>, std::optional<ColorVolume>> volumes_;
  std::map<std::string, std::unique_ptr<MaterialLibrary>> libraries_;

  /// The index in `list` of what the plugin makes of `initial`; it is read once.
  template <class Id, class T>
  std::optional<Id> once(const Node& node, std::vector<T>& list, T initial = {});
  /// Whether the plugin may be read now: it contains neither itself nor too many others.
  bool may_enter(const Node& node);
};

template <class T>
bool SceneReader::read_into(const Node& node, T& result) {
  if (!node.plugin) return false;
  const ReadInto<T>* read = std::get_if<ReadInto<T>>(&node.plugin->reader);
  if (!read) {
    report_.error(node.where, "{} cannot be used in this place", describe(node));
    return false;
  }
  if (!may_enter(node)) return false;
  active_.push_back(&node);
  const Report::Mute mute(report_, node.replaced);
  const size_t approximations = description_.approximations.size();
  Properties properties(node, report_);
  (*read)(*this, properties, result);
  properties.finish();
  if (node.replaced)
    description_.approximations.erase(
        description_.approximations.begin() + ptrdiff_t(approximations),
        description_.approximations.end());
  active_.pop_back();
  return true;
}

}  // namespace duet
