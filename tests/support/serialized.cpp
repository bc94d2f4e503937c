#include "support/serialized.h"

#include <zlib.h>

namespace duet::test {

std::string deflate(const std::string& data) {
  uLongf size = compressBound(uLong(data.size()));
  std::string result(size, '\0');
  compress(reinterpret_cast<Bytef*>(result.data()), &size,
           reinterpret_cast<const Bytef*>(data.data()), uLong(data.size()));
  result.resize(size);
  return result;
}

std::string serialize(const SerializedMesh& mesh) {
  const std::string name = mesh.version == 4 ? mesh.name + '\0' : "";
  return pack(uint16_t(0x041c), uint16_t(mesh.version)) +
         deflate(pack(mesh.flags) + name + pack(mesh.vertices, mesh.triangles) + mesh.data);
}

std::string serialized_file(const std::vector<std::string>& meshes, int version) {
  std::string result, table;
  for (const std::string& mesh : meshes) {
    table += version == 4 ? pack(uint64_t(result.size())) : pack(uint32_t(result.size()));
    result += mesh;
  }
  return result + table + pack(uint32_t(meshes.size()));
}

}  // namespace duet::test
