#include <fmt/format.h>

#include <algorithm>

#include "evaluate/shell/command_table.h"

namespace duet {

namespace {

/// A line of text: nothing in it is a macro or an escape, and hyphens can be copied as such.
std::string roff(std::string_view text) {
  std::string out;
  if (text.starts_with('.') || text.starts_with('\'')) out += "\\&";
  for (const char c : text)
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  return out;
}

std::string option_text(const ShellOption& o) {
  std::string names;
  for (const std::string& name : o.names) names += (names.empty() ? "" : ", ") + roff(name);
  std::string value = o.value;
  if (!o.choices.empty() && !o.list) value = fmt::format("{}", fmt::join(o.choices, "|"));
  if (!value.empty()) value = " \\fI" + roff(value) + "\\fR";
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", names, value, roff(o.text));
}

/// Lines as they are.
std::string lines_of(const std::string& text) {
  std::string out = ".nf\n";
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    out += roff(std::string_view(text).substr(at, end - at)) + "\n";
    at = end + 1;
  }
  return out + ".fi\n";
}

std::string command_section(const CommandTable& table, const ShellCommand& c) {
  std::string text = fmt::format(".SS {} {}\n{}\n", table.program, c.name, roff(c.text));
  for (const ShellOptionGroup& group : c.groups) {
    text += fmt::format(".PP\n\\fI{}\\fR\n", roff(group.name));
    for (const ShellOption& o : group.options) text += option_text(o);
  }
  if (!c.footer.empty()) text += ".PP\n" + lines_of(c.footer);
  return text;
}

std::string list_section(const char* title,
                         const std::vector<std::pair<std::string, std::string>>& list) {
  std::string text = fmt::format(".SH {}\n", title);
  for (const auto& [name, what] : list)
    text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", name, roff(what));
  return text;
}

}  // namespace

std::string manual_page(const CommandTable& t) {
  std::string text =
      fmt::format(".TH {0} 1 \"\" \"{0} {1}\"\n.SH NAME\n{0} \\- {2}\n.SH SYNOPSIS\n", t.program,
                  t.version, roff(t.text));
  for (const ShellCommand& c : t.commands)
    text += fmt::format(".B {} {}\n[\\fIoptions\\fR] \\fI{}\\fR\n.br\n", t.program, c.name,
                        roff(c.operands));
  text += ".SH COMMANDS\n";
  for (const ShellCommand& c : t.commands) text += command_section(t, c);
  return text + list_section("ENVIRONMENT", t.environment) +
         list_section("EXIT STATUS", t.exit_status);
}

}  // namespace duet
