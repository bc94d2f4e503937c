// duet info: what a scene contains.
#include <CLI/CLI.hpp>

#include "app/commands.h"
#include "app/scene_file.h"
#include "app/scene_summary.h"
#include "base/log.h"
#include "integrators/make_integrator.h"
#include "mitsuba/writer.h"

namespace duet {

namespace {

struct InfoOptions {
  ReadOptions read;
  std::string method;
  bool xml = false, all = false;
};

/// The scene as it is rendered with the method, if there is one.
void use_method(SceneDescription& description, const std::string& method) {
  try {
    apply_override(description.integrator, {method, {}, {}});
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
}

int info(InfoOptions o) {
  if (o.all) log::set_level(log::Level::verbose);
  if (!o.method.empty()) o.read.methods = {o.method};
  if (o.xml && o.read.scenes.size() > 1)
    throw UsageError("--xml writes one scene; several were given");
  check_defines(o.read);
  bool failed = false;
  for (const std::string& file : o.read.scenes) {
    auto scene = load_scene(file, o.read);
    failed |= !scene;
    if (!scene) continue;
    use_method(scene->description, o.method);
    if (!o.xml) {
      fmt::print("{}", scene_summary(*scene, o.all));
      continue;
    }
    const MitsubaXml xml = write_mitsuba_xml(scene->description);
    for (const std::string& loss : xml.losses) log::warning("{}: {}", file, loss);
    failed |= o.read.strict && !xml.losses.empty();
    fmt::print("{}", xml.text);
  }
  return failed ? kSceneFailed : kSuccess;
}

}  // namespace

void add_info_command(CLI::App& app, int& exit_code) {
  CLI::App* c = app.add_subcommand("info", "Say what scenes contain and how they are modelled");
  const auto o = std::make_shared<InfoOptions>();
  add_read_options(*c, o->read);
  c->add_option("-i,--integrator", o->method, "Method instead of the scene's, as when rendering");
  c->add_flag("-v,--verbose", o->all, "List everything, however much there is");
  c->add_flag("--xml", o->xml,
              "Print the scene as a Mitsuba 3 file, with all parameters replaced, instead");
  c->footer(
      "Nothing is rendered; images are not read. What a scene asks for and Duet renders in "
      "another\n"
      "way is listed under \"approximated\".\n"
      "Examples:\n"
      "  duet info cornell.xml\n"
      "  duet info scenes/*/scene.xml\n"
      "  duet info old.xml -D spp=16 --xml > new.xml");
  c->callback([o, &exit_code] { exit_code = info(*o); });
}

}  // namespace duet
