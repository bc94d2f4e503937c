// duet completion: what shells and man want to know of the command line, from the tables of its
// parser.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands.h"
#include "app/environment.h"
#include "app/program.h"
#include "evaluate/shell/command_table.h"
#include "integrators/layers.h"
#include "integrators/make_integrator.h"
#include "mitsuba/vocabulary.h"

namespace duet {

namespace {

/// What an option or an operand may be, if little else may.
std::vector<std::string> choices_of(const CLI::Option& option, const std::string& name) {
  if (name == "--integrator") {
    std::vector<std::string> names;
    for (const IntegratorName& n : integrator_names()) names.emplace_back(n.name);
    return names;
  }
  if (name == "--aov") return layer_names();
  if (name == "kind") return tags_within_scenes();
  // "TEXT:{auto,bar}"
  const std::string type = option.get_type_name();
  const size_t open = type.find('{'), close = type.find('}', open);
  if (close == type.npos) return {};
  return CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
}

ShellOption shell_option(const CLI::Option& option) {
  ShellOption o;
  for (const std::string& name : option.get_snames()) o.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) o.names.push_back("--" + name);
  o.text = option.get_description();
  if (option.get_type_size_max() == 0) return o;
  const std::string type = option.get_type_name();
  o.value = type.substr(0, type.find(':'));
  o.choices = choices_of(option, o.names.back());
  o.list = option.get_delimiter() != 0;
  return o;
}

ShellCommand shell_command(const CLI::App& app) {
  ShellCommand c{app.get_name(), app.get_description(), "", {}, {}, app.get_footer()};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) {
      c.operands += (c.operands.empty() ? "" : " ") + option->get_name();
      if (option->get_expected_max() > 1) c.operands += "...";
      c.operand_choices = choices_of(*option, option->get_name());
      continue;
    }
    if (option->get_group().empty()) continue;
    if (c.groups.empty() || c.groups.back().name != option->get_group())
      c.groups.push_back({option->get_group(), {}});
    c.groups.back().options.push_back(shell_option(*option));
  }
  return c;
}

CommandTable command_table(const CLI::App& app) {
  CommandTable table{
      app.get_name(), DUET_VERSION, "renders Mitsuba and pbrt scenes", {}, "render", {}, {}};
  for (const CLI::App* c : app.get_subcommands([](const CLI::App*) { return true; }))
    table.commands.push_back(shell_command(*c));
  for (const auto& [name, what] : kEnvironment) table.environment.emplace_back(name, what);
  for (const auto& [codes, meaning] : kExitStatus) table.exit_status.emplace_back(codes, meaning);
  return table;
}

}  // namespace

void add_completion_command(CLI::App& app) {
  CLI::App* c =
      app.add_subcommand("completion", "Print completions for a shell, or the manual page");
  const auto kind = std::make_shared<std::string>();
  c->add_option("shell", *kind, "bash, zsh, fish or man")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish", "man"}));
  c->footer(
      "Packages install what it prints. Without one:\n"
      "  duet completion bash > ~/.local/share/bash-completion/completions/duet\n"
      "  duet completion zsh > ~/.zfunc/_duet    a folder of $fpath\n"
      "  duet completion fish > ~/.config/fish/completions/duet.fish\n"
      "  duet completion man | man -l -");
  c->callback([&app, kind] {
    const CommandTable table = command_table(app);
    fmt::print("{}", *kind == "bash"   ? bash_completion(table)
                     : *kind == "zsh"  ? zsh_completion(table)
                     : *kind == "fish" ? fish_completion(table)
                                       : manual_page(table));
  });
}

}  // namespace duet
