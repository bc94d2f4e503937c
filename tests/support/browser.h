// Drives a page of a report in a headless browser, the way a user would.
#pragma once

#include <string>

namespace duet::test {

/// The browser that tests use: the program in the environment variable DUET_BROWSER if that is set,
/// else chromium, chromium-browser or google-chrome. "" if DUET_BROWSER is "none". Throws
/// std::runtime_error, which says what to do, if there is no browser: a test must not pass because
/// it did nothing.
std::string browser();

/// What was left of a page.
struct DrivenPage {
  std::string result;   ///< what the script gave to finish(), as JSON
  std::string console;  ///< the lines of the browser's log that come from the page
};

/// Opens a copy of `page` (the text of a file) with `script` at its end, and waits until that calls
/// finish(value). The script can wait for a state of the page by
///     when(() => condition, () => { ... });
/// The page's load event is held back until finish() is called, and the browser reads the page at
/// that event: no time is waited for, however busy the machine is. `folder` is where files are put.
/// Throws std::runtime_error with the browser's log if finish() was not called within five minutes.
DrivenPage drive_page(const std::string& browser, std::string page, const std::string& script,
                      const std::string& folder);
/// The page with such a script at its end, and one that is opened from where it is served.
std::string with_script(std::string page, const std::string& script);
DrivenPage drive_url(const std::string& browser, const std::string& url, const std::string& folder);

}  // namespace duet::test
