#include "mitsuba/obj_materials.h"

#include <algorithm>

#include "mitsuba/text.h"

namespace duet {

ObjMaterials find_obj_materials(std::string_view text) {
  ObjMaterials result;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = trim(text.substr(begin, std::min<size_t>(end - begin, 4096)));
    begin = end + 1;
    if (line.starts_with("mtllib")) result.has_library = true;
    if (!line.starts_with("usemtl")) continue;
    const std::string name(trim(line.substr(6)));
    if (std::find(result.used.begin(), result.used.end(), name) == result.used.end())
      result.used.push_back(name);
  }
  return result;
}

}  // namespace duet
