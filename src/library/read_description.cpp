// Scenes that are put together are read as the text of an XML file, by the reader of such files:
// parameters, defaults and messages are the same. Its lines stand for objects in messages.
#include <array>
#include <bit>
#include <map>

#include "duet/scene_description.h"
#include "library/contents.h"
#include "mesh/mesh_file.h"
#include "mesh/ply_writer.h"
#include "mitsuba/vocabulary.h"
#include "values/report.h"
#include "values/text.h"
#include "xml/xml_printer.h"

namespace duet {

namespace {

/// The name that such a scene has in messages.
constexpr const char* kName = "<description>";

using Place = std::shared_ptr<const std::string>;

/// "scene.ball" and "radius": "scene.ball.radius"; what has no name is where it stands.
Place inside(const Place& outer, std::string_view name) {
  if (name.empty()) return outer;
  const std::string quoted = in_quotes(name);  // cut, and without control characters
  return std::make_shared<const std::string>(*outer + "." + quoted.substr(1, quoted.size() - 2));
}

/// Writes the text, and finds what no text could say.
class DescriptionWriter {
 public:
  DescriptionWriter(const SceneObject& scene, Diagnostics& diagnostics) : report_(diagnostics) {
    const auto root = std::make_shared<const std::string>("scene");
    if (scene.kind() != "scene")
      report_.error({root}, "the outermost object is of the kind \"scene\", not {}",
                    in_quotes(scene.kind()));
    places_ = {root};
    entries(scene, root);
    report_.finish({root});
  }

  std::string text() const { return "<scene version=\"3.0.0\">\n" + out_.text() + "</scene>\n"; }
  /// What a line, counted from 1, stands for.
  Place place(int line) const {
    return places_[size_t(line) <= places_.size() ? size_t(line) - 1 : 0];
  }
  /// The triangles that stand for a file; null if none do.
  const SceneMesh* mesh(const std::string& path) const {
    const auto found = meshes_.find(path);
    return found == meshes_.end() ? nullptr : found->second;
  }

 private:
  /// The last lines stand for this.
  void mark(const Place& place) { places_.resize(size_t(out_.lines()) + 1, place); }

  const std::string& checked(const std::string& text, const Place& place) {
    if (text.find('\0') != std::string::npos)
      report_.error({place}, "{} has a zero byte, which no name or text can have", in_quotes(text));
    return text;
  }

  void entries(const SceneObject& object, const Place& place) {
    std::map<std::string, int> kinds;
    for (const SceneObject::Entry& e : object.entries()) {
      if (const auto* value = std::get_if<SceneValue>(&e.value)) {
        const auto* reference = std::get_if<SceneReference>(value);
        const Place inner = inside(place, e.name.empty() && reference ? reference->id : e.name);
        std::visit([&](const auto& v) { write(checked(e.name, inner), v, inner); }, *value);
        mark(inner);
        continue;
      }
      const auto& o = std::get<SceneObject>(e.value);
      const int number = kinds[o.kind()]++;
      const std::string label = !o.id().empty()   ? o.id()
                                : !e.name.empty() ? e.name
                                                  : fmt::format("{}[{}]", o.kind(), number);
      nested(o, e.name, inside(place, label));
    }
  }

  void nested(const SceneObject& o, const std::string& name, const Place& place) {
    if (!is_kind(o.kind(), place)) return;
    for (const std::string* text : {&name, &o.type(), &o.id()}) checked(*text, place);
    out_.open(o.kind(), o.type(), name, o.id());
    if (o.triangles()) out_.string("filename", mesh_file(*o.triangles(), place));
    mark(place);
    entries(o, place);
    out_.close();
    mark(place);
  }

  bool is_kind(const std::string& kind, const Place& place) {
    // Spectra are textures of one colour.
    if ((kind_of_tag(kind) && kind != "scene") || kind == "spectrum") return true;
    std::vector<std::string> kinds = tags_within_scenes();
    kinds.emplace_back("spectrum");
    report_.error({place}, "no object within a scene is of the kind {}{}", in_quotes(kind),
                  did_you_mean(kind, kinds));
    return false;
  }

  /// The file that the triangles stand for. Copies of an object share it, as a file would be.
  std::string mesh_file(const SceneMesh& mesh, const Place& place) {
    const auto check = [&](size_t count, const char* what) {
      if (count != 0 && count != mesh.positions.size())
        report_.error({place}, "the mesh has {} positions, but {} {}", mesh.positions.size(), count,
                      what);
    };
    check(mesh.normals.size(), "normals");
    check(mesh.uvs.size(), "texture coordinates");
    const auto [entry, is_new] = files_.try_emplace(&mesh);
    if (is_new) {
      entry->second = absolute_path(fmt::format("<mesh {}>", files_.size()));
      meshes_[entry->second] = &mesh;
    }
    return entry->second;
  }

  void write(const std::string& name, bool v, const Place&) { out_.boolean(name, v); }
  void write(const std::string& name, int64_t v, const Place&) { out_.integer(name, v); }
  void write(const std::string& name, double v, const Place&) { out_.number(name, v); }
  void write(const std::string& name, const std::string& v, const Place& place) {
    out_.string(name, checked(v, place));
  }
  void write(const std::string& name, const SceneRgb& v, const Place&) {
    out_.rgb(name, std::array{v.r, v.g, v.b});
  }
  void write(const std::string& name, const ScenePoint& v, const Place&) {
    out_.point(name, {v.x, v.y, v.z});
  }
  void write(const std::string& name, const SceneTransform& v, const Place&) {
    out_.matrix(name, Matrix4{v.rows});
  }
  void write(const std::string& name, const SceneReference& v, const Place& place) {
    out_.reference(name, checked(v.id, place));
  }

  Report report_;
  XmlPrinter out_;
  std::vector<Place> places_;  ///< of the lines
  std::map<const SceneMesh*, std::string> files_;
  std::map<std::string, const SceneMesh*> meshes_;
};

template <class To, class From>
std::vector<To> copied(const std::vector<From>& from) {
  static_assert(sizeof(To) == sizeof(From));
  std::vector<To> to(from.size());
  for (size_t i = 0; i < from.size(); ++i) to[i] = std::bit_cast<To>(from[i]);
  return to;
}

/// Through the bytes of a file, so that its reader checks it, too. Throws ReadError.
TriangleMesh read_triangles(const SceneMesh& mesh, const MeshOptions& options) {
  TriangleMesh unchecked;
  unchecked.positions = copied<Point3f>(mesh.positions);
  unchecked.normals = copied<Normal3f>(mesh.normals);
  unchecked.uvs = copied<Point2f>(mesh.uvs);
  unchecked.triangles = mesh.triangles;
  const std::string bytes = ply_bytes(unchecked);
  const auto* first = reinterpret_cast<const uint8_t*>(bytes.data());
  return read_ply("the mesh", {first, bytes.size()}, options);
}

/// The files of the disk and those that the description stands for.
FileAccess file_access(const DescriptionWriter& written) {
  const FileAccess disk = with_disk({});
  FileAccess access;
  access.read = [&written, disk](const std::string& path) {
    return path == kName ? std::optional(written.text()) : disk.read(path);
  };
  access.exists = [&written, disk](const std::string& path) {
    return written.mesh(path) || disk.exists(path);
  };
  access.read_mesh = [&written, disk](const std::string& plugin, const std::string& path,
                                      const MeshOptions& options) {
    const SceneMesh* const mesh = written.mesh(path);
    return mesh ? read_triangles(*mesh, options) : disk.read_mesh(plugin, path, options);
  };
  access.place = [&written](const std::string& path, int line) {
    return path == kName ? written.place(line) : nullptr;
  };
  return access;
}

}  // namespace

SceneFile SceneFile::from_description(const SceneObject& scene, const SceneFileOptions& options) {
  ReadingOptions reading = reading_options(options);
  Diagnostics diagnostics;
  const DescriptionWriter written(scene, diagnostics);
  if (diagnostics.has_errors()) throw SceneError(scene_messages(diagnostics));
  reading.files = file_access(written);
  return SceneFile(
      std::make_shared<const Contents>(Contents{kName, read_or_throw(kName, reading)}));
}

}  // namespace duet
