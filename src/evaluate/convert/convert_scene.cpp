#include "evaluate/convert/convert_scene.h"

#include <filesystem>

#include "evaluate/convert/new_files.h"
#include "mitsuba/writer.h"
#include "pbrt/writer.h"

namespace duet {

bool can_convert_to(const std::string& file) {
  return file.ends_with(".xml") || file.ends_with(".pbrt");
}

ConvertedScene convert_scene(const SceneDescription& scene, const std::string& file) {
  NewFiles files(file);
  SceneDescription d = scene;
  ConvertedScene result;
  std::string text;
  const auto convert = [&](const auto& prepare, const auto& write) {
    prepare(d, files, result.losses);
    // What is made beside the scene has a relative name already when the others get theirs.
    name_files_again(d, files);
    auto written = write(d);
    text = std::move(written.text);
    result.losses.insert(result.losses.end(), written.losses.begin(), written.losses.end());
  };
  if (file.ends_with(".pbrt"))
    convert(prepare_for_pbrt, pbrt::write_pbrt);
  else
    convert(prepare_for_mitsuba, write_mitsuba_xml);
  result.files = files.take();
  result.files.push_back({file, std::move(text)});
  return result;
}

}  // namespace duet
