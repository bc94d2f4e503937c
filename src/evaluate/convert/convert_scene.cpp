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
  // What is made beside the scene has a relative name already when the others get theirs.
  if (file.ends_with(".pbrt")) {
    prepare_for_pbrt(d, files, result.losses);
    name_files_again(d, files);
    pbrt::PbrtText written = pbrt::write_pbrt(d);
    text = std::move(written.text);
    result.losses.insert(result.losses.end(), written.losses.begin(), written.losses.end());
  } else {
    prepare_for_mitsuba(d, files, result.losses);
    name_files_again(d, files);
    MitsubaXml written = write_mitsuba_xml(d);
    text = std::move(written.text);
    result.losses.insert(result.losses.end(), written.losses.begin(), written.losses.end());
  }
  result.files = files.take();
  result.files.push_back({file, std::move(text)});
  return result;
}

}  // namespace duet
