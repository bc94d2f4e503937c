// duet convert: a scene as a file of another format.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "app/commands.h"
#include "app/program.h"
#include "app/scene_file.h"
#include "app/scene_operand.h"
#include "base/atomic_file.h"
#include "evaluate/convert/convert_scene.h"

namespace duet {

namespace {

namespace fs = std::filesystem;

struct ConvertOptions {
  ReadOptions read;
  std::string out;
  bool overwrite = false;
};

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  return fs::equivalent(a, b, ignored);
}

/// What can be known to go wrong before the scene is read.
void check_output(const std::string& in, const std::string& out) {
  if (!can_convert_to(out))
    throw UsageError(fmt::format("{}: the file to write must end in .xml or .pbrt", out));
  if (is_same_file(in, out))
    throw UsageError(fmt::format("{} is the scene that is read: it is not replaced", out));
  const fs::path folder = fs::absolute(out).parent_path();
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw UsageError(fmt::format("{}: there is no folder {}", out, folder.string()));
  if (fs::exists(out, ignored) && !fs::is_regular_file(out, ignored))
    throw UsageError(fmt::format("{} exists and is not a regular file", out));
}

/// Nothing takes the place of another file by accident: scenes and meshes are often made by hand.
void check_new_files(const ConvertedScene& converted) {
  for (const ConvertedFile& file : converted.files) {
    std::error_code ignored;
    if (!fs::exists(file.path, ignored)) continue;
    std::ifstream stream(file.path, std::ios::binary);
    if (std::string(std::istreambuf_iterator<char>(stream), {}) != file.bytes)
      throw SceneFailure(fmt::format(
          "{} exists already, with another content: --overwrite replaces it", file.path));
  }
}

int convert(const ConvertOptions& o, Program& program) {
  const std::string& in = o.read.scenes.front();
  check_output(in, o.out);
  program.standard_input = read_standard_input(o.read.scenes);
  check_defines(o.read, program);
  try {
    const LoadedScene scene = load_scene(in, o.read, program);
    const ConvertedScene converted = convert_scene(scene.description, o.out);
    if (!o.overwrite) check_new_files(converted);
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
