#include "app/read_options.h"

#include <CLI/CLI.hpp>

#include "evaluate/render/scene_operand.h"

namespace duet {

void add_read_options(CLI::App& c, ReadOptions& o) {
  c.add_option("scene", o.scenes,
               "Scene files; a folder means the scene.xml or the only .xml file in it, - means "
               "standard input")
      ->required()
      ->transform(scene_file_of);
  c.option_defaults()->group("Scene");
  c.add_option("-D,--define", o.defines, "NAME=VALUE of a $parameter of the scene; repeatable")
      ->allow_extra_args(false);
  c.add_option("-a,--path", o.search_paths, "Further directory to look for files; repeatable")
      ->allow_extra_args(false)
      ->check(CLI::ExistingDirectory);
  c.add_option("--pbrt-version", o.pbrt_version,
               "Version of pbrt that .pbrt files are for, 3 or 4; by default found from the file")
      ->check(CLI::IsMember({3, 4}));
  c.add_flag("--strict", o.strict, "Every warning is an error");
  c.option_defaults()->group("Options");
}

}  // namespace duet
