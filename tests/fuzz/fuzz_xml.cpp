// Feeds arbitrary bytes to the scene reader as scene.xml and, after zero bytes, a.xml, b.xml, …
// that it may include. No disk is involved. What is read must survive a round trip.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "mitsuba/mitsuba.h"
#include "mitsuba/writer.h"

namespace {

using namespace duet;

std::vector<std::string> split(const uint8_t* data, size_t size) {
  std::vector<std::string> texts(1);
  for (size_t i = 0; i < size; ++i)
    if (data[i] != 0)
      texts.back() += char(data[i]);
    else if (texts.size() < 4)
      texts.emplace_back();
  return texts;
}

/// Files by their last name; images, meshes and volumes of all names exist.
FileAccess in_memory(std::vector<std::string> texts) {
  const auto find = [](const std::vector<std::string>& all,
                       const std::string& path) -> std::optional<std::string> {
    const std::string name = std::filesystem::path(path).filename().string();
    if (name == "scene.xml") return all[0];
    for (size_t i = 1; i < all.size(); ++i)
      if (name == std::string(1, char('a' + i - 1)) + ".xml") return all[i];
    if (name.ends_with(".spd")) return "# wavelengths\n400 0.5\n550 1\n700 0.25\n";
    if (name.ends_with(".mtl"))
      return "newmtl a\nKd 1 0 0\nillum 2\nKs 1 1 1\nNs 9\nd 0.5\nnewmtl b\nbump a.png\n";
    if (name.ends_with(".obj")) return "x";
    if (name.ends_with(".png") || name.ends_with(".ply") || name.ends_with(".exr") ||
        name.ends_with(".vol"))
      return "";
    return std::nullopt;
  };
  FileAccess access;
  access.exists = [=](const std::string& path) { return find(texts, path).has_value(); };
  access.read = [=](const std::string& path) { return find(texts, path); };
  access.read_mesh = [](const std::string&, const std::string& path, const MeshOptions&) {
    if (path.find("broken") != path.npos) throw ReadError("broken");
    return make_rectangle();
  };
  access.read_obj_parts = [](const std::string& path, const MeshOptions&) {
    if (path.find("broken") != path.npos) throw ReadError("broken");
    return ObjFile{{{"a", make_rectangle()}, {"b", make_rectangle()}}, "a.mtl"};
  };
  access.read_volume = [](const std::string& path) {
    if (path.find("broken") != path.npos) throw ReadError("broken");
    VolumeFile file;
    file.grid.channels = path.find("six") != path.npos ? 6 : 1;
    file.grid.values.assign(size_t(file.grid.channels), 1);
    return file;
  };
  return access;
}

void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  MitsubaOptions options;
  options.files = in_memory(split(data, size));
  options.defines = {{"defined", "2"}};
  Diagnostics diagnostics;
  const auto scene = read_mitsuba("/fuzz/scene.xml", options, diagnostics);
  // Either a scene or the reason why not.
  require(scene.has_value() == (diagnostics.error_count() == 0));
  for (const Diagnostic& d : diagnostics.all()) require(!d.to_string().empty());
  if (!scene) return 0;

  const MitsubaXml xml = write_mitsuba_xml(scene->description);
  MitsubaOptions second;
  second.files = in_memory({xml.text});
  Diagnostics messages;
  const auto copy = read_mitsuba("/fuzz/scene.xml", second, messages);
  require(copy || !xml.losses.empty());
  if (xml.losses.empty()) require(copy->description == scene->description);
  return 0;
}
