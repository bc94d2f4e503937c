// Meshes from PLY files, as pbrt understands them.
#include <zlib.h>

#include "mesh/mesh_file.h"
#include "pbrt/reader.h"
#include "pbrt/shapes.h"

namespace duet::pbrt {

namespace {

/// The whole content of a gzipped file.
std::vector<uint8_t> inflate_file(const std::string& path) {
  const gzFile file = gzopen(path.c_str(), "rb");
  if (!file) throw ReadError(path + ": cannot be opened");
  std::vector<uint8_t> bytes;
  constexpr size_t kStep = size_t(1) << 20;
  int n = 0;
  do {
    const size_t old = bytes.size();
    bytes.resize(old + kStep);
    n = gzread(file, bytes.data() + old, unsigned(kStep));
    bytes.resize(old + size_t(std::max(n, 0)));
  } while (n > 0);
  const bool broken = n < 0 || !gzeof(file) || gzclose(file) != Z_OK;
  if (broken) throw ReadError(path + ": is not a gzip file that is whole");
  return bytes;
}

/// Triangles that share no vertices, with normals of their own.
void set_apart(TriangleMesh& mesh) {
  TriangleMesh apart;
  for (const auto& t : mesh.triangles) {
    const uint32_t first = uint32_t(apart.positions.size());
    const Point3f &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const Normal3f face = normalized_or_zero(Normal3f(cross(b - a, c - a)));
    constexpr std::array<Point2f, 3> kUvs{{{0, 0}, {1, 0}, {1, 1}}};
    for (size_t i = 0; i < 3; ++i) {
      apart.positions.push_back(mesh.positions[t[i]]);
      apart.normals.push_back(mesh.normals.empty() ? face : mesh.normals[t[i]]);
      apart.uvs.push_back(mesh.uvs.empty() ? kUvs[i] : mesh.uvs[t[i]]);
    }
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  mesh = std::move(apart);
}

bool ends_with_gz(const std::string& path) {
  return path.size() > 3 && path.compare(path.size() - 3, 3, ".gz") == 0;
}

}  // namespace

BumpTangents bump_tangents(Version version) {
  return version == Version::v3 ? BumpTangents::unit_backwards : BumpTangents::across_normals;
}

void finish_triangles(TriangleMesh& mesh, bool needs_uv) {
  if (!needs_uv || !mesh.uvs.empty()) return;
  const bool own_normals = !mesh.normals.empty();
  set_apart(mesh);
  if (!own_normals) mesh.normals.clear();
}

const PlyMesh* Reader::ply_mesh(const std::string& path, PlyUse use, const SourceLocation& where) {
  const auto [entry, is_new] = ply_meshes_.try_emplace({path, use});
  PlyMesh& result = entry->second;
  if (!is_new) return result.mesh ? &result : nullptr;
  try {
    std::vector<std::array<uint32_t, 4>> quads;
    MeshOptions options;
    options.only_own_normals = true;
    options.quads = &quads;
    TriangleMesh mesh =
        ends_with_gz(path) ? read_ply(path, inflate_file(path), options) : read_ply(path, options);
    mesh.attributes.clear();
    if (version_ == Version::v3 || use == PlyUse::displaced) {
      for (const auto& [a, b, c, d] : quads) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({d, a, c});
      }
      quads.clear();
    }
    // Those of what is displaced are made from its triangles.
    result.own_normals = !mesh.normals.empty() || use == PlyUse::displaced;
    result.is_whole_file = quads.empty() && result.own_normals && !ends_with_gz(path);
    if (quads.empty()) {
      const bool adds_uv = use == PlyUse::with_uv;
      if (adds_uv && mesh.uvs.empty()) result.is_whole_file = false;
      finish_triangles(mesh, adds_uv);
      if (result.own_normals) mesh.bump_tangents = bump_tangents(version_);
    } else {
      PatchMesh patches{mesh.positions, mesh.normals, mesh.uvs, {}};
      // Corners run around a face, but row by row in a patch.
      for (const auto& [a, b, c, d] : quads) patches.patches.push_back({a, b, d, c});
      set_apart(mesh);
      append_patches(patches, mesh);
      result.own_normals = true;
    }
    result.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  } catch (const ReadError& e) {
    report_.error(where, "{}", e.what());
    return nullptr;
  } catch (const std::bad_alloc&) {
    report_.error(where, "{} is too large for the memory", path);
    return nullptr;
  }
  return &result;
}

}  // namespace duet::pbrt
