#include <fmt/format.h>

#include <algorithm>

#include "evaluate/shell/command_table.h"

namespace duet {

namespace {

/// Calls `what` for all options of a command.
template <class F>
void for_options(const ShellCommand& command, const F& what) {
  for (const ShellOptionGroup& group : command.groups)
    for (const ShellOption& option : group.options) what(option);
}

std::vector<std::string> names_of(const CommandTable& table) {
  std::vector<std::string> names;
  for (const ShellCommand& c : table.commands) names.push_back(c.name);
  return names;
}

/// With a backslash before each of the characters.
std::string escaped(std::string_view text, std::string_view characters) {
  std::string out;
  for (const char c : text) {
    if (characters.find(c) != characters.npos) out += '\\';
    out += c;
  }
  return out;
}

/// Up to the first end of a sentence or a colon: what fits beside the name of an option.
std::string_view short_text(std::string_view text) {
  size_t end = std::min(text.find(';'), text.find(": "));
  end = std::min({end, text.find(". "), text.find(" (default"), text.size()});
  return text.substr(0, end);
}

std::string in_single_quotes(std::string_view text) {
  std::string out = "'";
  for (const char c : text)
    if (c == '\'')
      out += "'\\''";
    else
      out += c;
  return out + "'";
}

std::string bash_cases(const ShellCommand& command) {
  std::string choices;
  std::vector<std::string> all, with_value;
  for_options(command, [&](const ShellOption& o) {
    all.insert(all.end(), o.names.begin(), o.names.end());
    if (o.value.empty()) return;
    if (o.choices.empty())
      with_value.insert(with_value.end(), o.names.begin(), o.names.end());
    else
      choices += fmt::format("        {}) words='{}'{} ;;\n", fmt::join(o.names, "|"),
                             fmt::join(o.choices, " "), o.list ? " before=$list" : "");
  });
  // After an option with any value: files, by bash itself.
  if (!with_value.empty())
    choices += fmt::format("        {}) return ;;\n", fmt::join(with_value, "|"));
  return fmt::format(
      "    {})\n      case $previous in\n{}"
      "        *) if [[ $current == -* ]]; then words='{}'; else words='{}'; fi ;;\n"
      "      esac ;;\n",
      command.name, choices, fmt::join(all, " "), fmt::join(command.operand_choices, " "));
}

std::string zsh_option(const ShellOption& o) {
  const std::string text = escaped(short_text(o.text), "[]:\\");
  std::string value;
  if (!o.value.empty()) {
    const std::string choices = fmt::format("{}", fmt::join(o.choices, " "));
    value = choices.empty() ? ":value:_files"
            : o.list        ? ":value:_values -s , value " + choices
                            : ":value:(" + choices + ")";
  }
  std::string lines;
  for (const std::string& name : o.names)
    lines += fmt::format("        {}\n",
                         in_single_quotes(fmt::format(
                             "*{}{}[{}]{}", name,
                             !o.value.empty() && name.starts_with("--") ? "=" : "", text, value)));
  return lines;
}

/// The beginning of a line of fish for what a command may have.
std::string fish_line(const CommandTable& table, const ShellCommand& command) {
  std::vector<std::string> where = {command.name};
  if (command.name == table.implied) {
    where = names_of(table);
    std::erase(where, table.implied);
  }
  return fmt::format("complete -c {} -n '{}__fish_seen_subcommand_from {}'", table.program,
                     command.name == table.implied ? "not " : "", fmt::join(where, " "));
}

std::string fish_option(const CommandTable& table, const ShellCommand& command,
                        const ShellOption& o) {
  std::string line = fish_line(table, command);
  for (const std::string& name : o.names)
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!o.value.empty()) line += " -r";
  const std::string choices = fmt::format("{}", fmt::join(o.choices, " "));
  if (!choices.empty())
    line += " -f -a '" + (o.list ? "(__fish_append , " + choices + ")" : choices) + "'";
  return line + fmt::format(" -d '{}'\n", escaped(short_text(o.text), "'\\"));
}

}  // namespace

std::string bash_completion(const CommandTable& t) {
  const std::vector<std::string> names = names_of(t);
  std::string cases;
  for (const ShellCommand& c : t.commands) cases += bash_cases(c);
  return fmt::format(
      "# Completion of {0} for bash; made by `{0} completion bash`.\n"
      "_{0}() {{\n"
      "  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} "
      "words='' before=''\n"
      "  # Of a list what is before its last element; what is completed is that element.\n"
      "  local list=${{current%\"${{current##*,}}\"}}\n"
      "  local command={1}\n"
      "  case ${{COMP_WORDS[1]}} in\n    {2}|help) command=${{COMP_WORDS[1]}} ;;\n  esac\n"
      "  ((COMP_CWORD == 1)) && command=\n"
      "  COMPREPLY=()\n"
      "  case $command in\n"
      "    '')\n      if [[ $current == -* ]]; then words='--help --version'; else words='{3} "
      "help'; fi ;;\n"
      "    help) words='{3}' ;;\n{4}"
      "  esac\n"
      "  COMPREPLY=($(compgen -P \"$before\" -W \"$words\" -- \"${{current#\"$before\"}}\"))\n"
      "}}\n"
      "complete -o bashdefault -o default -F _{0} {0}\n",
      t.program, t.implied, fmt::join(names, "|"), fmt::join(names, " "), cases);
}

std::string zsh_completion(const CommandTable& t) {
  std::string commands, cases;
  for (const ShellCommand& c : t.commands) {
    commands += fmt::format("    {}\n", in_single_quotes(fmt::format(
                                            "{}:{}", c.name, escaped(short_text(c.text), ":\\"))));
    std::string options;
    for_options(c, [&](const ShellOption& o) { options += zsh_option(o); });
    cases += fmt::format("    {})\n      _arguments -S \\\n", c.name);
    for (size_t at = 0; at < options.size();) {
      const size_t end = options.find('\n', at);
      cases += options.substr(at, end - at) + " \\\n";
      at = end + 1;
    }
    cases += c.operand_choices.empty()
                 ? "        '*:file:_files' ;;\n"
                 : fmt::format("        '*:name:({})' ;;\n", fmt::join(c.operand_choices, " "));
  }
  return fmt::format(
      "#compdef {0}\n"
      "# Completion of {0} for zsh; made by `{0} completion zsh`.\n"
      "_{0}() {{\n"
      "  local -a commands=(\n{1}  )\n"
      "  if ((CURRENT == 2)); then\n"
      "    _describe command commands\n    _files\n    return\n  fi\n"
      "  local command=${{words[2]}}\n"
      "  if ((${{commands[(I)$command:*]}})); then\n    shift words\n    ((CURRENT--))\n"
      "  else\n    command={2}\n  fi\n"
      "  case $command in\n{3}  esac\n"
      "}}\n"
      "_{0} \"$@\"\n",
      t.program, commands, t.implied, cases);
}

std::string fish_completion(const CommandTable& t) {
  std::string text =
      fmt::format("# Completion of {0} for fish; made by `{0} completion fish`.\n", t.program);
  for (const ShellCommand& c : t.commands)
    text += fmt::format("complete -c {} -n __fish_use_subcommand -a {} -d '{}'\n", t.program,
                        c.name, escaped(short_text(c.text), "'\\"));
  for (const ShellCommand& c : t.commands) {
    if (!c.operand_choices.empty())
      text += fmt::format("{} -f -a '{}'\n", fish_line(t, c), fmt::join(c.operand_choices, " "));
    for_options(c, [&](const ShellOption& o) { text += fish_option(t, c, o); });
  }
  return text;
}

}  // namespace duet
