#include "support/browser.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "support/files.h"

namespace duet::test {

namespace {

// A document that is open delays the load event of the one that contains it.
constexpr const char* kHelpers = R"(
const open_document = document.body.appendChild(document.createElement("iframe")).contentDocument;
open_document.open();
const finish = (value) => {
  document.title = JSON.stringify(value);
  open_document.close();
};
const when = (condition, action) => condition() ? action() : setTimeout(when, 10, condition, action);
)";

// No services of a desktop, no network, no settings of another run.
constexpr const char* kOptions =
    " --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --disable-quic --no-first-run"
    " --disable-background-networking --disable-component-update --disable-sync"
    " --enable-logging=stderr --dump-dom";

bool is_program(const std::string& name) {
  return std::system(("command -v '" + name + "' >/dev/null 2>&1").c_str()) == 0;
}

}  // namespace

std::string browser() {
  if (const char* chosen = std::getenv("DUET_BROWSER"))
    return std::string(chosen) == "none" ? "" : chosen;
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (is_program(name)) return name;
  throw std::runtime_error(
      "there is no chromium or google-chrome: install one, name one in DUET_BROWSER, or set "
      "DUET_BROWSER=none to do without the tests of pages");
}

std::string with_script(std::string page, const std::string& script) {
  const size_t end = page.rfind("</body>");
  if (end == std::string::npos) throw std::runtime_error("the page has no </body>");
  page.insert(end, std::string("<script>") + kHelpers + script + "</script>");
  return page;
}

DrivenPage drive_page(const std::string& browser, std::string page, const std::string& script,
                      const std::string& folder) {
  const std::string driven = std::filesystem::absolute(folder) / "driven.html";
  std::ofstream(driven) << with_script(std::move(page), script);
  return drive_url(browser, "file://" + driven, folder);
}

DrivenPage drive_url(const std::string& browser, const std::string& url,
                     const std::string& folder) {
  const std::filesystem::path root = std::filesystem::absolute(folder);
  const std::string dom = root / "dom.html", log = root / "log.txt";
  const int status =
      std::system(("timeout 300 '" + browser + "'" + kOptions + " --user-data-dir='" +
                   (root / "profile").string() + "' '" + url + "' >'" + dom + "' 2>'" + log + "'")
                      .c_str());
  if (status != 0) throw std::runtime_error("the browser failed: " + read_file(log));
  const std::string text = read_file(dom);
  const size_t from = text.find("<title>") + 7;
  DrivenPage outcome{text.substr(from, text.find("</title>") - from), ""};
  std::istringstream lines(read_file(log));
  for (std::string line; std::getline(lines, line);)
    if (line.find("CONSOLE") != std::string::npos) outcome.console += line + "\n";
  return outcome;
}

}  // namespace duet::test
