// duet plugins: what is understood in scene files.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "app/commands.h"
#include "app/program.h"
#include "base/diagnostics.h"
#include "evaluate/report/vocabulary_text.h"
#include "mitsuba/vocabulary.h"
#include "pbrt/vocabulary.h"
#include "scene/mitsuba_differences.h"

namespace duet {

namespace {

int list_plugins(const std::string& kind_name, bool markdown) {
  if (markdown) {
    if (!kind_name.empty()) throw UsageError("--markdown prints all kinds; name none");
    fmt::print("{}\n{}", compatibility_markdown(), mitsuba_differences_markdown());
    return kSuccess;
  }
  std::vector<std::string> tags = tags_within_scenes();
  if (!kind_name.empty()) {
    if (std::find(tags.begin(), tags.end(), kind_name) == tags.end())
      throw UsageError(fmt::format("there is no kind \"{}\"{}; there are {}", kind_name,
                                   did_you_mean(kind_name, tags), fmt::join(tags, " ")));
    tags = {kind_name};
  }
  for (const std::string& tag : tags) fmt::print("{}", plugin_list(*kind_of_tag(tag)));
  return kSuccess;
}

}  // namespace

void add_plugins_command(CLI::App& app, Program& program) {
  CLI::App* c = app.add_subcommand("plugins", "List the plugins and parameters of scene files");
  struct Options {
    std::string kind;
    bool markdown = false, pbrt = false;
  };
  const auto o = std::make_shared<Options>();
  c->add_option("kind", o->kind, "Only these: bsdf, shape, emitter, sensor, ... (default: all)");
  c->add_flag("--markdown", o->markdown, "Print docs/compatibility.md");
  c->add_flag("--pbrt", o->pbrt, "Print docs/pbrt.md: what is read of pbrt's files");
  c->footer(
      "Each line says what becomes of a name: done; approximated; no effect, because it changes "
      "nothing that Duet does; ignored with a warning; refused, which is an error.\n"
      "Examples:\n"
      "  duet plugins bsdf\n"
      "  duet plugins --markdown > docs/compatibility.md");
  c->callback([o, &program] {
    if (o->pbrt) {
      if (!o->kind.empty() || o->markdown)
        throw UsageError("--pbrt prints all kinds as Markdown; name none");
      fmt::print("{}", pbrt::vocabulary_markdown());
      return;
    }
    program.exit_code = list_plugins(o->kind, o->markdown);
  });
}

}  // namespace duet
