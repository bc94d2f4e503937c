#include "evaluate/web/browser.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "base/system/files.h"
#include "base/system/run_program.h"

namespace duet {

namespace fs = std::filesystem;

std::string page_opener() {
  return find_program("xdg-open");
}

std::string temporary_page(const std::string& file) {
  std::error_code error;
  const std::string folder =
      make_temporary_folder((fs::temp_directory_path() / "duet-view-").string(), error);
  if (error) throw std::system_error(error, folder);
  return (fs::path(folder) / fs::path(file).filename()).string() + ".html";
}

void open_page(const std::string& opener, const std::string& page) {
  const ProgramEnd end = run_program({find_program("setsid"), "--fork", opener, page});
  if (end.exit_code != 0)
    throw std::runtime_error(fmt::format("{} cannot be started: {}", opener, end.err));
}

}  // namespace duet
