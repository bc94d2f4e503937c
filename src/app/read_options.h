// The options of commands that read scenes.
#pragma once

#include "evaluate/render/scene_file.h"

namespace CLI {
class App;
}

namespace duet {

/// Adds the scenes and the options -D, -a and --strict to a command.
void add_read_options(CLI::App& command, ReadOptions& options);

}  // namespace duet
