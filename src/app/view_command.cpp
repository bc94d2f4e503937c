// duet view: an image file in the viewer of the reports.
#include <CLI/CLI.hpp>
#include <iostream>

#include "app/commands.h"
#include "app/program.h"
#include "base/system/atomic_file.h"
#include "evaluate/render/file_uses.h"
#include "evaluate/render/output.h"
#include "evaluate/web/browser.h"
#include "evaluate/web/image_page.h"

namespace duet {

namespace {

struct ViewOptions {
  std::string image, page;
};

int view(const ViewOptions& o, Program& program) {
  FileUses uses;
  uses.read("the image", o.image);
  uses.write("-o", o.page);
  try {
    const std::string html = image_page(o.image, load_linear(o.image));
    if (o.page == "-") {
      std::cout << html;
      return kSuccess;
    }
    if (!o.page.empty()) {
      if (const std::string why = prepare_file(o.page); !why.empty()) throw std::runtime_error(why);
      write_file_atomically(o.page, html);
      return kSuccess;
    }
    const std::string opener = page_opener();
    if (opener.empty())
      throw std::runtime_error("there is no xdg-open, which opens pages; -o PAGE writes one");
    const std::string page = temporary_page(o.image);
    write_file_atomically(page, html);
    program.log.info("{} -> {}", o.image, page);
    open_page(opener, page);
    return kSuccess;
  } catch (const std::exception& e) {
    // What is wrong with a file says which.
    program.log.error("{}", e.what());
  }
  return kSceneFailed;
}

}  // namespace

void add_view_command(CLI::App& app, Program& program) {
  CLI::App* c = app.add_subcommand("view", "Look at an image in a browser");
  const auto o = std::make_shared<ViewOptions>();
  c->add_option("image", o->image, "OpenEXR, PNG, JPEG, HDR, TIFF, PFM, ...")->required();
  c->add_option("-o,--output", o->page,
                "Write the page to this file, - is standard output, and open nothing");
  c->footer(
      "The page is one file, which needs no network: layers, exposure, zoom, the values of pixels "
      "and what the header says.\n"
      "Examples:\n"
      "  duet view cornell.exr               opened by xdg-open\n"
      "  duet view cornell.exr -o page.html  to keep or to send");
  c->callback([o, &program] { program.exit_code = view(*o, program); });
}

}  // namespace duet
