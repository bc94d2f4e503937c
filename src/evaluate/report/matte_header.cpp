#include "evaluate/report/matte_header.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

namespace duet {

HeaderFields matte_header(MatteKind kind, const SceneNames& names) {
  // In the order of the names, each once.
  std::map<std::string, std::string> ids;
  const auto add = [&](const std::vector<std::string>& list) {
    for (const std::string& name : list)
      if (!name.empty()) ids[name] = fmt::format("{:08x}", matte_id(name));
  };
  if (kind == MatteKind::material) {
    add(names.materials);
  } else {
    add(names.shapes);
    add(names.instances);
  }
  const std::string name = matte_name(kind);
  const std::string key =
      fmt::format("{}{:.7}/", kMatteFields, fmt::format("{:08x}", murmur3_32(name)));
  const auto replace = nlohmann::json::error_handler_t::replace;
  return {{key + "name", name},
          {key + "hash", "MurmurHash3_32"},
          {key + "conversion", "uint32_to_float32"},
          {key + "manifest", nlohmann::json(ids).dump(-1, ' ', false, replace)}};
}

}  // namespace duet
