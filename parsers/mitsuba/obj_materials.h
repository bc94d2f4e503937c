// What an OBJ file says about its materials.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace duet {

struct ObjMaterials {
  std::vector<std::string> used;  ///< names after `usemtl`, each once
  bool has_library = false;       ///< names a library with `mtllib`
};

ObjMaterials find_obj_materials(std::string_view text);

}  // namespace duet
