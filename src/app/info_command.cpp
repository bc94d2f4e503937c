// duet info: what a scene contains.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/program.h"
#include "app/read_options.h"
#include "evaluate/render/output.h"
#include "evaluate/render/scene_operand.h"
#include "evaluate/report/scene_json.h"
#include "evaluate/report/scene_summary.h"
#include "integrators/make_integrator.h"
#include "mitsuba/writer.h"

namespace duet {

namespace {

struct InfoOptions {
  ReadOptions read;
  std::string method;
  bool xml = false, json = false, all = false;
};

/// The scene as it is rendered with the method, if there is one.
void use_method(SceneDescription& description, const std::string& method) {
  try {
    apply_override(description.integrator, {method, {}, {}});
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
}

void print_xml(const std::string& file, const LoadedScene& scene, bool strict, Log& log) {
  const MitsubaXml xml = write_mitsuba_xml(scene.description);
  for (const std::string& loss : xml.losses) log.warning("{}: {}", file, loss);
  fmt::print("{}", xml.text);
  if (strict && !xml.losses.empty()) throw SceneFailure(xml.losses[0], true);
}

int info(InfoOptions o, Program& program) {
  Log& log = program.log;
  if (o.all) log.set_level(Log::Level::verbose);
  if (!o.method.empty()) o.read.methods = {o.method};
  if (o.xml && o.read.scenes.size() > 1)
    throw UsageError("--xml writes one scene; several were given");
  o.read.standard_input = read_standard_input(o.read.scenes);
  check_defines(o.read);
  bool failed = false;
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const std::string& file : o.read.scenes) {
    try {
      LoadedScene scene = load_scene(file, o.read, log);
      use_method(scene.description, o.method);
      if (o.json)
        all.push_back(scene_json(file, output_names(file).scene, scene));
      else if (o.xml)
        print_xml(file, scene, o.read.strict, log);
      else
        fmt::print("{}", scene_summary(scene, o.all));
    } catch (const SceneFailure& e) {
      if (!e.is_printed()) log.error("{}: {}", file, e.what());
      if (o.json) all.push_back({{"file", file}, {"error", e.what()}});
      failed = true;
    }
  }
  if (o.json) fmt::print("{}\n", json_text(all.size() == 1 ? all[0] : all));
  return failed ? kSceneFailed : kSuccess;
}

}  // namespace

void add_info_command(CLI::App& app, Program& program) {
  CLI::App* c = app.add_subcommand("info", "Say what scenes contain and how they are modelled");
  const auto o = std::make_shared<InfoOptions>();
  add_read_options(*c, o->read);
  c->add_option("-i,--integrator", o->method, "Method instead of the scene's, as when rendering");
  c->add_flag("-v,--verbose", o->all, "List everything, however much there is");
  CLI::Option* xml =
      c->add_flag("--xml", o->xml,
                  "Print the scene as a Mitsuba 3 file, with all parameters replaced, instead");
  c->add_flag("--json", o->json,
              "Print all of it as JSON: an object, or an array of them for several scenes")
      ->excludes(xml);
  c->footer(
      "Nothing is rendered; of images only the sizes are read. \"memory\" is what a render takes "
      "at "
      "most, estimated. What a scene asks for and Duet renders in another "
      "way is listed under \"approximated\"; what Mitsuba is known to render wrongly, under "
      "\"differs from Mitsuba\".\n"
      "Examples:\n"
      "  duet info cornell.xml\n"
      "  duet info scenes/*/scene.xml\n"
      "  duet info cornell.xml --json | jq .sensors[0].spp\n"
      "  duet info old.xml -D spp=16 --xml > new.xml");
  c->callback([o, &program] { program.exit_code = info(*o, program); });
}

}  // namespace duet
