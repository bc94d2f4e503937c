// OBJ files, whose parts may have different materials in Mitsuba 0.x.
#include <map>

#include "files/file_access.h"
#include "mitsuba/plugins/shapes.h"
#include "mitsuba/scene_reader.h"
#include "values/text.h"

namespace duet {

namespace {

/// The BSDFs that stand in the shape. In Mitsuba 0.x one with a name is for the parts of the file
/// that use a material of that name; in the order of the scene, each replaces what was there.
struct GivenMaterials {
  std::optional<MaterialId> all;
  std::map<std::string, MaterialId> by_name;
};

GivenMaterials given_materials(SceneReader& s, Properties& p) {
  GivenMaterials given;
  if (!p.is_0x()) {
    if (const Node* node = p.child(PluginKind::bsdf)) given.all = s.material(*node);
    return given;
  }
  for (const Properties::Child& child : p.children(PluginKind::bsdf)) {
    const auto id = s.material(*child.node);
    if (!id) continue;
    if (child.property->name.empty())
      given = {*id, {}};
    else
      given.by_name[child.property->written] = *id;
  }
  return given;
}

/// Which materials the parts of a file get.
class PartMaterials {
 public:
  PartMaterials(SceneReader& s, Properties& p, const GivenMaterials& given,
                const std::string& library_name, const std::string& file,
                const ShapeDescription& shape)
      : s_(s), p_(p), given_(given), library_name_(library_name), file_(file), shape_(shape) {}

  MaterialId find(const std::string& name) {
    const auto [entry, is_new] = found_.try_emplace(name);
    if (is_new) {
      const auto own = given_.by_name.find(name);
      entry->second = own != given_.by_name.end() ? own->second
                      : given_.all                ? *given_.all
                                                  : of_library(name);
    }
    return entry->second;
  }

  void report_unused() const {
    for (const Properties::Child& child : p_.children(PluginKind::bsdf))
      if (const std::string& name = child.property->written;
          given_.by_name.contains(name) && !found_.contains(name))
        s_.report().warning(child.property->where, "no part of {} uses a material called {}", file_,
                            in_quotes(name));
  }

 private:
  MaterialId of_library(const std::string& name) {
    if (!library_name_.empty() && !name.empty()) {
      MaterialLibrary* library =
          s_.material_library(library_name_, file_, p_, p_.where("filename"));
      const Node* node = library ? library->find(name, s_.files(), s_.report()) : nullptr;
      if (library && !node)
        s_.report().warning(p_.where("filename"), "{}: the library {} has no material {}", file_,
                            in_quotes(library_name_), in_quotes(name));
      if (const auto id = node ? s_.material(*node) : std::nullopt) return *id;
    }
    if (!otherwise_) otherwise_ = s_.default_material(p_, shape_);
    return *otherwise_;
  }

  SceneReader& s_;
  Properties& p_;
  const GivenMaterials& given_;
  const std::string library_name_, &file_;
  const ShapeDescription& shape_;
  std::map<std::string, MaterialId> found_;
  std::optional<MaterialId> otherwise_;
};

}  // namespace

MaterialLibrary* SceneReader::material_library(const std::string& name, const std::string& file,
                                               Properties& p, const SourceLocation& where) {
  std::vector<std::string> folders{folder_of(file)};
  folders.insert(folders.end(), p.node().folders->begin(), p.node().folders->end());
  const auto path = find_file(name, folders, access_);
  const auto [entry, is_new] = libraries_.try_emplace(folders[0] + "\n" + path.value_or(name));
  if (!is_new) return entry->second.get();
  if (!path) {
    report_.warning(where, "{}: the material library is missing: {}", file,
                    not_found(name, folders));
    return nullptr;
  }
  folders.insert(folders.begin() + 1, folder_of(*path));
  const auto materials =
      report_.from_file(where, [&] { return parse_mtl(text_of(*path, access_), *path); });
  if (materials)
    entry->second =
        std::make_unique<MaterialLibrary>(*path, *materials, std::move(folders), p.node().version);
  return entry->second.get();
}

void plugins::read_obj_shape(SceneReader& s, Properties& p, ShapeList& out) {
  ShapeDescription shape;
  shape.where = p.node().where;
  shape.label = {p.node().id};
  MeshShape whole;
  whole.source->file = s.file(p, "filename");
  MeshOptions options = mesh_options(p, *whole.source);
  if (p.has("shape_index")) options.obj_part = p.integer("shape_index");
  options.collapse = p.boolean("collapse");
  const bool load = p.boolean("load_materials") && p.is_0x(), recenter = p.boolean("recenter");
  const GivenMaterials given = given_materials(s, p);
  s.attach_without_material(p, shape);
  if (whole.source->file.empty()) return;
  whole.source->is_part = options.obj_part.has_value();
  const SourceLocation where = p.where("filename");

  if (given.by_name.empty() && (given.all || !load)) {
    whole.mesh = s.cache().mesh("obj", whole.source->file, options, where);
    if (!whole.mesh) return;
    if (recenter) shape.to_world = shape.to_world * recentering({whole.mesh.get()});
    shape.material = given.all ? *given.all : s.default_material(p, shape);
    shape.geometry = std::move(whole);
    out.shapes.push_back(std::move(shape));
    return;
  }

  auto read = s.report().from_file(
      where, [&] { return s.files().read_obj_parts(whole.source->file, options); });
  if (!read) return;
  ObjFile& file = *read;
  if (recenter) {
    std::vector<const TriangleMesh*> meshes;
    for (const ObjPart& part : file.parts) meshes.push_back(&part.mesh);
    shape.to_world = shape.to_world * recentering(meshes);
  }
  PartMaterials materials(s, p, given, load ? file.library : "", whole.source->file, shape);
  std::map<std::string, MaterialId> used;
  for (ObjPart& part : file.parts) {
    const MaterialId id = materials.find(part.material);
    part.material = std::to_string(size_t(id));
    used[part.material] = id;
  }
  materials.report_unused();
  file.parts = join_parts(std::move(file.parts));
  whole.source->is_part |= file.parts.size() > 1;
  for (ObjPart& part : file.parts) {
    ShapeDescription& made = out.shapes.emplace_back(shape);
    made.material = used.at(part.material);
    made.geometry = MeshShape{std::make_shared<TriangleMesh>(std::move(part.mesh)), *whole.source};
  }
}

}  // namespace duet
