// Reads the tables of reference/tables, in which Mitsuba has answered small questions.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "geometry/mesh.h"
#include "math/transform.h"

namespace duet::test {

using Json = nlohmann::json;

Json read_table(const std::string& name);

Matrix4 to_matrix(const Json& rows);

/// Three numbers of a row, from index `first`.
template <class T>
T triple(const Json& row, size_t first) {
  return {row[first].get<float>(), row[first + 1].get<float>(), row[first + 2].get<float>()};
}

/// The mesh of the tables, with all that it has.
TriangleMesh to_mesh(const Json& m);

}  // namespace duet::test
