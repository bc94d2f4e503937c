// What an image's header says of its mattes.
#pragma once

#include "evaluate/report/header.h"
#include "image/cryptomatte.h"
#include "scene/scene_names.h"

namespace duet {

/// The matte's name, how ids are made, and the manifest: a JSON object of the id of each name, in
/// hexadecimal digits. The fields' names have the beginning of the matte's own hash in them.
HeaderFields matte_header(MatteKind kind, const SceneNames& names);

}  // namespace duet
