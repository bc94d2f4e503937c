// What a scene file describes, for programs to read.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "evaluate/report/loaded_scene.h"

namespace duet {

/// All that `duet info` prints, under keys that stay. `name` is what the scene is called.
nlohmann::ordered_json scene_json(const std::string& file, const std::string& name,
                                  const LoadedScene& scene);

/// The text of a JSON value. Bytes that are not UTF-8, as names of files can have them, are
/// replaced by U+FFFD.
std::string json_text(const nlohmann::ordered_json& value);

}  // namespace duet
