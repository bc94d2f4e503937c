// Writes .serialized mesh files.
#pragma once

#include <string>
#include <vector>

#include "support/files.h"

namespace duet::test {

/// What is in a mesh of a .serialized file before it is compressed.
struct SerializedMesh {
  int version = 4;
  uint32_t flags = 0x1000;
  std::string name = "mesh";
  uint64_t vertices = 3, triangles = 1;
  std::string data;  ///< positions, normals, texture coordinates, colours, indices
};

std::string deflate(const std::string& data);

/// Header and compressed contents.
std::string serialize(const SerializedMesh& mesh);

/// A file of several meshes with the table at its end.
std::string serialized_file(const std::vector<std::string>& meshes, int version = 4);

}  // namespace duet::test
