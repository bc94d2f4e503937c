// Shapes by their names.
#include <algorithm>

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

bool shape_has(std::string_view shape, std::string_view parameter) {
  const auto is_it = [&](const Spec& s) { return s.name == parameter; };
  if (std::ranges::any_of(kShapeSpecs, is_it)) return true;
  return std::ranges::any_of(shapes(), [&](const Record<ReadShape>& r) {
    return r.name == shape && std::ranges::any_of(r.parameters, is_it);
  });
}

void add_mesh(Values& v, TriangleMesh mesh, bool own_normals) {
  if (mesh.triangles.empty()) {
    v.reader().report().warning(v.where(), "this shape has no area and is left out");
    return;
  }
  auto shared = std::make_shared<const TriangleMesh>(std::move(mesh));
  v.reader().add_shape(v.plugin(),
                       {.geometry = MeshShape{std::move(shared)}, .has_normals = own_normals});
}

void read_shape(Reader& reader, Plugin plugin) {
  GraphicsState& state = reader.state();
  const MaterialId current = state.material;
  if (const auto own = take_material(reader, plugin)) state.material = *own;
  if (const auto* record = find_record<ReadShape>(reader, plugin, shapes())) {
    Values values(reader, plugin, record->parameters, kShapeSpecs);
    record->read(values);
  }
  state.material = current;
}

void list_shapes(std::vector<Row>& rows) {
  list(rows, "Shape", std::span<const Record<ReadShape>>(shapes()), kShapeSpecs);
}

}  // namespace duet::pbrt
