// Wavefront OBJ. Groups and materials come by tinyobjloader's callbacks (its other interface splits
// quadrilaterals by their shorter diagonal, which Mitsuba does not, and forgets the names of
// materials without a library), the data of meshes by ObjLines.
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

/// Makes meshes of what a file says.
class ObjBuilder final : public ObjSink {
 public:
  ObjBuilder(const ObjPlace& place, bool divide) : place_(place), divide_(divide), parts_(1) {}

  void add_position(const Point3f& p) override {
    if (!is_finite(p)) place_.fail(place_.line, "the position is not finite");
    positions_.push_back(p);
  }
  void add_normal(const Normal3f& n) override { normals_.push_back(n); }
  void add_uv(const Point2f& uv) override {
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
      place_.fail(place_.line, "the texture coordinates are not finite");
    uvs_.push_back(uv);
  }

  /// A face of fewer than three corners has no surface.
  void add_face(std::span<const ObjCorner> corners) override {
    RawPart& part = parts_.back();
    uint32_t first = 0, last = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
      const ObjCorner& c = corners[i];
      const uint32_t v = vertex(part, {resolve(0, c[0]), resolve(1, c[1]), resolve(2, c[2])});
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

  ObjFile finish(const ByteReader& in, const MeshOptions& options, const std::string& library) {
    const size_t counts[3] = {positions_.size(), uvs_.size(), normals_.size()};
    for (int kind = 0; kind < 3; ++kind)
      if (furthest_[kind].index >= 0 && size_t(furthest_[kind].index) >= counts[kind])
        place_.fail(furthest_[kind].line, "{} {} does not exist; there are {}", kKinds[kind],
                    furthest_[kind].index + 1, counts[kind]);
    if (parts_.size() > 1 && parts_.back().triangles.empty()) parts_.pop_back();
    if (parts_.back().triangles.empty())
      throw ReadError(fmt::format("{}: has no faces; is it an OBJ file?", in.name()));

    ObjFile result;
    result.library = library;
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
  /// The number of a vertex in a part. Most positions belong to one vertex, which is found without
  /// a search.
  uint32_t vertex(RawPart& part, const Corner& c) {
    const size_t position = size_t(c[0]);
    if (latest_.size() < positions_.size()) latest_.resize(positions_.size());
    if (position >= latest_.size()) return part.vertex(c);
    uint32_t& n = latest_[position];
    if (n >= part.vertices.size() || part.vertices[n] != c) n = part.vertex(c);
    return n;
  }

  /// From the file's index, which counts from 1, or back from the last element if it is negative.
  int resolve(int kind, int index) {
    const size_t counts[3] = {positions_.size(), uvs_.size(), normals_.size()};
    const int count = int(counts[kind]);
    if (index < 0) {
      if (-index > count)
        place_.fail(place_.line, "{} {} does not exist; there are {} so far", kKinds[kind], index,
                    count);
      return count + index;
    }
    if (index == 0) {
      if (kind == 0) place_.fail(place_.line, "position 0 does not exist; they count from 1");
      return -1;
    }
    // What a face uses may follow it.
    if (index > count && index - 1 > furthest_[kind].index)
      furthest_[kind] = {index - 1, place_.line};
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

  const ObjPlace& place_;
  bool divide_;
  std::vector<RawPart> parts_;
  std::vector<Point3f> positions_;
  std::vector<Point2f> uvs_;
  std::vector<uint32_t> latest_;  ///< by position: the vertex that it was last part of
  std::vector<Normal3f> normals_;
  Furthest furthest_[3];
};

ObjBuilder& builder(void* user) {
  return *static_cast<ObjBuilder*>(user);
}

}  // namespace

ObjFile parse_obj(ByteReader& in, const MeshOptions& options, bool divide) {
  ObjPlace place{in.name()};
  ObjBuilder result(place, divide);
  ObjLines lines(in, place, result);
  tinyobj::callback_t callbacks;
  callbacks.usemtl_cb = [](void* user, const char* name, int) { builder(user).use_material(name); };
  callbacks.group_cb = [](void* user, const char**, int) { builder(user).begin_group(); };
  std::istream stream(&lines);
  stream.exceptions(std::ios::badbit);
  tinyobj::LoadObjWithCallback(stream, callbacks, &result);
  return result.finish(in, options, lines.library());
}

}  // namespace duet
