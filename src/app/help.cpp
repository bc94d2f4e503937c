#include "app/help.h"

#include <algorithm>

#include "base/system/standard_streams.h"
#include "base/terminal.h"

namespace duet {

namespace {

/// Narrower or wider lines cannot be read.
constexpr size_t kLeastWidth = 60, kMostWidth = 100;
constexpr size_t kNameColumns = 26;

/// The text's words; spaces in quotes part none if `is_command`.
std::vector<std::string> words_of(std::string_view text, bool is_command) {
  std::vector<std::string> words{""};
  bool is_quoted = false;
  for (const char c : text) {
    is_quoted ^= is_command && c == '\'';
    if (c == ' ' && !is_quoted)
      words.emplace_back();
    else
      words.back() += c;
  }
  return words;
}

/// Breaks a text that begins in column `column` into lines of at most `width` columns; longer words
/// stand alone. All lines but the last end with `line_end`, all but the first begin in `indent`.
std::string wrapped(std::string_view text, size_t width, size_t column, size_t indent,
                    const std::string& line_end = "") {
  std::string out;
  bool is_first = true;
  for (const std::string& word : words_of(text, !line_end.empty())) {
    if (!is_first && column + 1 + columns(word) + line_end.size() > width) {
      out += line_end + "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!is_first) {
      out += ' ';
      ++column;
    }
    is_first = false;
    out += word;
    column += columns(word);
  }
  return out;
}

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (size_t at = 0; (at = text.find(what, at)) != std::string::npos;)
    text.replace(at, what.size(), by);
}

}  // namespace

HelpFormatter::HelpFormatter()
    : width_(std::clamp(terminal_width(StandardStream::output), kLeastWidth, kMostWidth)) {
  column_width(kNameColumns);
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name,
                                     CLI::AppFormatMode mode) const {
  std::string text = Formatter::make_help(app, std::move(name), mode);
  replace_all(text, "\n\n\n", "\n\n");
  return text;
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
  return wrapped(app->get_description(), width_, 0, 0) + "\n";
}

std::string HelpFormatter::entry(const std::string& name, const std::string& text) const {
  std::string start = "  " + name;
  if (columns(start) + 2 <= kNameColumns)
    start.resize(start.size() + kNameColumns - columns(start), ' ');
  else
    start += "\n" + std::string(kNameColumns, ' ');
  return start + wrapped(text, width_, kNameColumns, kNameColumns) + "\n";
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  std::string name = make_option_name(option, is_positional) + make_option_opts(option);
  replace_all(name, "{false}", "");
  // What it excludes is said when both are given, and how often it may be given is in its text.
  for (const char* detail : {" Excludes:", " REQUIRED", " ..."})
    name.resize(std::min(name.size(), name.find(detail)));
  return entry(name, make_option_desc(option));
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  return entry(command->get_name(), command->get_description());
}

std::string HelpFormatter::footer_line(std::string_view line) const {
  if (columns(line) <= width_) return std::string(line);
  const size_t start = std::min(line.find_first_not_of(' '), line.size());
  const size_t gap = line.find("  ", start);
  const size_t column = gap == line.npos ? start : line.find_first_not_of(' ', gap);
  const bool is_command = gap == line.npos && line.starts_with("  duet ");
  return std::string(line.substr(0, column)) + wrapped(line.substr(column), width_, column,
                                                       column + (is_command ? 4 : 0),
                                                       is_command ? " \\" : "");
}

std::string HelpFormatter::make_footer(const CLI::App* app) const {
  std::string text;
  const std::string footer = app->get_footer();
  for (size_t from = 0; from < footer.size();) {
    const size_t to = std::min(footer.find('\n', from), footer.size());
    text += footer_line(std::string_view(footer).substr(from, to - from)) + "\n";
    from = to + 1;
  }
  return text;
}

}  // namespace duet
