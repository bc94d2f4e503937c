// Wavefront OBJ, by tinyobjloader's callbacks: they give indices as the file has them, while its
// other interface splits quadrilaterals by their shorter diagonal, which Mitsuba does not, and
// forgets the names of materials without a library.
#include <istream>

#include "base/numbering.h"
#include "math/hash.h"
#include "mesh/formats.h"
#include "mesh/obj_lines.h"

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

namespace duet {

namespace {

/// Indices of a position, texture coordinates and a normal, from 0; −1 is none.
using Corner = std::array<int, 3>;
constexpr const char* kKinds[3] = {"position", "texture coordinate", "normal"};

/// Faces that become one mesh, before positions, texture coordinates and normals are put together.
struct RawPart {
  std::string material;
  std::vector<Corner> vertices;  ///< in order of first use, which is Mitsuba's order
  std::vector<std::array<uint32_t, 3>> triangles;
  Numbering numbering;

  uint32_t vertex(const Corner& c) {
    const uint64_t hash =
        hash_combine(hash_combine(uint32_t(c[0]), uint32_t(c[1])), uint32_t(c[2]));
    const uint32_t n = numbering.number(hash, [&](uint32_t i) { return vertices[i] == c; });
    if (n == vertices.size()) vertices.push_back(c);
    return n;
  }
};

/// Receives what tinyobjloader finds.
class ObjBuilder {
 public:
  ObjBuilder(const ObjLines& lines, bool divide) : lines_(lines), divide_(divide), parts_(1) {}

  void add_position(float x, float y, float z) {
    if (!is_finite(Point3f(x, y, z))) lines_.fail(lines_.line(), "the position is not finite");
    positions_.push_back({x, y, z});
  }
  void add_normal(float x, float y, float z) { normals_.push_back({x, y, z}); }
  void add_uv(float u, float v) {
    if (!std::isfinite(u) || !std::isfinite(v))
      lines_.fail(lines_.line(), "the texture coordinates are not finite");
    uvs_.push_back({u, v});
  }

  /// A face of fewer than three corners has no surface.
  void add_face(const tinyobj::index_t* corners, int count) {
    RawPart& part = parts_.back();
    uint32_t first = 0, last = 0;
    for (int i = 0; i < count; ++i) {
      const uint32_t v =
          part.vertex({resolve(0, corners[i].vertex_index), resolve(1, corners[i].texcoord_index),
                       resolve(2, corners[i].normal_index)});
      if (i == 0) first = v;
      if (i >= 2) part.triangles.push_back({first, last, v});
      last = v;
    }
  }

  void begin_group() {
    if (!divide_ || parts_.back().triangles.empty()) return;
    const std::string material = parts_.back().material;
    parts_.emplace_back().material = material;
  }
  void use_material(std::string_view name) {
    begin_group();
    const size_t begin = std::min(name.find_first_not_of(" \t"), name.size());
    const size_t end = name.find_last_not_of(" \t") + 1;
    parts_.back().material = name.substr(begin, std::max(end, begin) - begin);
  }

  ObjFile finish(const ByteReader& in, const MeshOptions& options) {
    const size_t counts[3] = {positions_.size(), uvs_.size(), normals_.size()};
    for (int kind = 0; kind < 3; ++kind)
      if (furthest_[kind].index >= 0 && size_t(furthest_[kind].index) >= counts[kind])
        lines_.fail(furthest_[kind].line, "{} {} does not exist; there are {}", kKinds[kind],
                    furthest_[kind].index + 1, counts[kind]);
    if (parts_.size() > 1 && parts_.back().triangles.empty()) parts_.pop_back();
    if (parts_.back().triangles.empty())
      throw ReadError(fmt::format("{}: has no faces; is it an OBJ file?", in.name()));

    ObjFile result;
    result.library = lines_.library();
    for (RawPart& raw : parts_) {
      ObjPart& part = result.parts.emplace_back();
      part.material = std::move(raw.material);
      part.mesh = assemble(raw, options);
      raw = {};
      if (options.dialect == MeshDialect::mitsuba0) merge_equal_vertices(part.mesh);
      finish_mesh(in, options, part.mesh);
    }
    return result;
  }

 private:
  /// From the file's index, which counts from 1, or back from the last element if it is negative.
  int resolve(int kind, int index) {
    const size_t counts[3] = {positions_.size(), uvs_.size(), normals_.size()};
    const int count = int(counts[kind]);
    if (index < 0) {
      if (-index > count)
        lines_.fail(lines_.line(), "{} {} does not exist; there are {} so far", kKinds[kind], index,
                    count);
      return count + index;
    }
    if (index == 0) {
      if (kind == 0) lines_.fail(lines_.line(), "position 0 does not exist; they count from 1");
      return -1;
    }
    // What a face uses may follow it.
    if (index > count && index - 1 > furthest_[kind].index)
      furthest_[kind] = {index - 1, lines_.line()};
    return index - 1;
  }

  /// Texture coordinates and normals that some faces lack are zero there.
  TriangleMesh assemble(RawPart& raw, const MeshOptions& options) const {
    const auto any = [&](int kind) {
      for (const Corner& c : raw.vertices)
        if (c[size_t(kind)] >= 0) return true;
      return false;
    };
    TriangleMesh mesh;
    mesh.triangles = std::move(raw.triangles);
    mesh.positions.reserve(raw.vertices.size());
    for (const Corner& c : raw.vertices) mesh.positions.push_back(positions_[size_t(c[0])]);
    if (any(1)) {
      const Point2f none{0, options.flip_tex_coords ? 1.0f : 0.0f};
      mesh.uvs.reserve(raw.vertices.size());
      for (const Corner& c : raw.vertices) mesh.uvs.push_back(c[1] < 0 ? none : uvs_[size_t(c[1])]);
    }
    if (any(2) && !options.face_normals) {
      mesh.normals.reserve(raw.vertices.size());
      for (const Corner& c : raw.vertices)
        mesh.normals.push_back(c[2] < 0 ? Normal3f{} : normals_[size_t(c[2])]);
    }
    return mesh;
  }

  /// The greatest index that a face used before its element was read, and where.
  struct Furthest {
    int index = -1, line = 0;
  };

  const ObjLines& lines_;
  bool divide_;
  std::vector<RawPart> parts_;
  std::vector<Point3f> positions_;
  std::vector<Point2f> uvs_;
  std::vector<Normal3f> normals_;
  Furthest furthest_[3];
};

ObjBuilder& builder(void* user) {
  return *static_cast<ObjBuilder*>(user);
}

}  // namespace

ObjFile parse_obj(ByteReader& in, const MeshOptions& options, bool divide) {
  ObjLines lines(in);
  ObjBuilder result(lines, divide);
  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = [](void* user, float x, float y, float z, float) {
    builder(user).add_position(x, y, z);
  };
  callbacks.normal_cb = [](void* user, float x, float y, float z) {
    builder(user).add_normal(x, y, z);
  };
  callbacks.texcoord_cb = [](void* user, float u, float v, float) { builder(user).add_uv(u, v); };
  callbacks.index_cb = [](void* user, tinyobj::index_t* corners, int count) {
    builder(user).add_face(corners, count);
  };
  callbacks.usemtl_cb = [](void* user, const char* name, int) { builder(user).use_material(name); };
  callbacks.group_cb = [](void* user, const char**, int) { builder(user).begin_group(); };
  std::istream stream(&lines);
  stream.exceptions(std::ios::badbit);
  tinyobj::LoadObjWithCallback(stream, callbacks, &result);
  return result.finish(in, options);
}

}  // namespace duet
