#include "mesh/ply_writer.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

namespace duet {

static_assert(std::endian::native == std::endian::little, "files are written as memory has them");

namespace {

template <class T>
void append(std::string& out, const T& value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  out.append(bytes, sizeof(T));
}

}  // namespace

std::string ply_bytes(const TriangleMesh& mesh) {
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n",
      mesh.positions.size());
  if (!mesh.normals.empty()) out += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!mesh.uvs.empty()) out += "property float u\nproperty float v\n";
  out += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                     mesh.triangles.size());
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const Point3f& p = mesh.positions[i];
    for (const float x : {p.x, p.y, p.z}) append(out, x);
    if (!mesh.normals.empty())
      for (const float x : {mesh.normals[i].x, mesh.normals[i].y, mesh.normals[i].z})
        append(out, x);
    if (!mesh.uvs.empty())
      for (const float x : {mesh.uvs[i].x, mesh.uvs[i].y}) append(out, x);
  }
  for (const auto& triangle : mesh.triangles) {
    append(out, uint8_t(3));
    for (const uint32_t corner : triangle) append(out, int32_t(corner));
  }
  return out;
}

}  // namespace duet
