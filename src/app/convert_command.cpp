// duet convert: a scene as a file of another format.
#include <CLI/CLI.hpp>

#include "app/commands.h"
#include "app/program.h"
#include "app/read_options.h"
#include "base/system/atomic_file.h"
#include "evaluate/convert/convert_scene.h"
#include "evaluate/render/scene_operand.h"

namespace duet {

namespace {

struct ConvertOptions {
  ReadOptions read;
  std::string out;
  bool overwrite = false;
};

int convert(ConvertOptions o, Program& program) {
  const std::string& in = o.read.scenes.front();
  check_conversion(in, o.out);
  o.read.standard_input = read_standard_input(o.read.scenes);
  check_defines(o.read);
  try {
    const LoadedScene scene = load_scene(in, o.read, program.log);
    const ConvertedScene converted = convert_scene(scene.description, o.out);
    const std::string taken = o.overwrite ? "" : taken_file(converted);
    if (!taken.empty())
      throw SceneFailure(
          fmt::format("{} exists already, with another content: --overwrite replaces it", taken));
    for (const std::string& loss : converted.losses) program.log.warning("{}: lost: {}", in, loss);
    if (o.read.strict && !converted.losses.empty()) throw SceneFailure(converted.losses[0], true);
    for (const ConvertedFile& file : converted.files) write_file_atomically(file.path, file.bytes);
    return kSuccess;
  } catch (const SceneFailure& e) {
    if (!e.is_printed()) program.log.error("{}: {}", in, e.what());
  } catch (const std::runtime_error& e) {
    program.log.error("{}: {}", in, e.what());
  }
  return kSceneFailed;
}

}  // namespace

void add_convert_command(CLI::App& app, Program& program) {
  CLI::App* c = app.add_subcommand("convert", "Write a scene as a file of another format");
  const auto o = std::make_shared<ConvertOptions>();
  add_read_options(*c, o->read);
  c->get_option("scene")->expected(1)->allow_extra_args(false);
  c->add_option("output", o->out, "A .xml file (Mitsuba 3) or a .pbrt file (pbrt-v4)")->required();
  c->add_flag("--overwrite", o->overwrite,
              "Replace files that exist with another content: the output and those beside it");
  c->footer(
      "Files that the scene names are named by the output, too, and not copied. Meshes, grids, "
      "curves and environments that have no file, or none that the format can use, are written "
      "beside it; their names begin with that of the output.\n"
      "What the format cannot express is a warning, \"lost: ...\", and a comment in the file. "
      "With --strict nothing is written then, and the exit code is 1.\n"
      "Examples:\n"
      "  duet convert kitchen.pbrt kitchen.xml\n"
      "  duet convert old.xml -D spp=16 new.pbrt");
  c->callback([o, &program] { program.exit_code = convert(*o, program); });
}

}  // namespace duet
