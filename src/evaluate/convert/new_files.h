// The files that a converted scene needs beside it.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "evaluate/convert/convert_scene.h"
#include "image/image.h"
#include "values/writing.h"

namespace duet {

class NewFiles {
 public:
  explicit NewFiles(std::string scene_file);

  /// A path as the scene says it: relative to the scene's folder where that is possible. Names of
  /// new files stay.
  std::string relative(const std::string& path) const;
  /// The relative name of a new file: that of the scene with its extension, what it holds, a number
  /// and the extension. Scenes of both formats may so lie in one folder.
  std::string add(std::string_view what, std::string_view extension, std::string bytes);

  std::string add_mesh(const std::shared_ptr<const TriangleMesh>& mesh);
  std::string add_image(std::string_view what, const Image& image);

  std::vector<ConvertedFile> take() { return std::move(files_); }

 private:
  std::string folder_, stem_;
  std::vector<ConvertedFile> files_;
  std::set<std::string> made_;
  std::map<std::string, int, std::less<>> counts_;
  /// Shapes may share a mesh.
  std::map<const TriangleMesh*, std::string> meshes_;
};

/// Gives all shapes of the scene to `change`: those of groups and sensors, too.
template <class Change>
void for_all_shapes(SceneDescription& scene, Change change) {
  for_each_shape(scene, change);
  for (SensorDescription& sensor : scene.sensors)
    for (ShapeDescription& s : sensor.target_shape) change(s);
}

/// Names the images and measured materials of the scene relative to the new scene file.
void name_files_again(SceneDescription& scene, const NewFiles& files);

/// Sets SceneDescription::counts_passed_surfaces to what the format has; a loss where paths are
/// shorter or longer for it.
void count_passed_surfaces(SceneDescription& scene, bool counts, Losses& losses);

/// The description as Mitsuba 3 can have it; what changes is added to `losses`.
void prepare_for_mitsuba(SceneDescription& scene, NewFiles& files, Losses& losses);
/// The same for pbrt-v4.
void prepare_for_pbrt(SceneDescription& scene, NewFiles& files, Losses& losses);

/// Makes files of images that are in another colour space than the other colours. Throws ReadError.
void settle_image_colors(SceneDescription& scene, NewFiles& files);
/// Gives image textures the form that the format has for what they say, where it has one: numbers
/// that are the same by the rules of both, and values that are no colours.
void settle_images_for_mitsuba(SceneDescription& scene);
void settle_images_for_pbrt(SceneDescription& scene);

/// Radiance of an environment of the scene, without its transform: in a form that can be looked up.
enum class EnvironmentForm {
  latitude_longitude,  ///< as Mitsuba's `envmap` has it
  equal_area,          ///< as pbrt's "infinite" has it, +z in the middle
};
/// Each pixel is the mean over its share of the sphere. Throws std::runtime_error if the light
/// cannot be built.
Image environment_image(const SceneDescription& scene, const LightDescription& light,
                        EnvironmentForm form, int width);
/// The number of columns of the light's own image; 0 without one.
int environment_width(const LightDescription& light);

}  // namespace duet
