// Shapes by their names.
#include "pbrt/shape_readers.h"
#include "pbrt/vocabulary.h"

namespace duet::pbrt {

namespace {

const std::vector<Record<ReadShape>>& shapes() {
  static const std::vector<Record<ReadShape>> all = [] {
    std::vector<Record<ReadShape>> list;
    for (const auto part : {quadric_shapes(), mesh_shapes(), curve_shapes()})
      list.insert(list.end(), part.begin(), part.end());
    return list;
  }();
  return all;
}

}  // namespace

void add_mesh(Values& v, TriangleMesh mesh, bool own_normals) {
  if (mesh.triangles.empty()) {
    v.reader().report().warning(v.where(), "this shape has no area and is left out");
    return;
  }
  auto shared = std::make_shared<const TriangleMesh>(std::move(mesh));
  v.reader().add_shape(v.plugin(),
                       {.geometry = MeshShape{std::move(shared)}, .has_normals = own_normals});
}

void read_shape(Reader& reader, const Plugin& plugin) {
  if (const auto* record = find_record<ReadShape>(reader, plugin, shapes())) {
    Values values(reader, plugin, record->parameters, kShapeSpecs);
    record->read(values);
  }
}

void list_shapes(std::vector<Row>& rows) {
  list(rows, "Shape", std::span<const Record<ReadShape>>(shapes()), kShapeSpecs);
}

}  // namespace duet::pbrt
