// How --help looks.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

namespace duet {

/// Fits help to the width of the terminal. In the footer, what follows several spaces within a line
/// is continued in its column, and a line "  duet …" without them is a command, which is continued
/// with a backslash.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_footer(const CLI::App* app) const override;

 private:
  std::string entry(const std::string& name, const std::string& text) const;
  std::string footer_line(std::string_view line) const;

  size_t width_;
};

}  // namespace duet
