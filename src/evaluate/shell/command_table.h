// The commands of a program and their options as data, from which completions and the manual page
// are made.
#pragma once

#include <string>
#include <vector>

namespace duet {

struct ShellOption {
  std::vector<std::string> names;    ///< "-t", "--threads"
  std::string value;                 ///< what follows, such as "TEXT"; empty for flags
  std::vector<std::string> choices;  ///< what may follow, if little else may
  bool list = false;                 ///< whether several may, between commas
  std::string text;                  ///< what it is for
};

struct ShellOptionGroup {
  std::string name;
  std::vector<ShellOption> options;
};

struct ShellCommand {
  std::string name;
  std::string text;
  std::string operands;                      ///< "scene..."
  std::vector<std::string> operand_choices;  ///< what they may be; empty for files
  std::vector<ShellOptionGroup> groups;
  std::string footer;  ///< further text and examples, in lines
};

struct CommandTable {
  std::string program, version;
  std::string text;
  std::vector<ShellCommand> commands;
  /// The command whose name may be left out.
  std::string implied;
  /// Environment variables and what they are for.
  std::vector<std::pair<std::string, std::string>> environment;
  /// Exit codes and what they mean.
  std::vector<std::pair<std::string, std::string>> exit_status;
};

/// Completion scripts. bash's needs no package but bash itself.
std::string bash_completion(const CommandTable& table);
std::string zsh_completion(const CommandTable& table);
std::string fish_completion(const CommandTable& table);
/// The page of section 1, in the macros of man(7).
std::string manual_page(const CommandTable& table);

}  // namespace duet
