// duet view: an image file in the viewer of the reports.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "app/commands.h"
#include "app/program.h"
#include "base/atomic_file.h"
#include "base/run_program.h"
#include "evaluate/render/output.h"
#include "evaluate/web/image_page.h"

namespace duet {

namespace {

namespace fs = std::filesystem;

struct ViewOptions {
  std::string image, page;
};

/// Where the page of an image goes that is to be looked at now. It must stay for as long as it is
/// open, so it is left to whatever clears that folder.
std::string temporary_page(const std::string& image) {
  std::string folder = (fs::temp_directory_path() / "duet-view-XXXXXX").string();
  if (!mkdtemp(folder.data())) throw std::system_error(errno, std::generic_category(), folder);
  return (fs::path(folder) / fs::path(image).filename()).string() + ".html";
}

/// Opens a page as the desktop does, without waiting until it is closed.
void open_page(const std::string& opener, const std::string& page) {
  const ProgramEnd end = run_program({find_program("setsid"), "--fork", opener, page});
  if (end.exit_code != 0)
    throw std::runtime_error(fmt::format("xdg-open cannot be started: {}", end.err));
}

int view(const ViewOptions& o, Program& program) {
  try {
    const std::string html = image_page(o.image, load_linear(o.image));
    if (!o.page.empty()) {
      if (const std::string why = prepare_file(o.page); !why.empty())
        throw std::runtime_error(fmt::format("cannot write {}: {}", o.page, why));
      write_file_atomically(o.page, html);
      return kSuccess;
    }
    const std::string opener = find_program("xdg-open");
    if (opener.empty())
      throw std::runtime_error("there is no xdg-open, which opens pages; -o PAGE writes one");
    const std::string page = temporary_page(o.image);
    write_file_atomically(page, html);
    program.log.info("{} -> {}", o.image, page);
    open_page(opener, page);
    return kSuccess;
  } catch (const std::exception& e) {
    program.log.error("{}: {}", o.image, e.what());
  }
  return kSceneFailed;
}

}  // namespace

void add_view_command(CLI::App& app, Program& program) {
  CLI::App* c = app.add_subcommand("view", "Look at an image in a browser");
  const auto o = std::make_shared<ViewOptions>();
  c->add_option("image", o->image, "OpenEXR, PNG, JPEG, HDR, TIFF, PFM, ...")->required();
  c->add_option("-o,--output", o->page, "Write the page to this file, and open nothing");
  c->footer(
      "The page is one file, which needs no network: layers, exposure, zoom, the values of pixels "
      "and what the header says.\n"
      "Examples:\n"
      "  duet view cornell.exr               opened by xdg-open\n"
      "  duet view cornell.exr -o page.html  to keep or to send");
  c->callback([o, &program] { program.exit_code = view(*o, program); });
}

}  // namespace duet
