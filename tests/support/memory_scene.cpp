#include "support/memory_scene.h"

#include "mesh/formats.h"

namespace duet::test {

FileAccess MemoryFiles::access() const {
  FileAccess access;
  const auto texts_copy = texts;
  access.exists = [texts_copy](const std::string& path) {
    const auto at = texts_copy.lower_bound(path);
    return at != texts_copy.end() && (at->first == path || at->first.starts_with(path + "/"));
  };
  access.read = [texts_copy](const std::string& path) -> std::optional<std::string> {
    const auto at = texts_copy.find(path);
    return at == texts_copy.end() ? std::nullopt : std::optional(at->second);
  };
  access.read_mesh = [texts_copy](const std::string&, const std::string& path,
                                  const MeshOptions& options) {
    if (texts_copy.at(path) == "broken") throw ReadError(path + ":7: not a face");
    TriangleMesh mesh = make_rectangle();
    if (options.face_normals) mesh.normals.clear();
    return mesh;
  };
  access.read_obj_parts = [texts_copy, read_mesh = access.read_mesh](const std::string& path,
                                                                     const MeshOptions& options) {
    const std::string& text = texts_copy.at(path);
    if (text.find("\nf ") == text.npos) return ObjFile{{{"", read_mesh("obj", path, options)}}, ""};
    ByteReader in(path, {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
    return parse_obj_parts(in, options);
  };
  access.read_volume = [texts_copy](const std::string& path) {
    const std::string& bytes = texts_copy.at(path);
    ByteReader in(path, {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
    return parse_vol(in);
  };
  return access;
}

std::string ReadResult::messages() const {
  std::string all;
  for (const Diagnostic& d : diagnostics.all()) all += d.to_string() + "\n";
  return all;
}

ReadResult read_text(const std::string& text, MemoryFiles files,
                     std::vector<std::pair<std::string, std::string>> defines) {
  MitsubaOptions options;
  options.defines = std::move(defines);
  return read_with(std::move(options), text, std::move(files));
}

ReadResult read_with(MitsubaOptions options, const std::string& text, MemoryFiles files) {
  files.texts["/scene/scene.xml"] = text;
  ReadResult result;
  options.files = files.access();
  result.scene = read_mitsuba("/scene/scene.xml", options, result.diagnostics);
  return result;
}

std::string scene_text(const std::string& version, const std::string& content) {
  return "<scene version='" + version +
         "'><integrator type='path'/><sensor type='perspective'/>\n" + content + "\n</scene>\n";
}

ReadResult read_scene(const std::string& version, const std::string& content, MemoryFiles files) {
  return read_text(scene_text(version, content), std::move(files));
}

}  // namespace duet::test
