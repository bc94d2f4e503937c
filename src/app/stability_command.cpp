// duet stability: every method on the scenes where methods fail.
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <sstream>

#include "app/arguments.h"
#include "app/commands.h"
#include "app/program.h"
#include "base/diagnostics.h"
#include "base/system/atomic_file.h"
#include "base/system/signals.h"
#include "evaluate/render/output.h"
#include "evaluate/render/output_checks.h"
#include "evaluate/stability/run.h"
#include "evaluate/stability/selection.h"

namespace duet {

namespace {

using namespace stability;

struct StabilityOptions {
  std::vector<std::string> cases;
  std::string methods, markdown, html, json, folder, threads;
  bool fast = false, list = false, quiet = false;
};

/// The page that is to be brought up to date, if only a part of the table is measured.
std::string earlier_page(const StabilityOptions& o) {
  if (o.markdown.empty() || (o.cases.empty() && o.methods.empty() && !o.fast)) return "";
  std::ifstream file(o.markdown);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (text.empty() && !o.methods.empty())
    throw UsageError(fmt::format(
        "--markdown writes the columns of all methods, and {} is not there to take those "
        "of the others from: leave --methods away",
        o.markdown));
  return text;
}

/// The command that makes the whole page again.
std::string whole_command(const StabilityOptions& o) {
  return fmt::format("duet stability{}{} --markdown {}", o.fast ? " --fast" : "",
                     o.folder.empty() ? "" : " --catalogue " + o.folder, o.markdown);
}

/// The names in a list with commas.
std::vector<std::string> names_of(const std::string& list) {
  std::vector<std::string> names;
  std::istringstream text(list);
  for (std::string name; std::getline(text, name, ',');) names.push_back(name);
  return names;
}

/// What `select` finds; that there is nothing of the kind is wrong usage.
template <class Select>
auto selected(Select select) {
  try {
    return select();
  } catch (const std::out_of_range& e) {
    throw UsageError(e.what());
  }
}

/// Prints what is found as soon as it is.
RunEvents printed(size_t rows, Log& log) {
  RunEvents events;
  events.row = [rows, &log](const Row& row, size_t number) {
    if (row.planned.empty())
      log.info("[{}/{}] {}: {}", number, rows, row.name, row.title);
    else
      fmt::print("{:>3} {:22} planned: {}\n", row.number, row.name, row.planned);
  };
  events.judged = [](const Row& row, const CellResult& cell) {
    fmt::print("{}\n", result_line(row, cell));
    std::fflush(stdout);
  };
  events.cancelled = [] { return interrupt_exit_code() != 0; };
  return events;
}

int run_stability(const StabilityOptions& o, Program& program) {
  const Catalogue catalogue = read_catalogue(o.folder.empty() ? catalogue_folder() : o.folder);
  const Selection selection{selected([&] { return select_rows(catalogue, o.cases, o.fast); }),
                            selected([&] { return select_methods(names_of(o.methods)); }), o.fast};
  check_writable("--markdown", o.markdown);
  check_writable("--html", o.html);
  check_writable("--json", o.json);
  const std::string earlier = earlier_page(o);
  if (o.list) {
    fmt::print("{}", row_list(selection.rows));
    return kSuccess;
  }
  const int threads =
      o.threads.empty() ? program.threads() : int(parse_whole("--threads", o.threads, 1, 4096));
  if (o.quiet) program.log.set_level(Log::Level::quiet);
  install_signal_handlers();
  std::vector<RowResult> results;
  try {
    results = run(catalogue, selection, threads, printed(selection.rows.size(), program.log));
  } catch (const Laboratory::Cancelled&) {
    program.log.warning("interrupted: the table is not complete, and no file is written");
    return interrupt_exit_code();
  }
  if (!o.markdown.empty())
    write_file_atomically(o.markdown, markdown(catalogue, results, whole_command(o), earlier));
  if (!o.html.empty())
    write_file_atomically(o.html, page(catalogue, results, o.fast, program.command_line));
  if (!o.json.empty()) write_file_atomically(o.json, json(results));
  fmt::print("{}", summary(results, o.fast));
  program.log.info("measured in {:.0f} s", seconds_of(results));
  return is_as_expected(results) ? kSuccess : kSceneFailed;
}

}  // namespace

void add_stability_command(CLI::App& app, Program& program) {
  CLI::App* c = app.add_subcommand(
      "stability", "Run every method on the scenes where methods fail, and judge what comes out");
  const auto o = std::make_shared<StabilityOptions>();
  c->add_option("case", o->cases, "Rows of the catalogue, by name or number (default: all)");
  c->add_flag("--fast", o->fast, "Only those that together take less than a minute");
  c->add_option("--methods", o->methods, "Only these, such as path,bdpt");
  c->add_flag("--list", o->list, "Name the rows and run nothing");
  c->add_option(
      "--markdown", o->markdown,
      "Also write the table as docs/stability.md has it; if only some rows or methods are "
      "run, the others of a page that is there stay");
  c->add_option("--html", o->html,
                "Write a report of what is run that opens in a browser, with what each cell would "
                "have noticed");
  c->add_option("--json", o->json, "Also write it for programs");
  c->add_option("--catalogue", o->folder,
                "Folder with another catalogue.json and the scenes that it names")
      ->check(CLI::ExistingDirectory);
  c->add_option("-t,--threads", o->threads, "Threads (default: all); the table is the same");
  c->add_flag("-q,--quiet", o->quiet, "No progress on standard error");
  c->footer(
      "Every method is expected to hold, to fail as known, or not to apply (docs/stability.md).\n"
      "Every cell states the smallest deviation that it would have noticed; one that would miss "
      "too\n"
      "much is not resolved, and counts as a failure.\n"
      "Exit codes: 0 all as expected; 1 something is not; 2 wrong usage; 130/143 interrupted.\n"
      "Examples:\n"
      "  duet stability --fast --html stability.html\n"
      "  duet stability point-light-mirror 27 --methods bdpt,vcm\n"
      "  duet stability --markdown docs/stability.md --json stability.json");
  c->callback([o, &program] { program.exit_code = run_stability(*o, program); });
}

}  // namespace duet
