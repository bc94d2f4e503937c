#include "evaluate/convert/convert_scene.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/failures.h"
#include "evaluate/convert/new_files.h"
#include "mitsuba/writer.h"
#include "pbrt/writer.h"

namespace duet {

namespace {

namespace fs = std::filesystem;

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  return fs::equivalent(a, b, ignored);
}

}  // namespace

bool can_convert_to(const std::string& file) {
  return file.ends_with(".xml") || file.ends_with(".pbrt");
}

void check_conversion(const std::string& in, const std::string& out) {
  if (!can_convert_to(out))
    throw UsageError(fmt::format("{}: the file to write must end in .xml or .pbrt", out));
  if (is_same_file(in, out))
    throw UsageError(fmt::format("{} is the scene that is read: it is not replaced", out));
  const fs::path folder = fs::absolute(out).parent_path();
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw UsageError(fmt::format("{}: there is no folder {}", out, folder.string()));
  if (fs::exists(out, ignored) && !fs::is_regular_file(out, ignored))
    throw UsageError(fmt::format("{} exists and is not a regular file", out));
}

ConvertedScene convert_scene(const SceneDescription& scene, const std::string& file) {
  NewFiles files(file);
  SceneDescription d = scene;
  ConvertedScene result;
  std::string text;
  const auto convert = [&](const auto& prepare, const auto& write) {
    Losses losses;
    prepare(d, files, losses);
    // What is made beside the scene has a relative name already when the others get theirs.
    name_files_again(d, files);
    auto written = write(d);
    text = std::move(written.text);
    for (std::string& loss : written.losses) losses.add(std::move(loss));
    result.losses = losses.list();
  };
  if (file.ends_with(".pbrt"))
    convert(prepare_for_pbrt, pbrt::write_pbrt);
  else
    convert(prepare_for_mitsuba, write_mitsuba_xml);
  result.files = files.take();
  result.files.push_back({file, std::move(text)});
  return result;
}

std::string taken_file(const ConvertedScene& converted) {
  for (const ConvertedFile& file : converted.files) {
    std::error_code ignored;
    if (!fs::exists(file.path, ignored)) continue;
    std::ifstream stream(file.path, std::ios::binary);
    if (std::string(std::istreambuf_iterator<char>(stream), {}) != file.bytes) return file.path;
  }
  return "";
}

}  // namespace duet
