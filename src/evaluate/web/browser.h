// Opens pages as the desktop does.
#pragma once

#include <string>

namespace duet {

/// The program that opens them; "" if there is none.
std::string page_opener();

/// Where the page of a file goes that is to be looked at now: in a new folder. It must stay for as
/// long as it is open, so it is left to whatever clears folders of temporary files. Throws
/// std::system_error.
std::string temporary_page(const std::string& file);

/// Opens a page by page_opener(), without waiting until it is closed. Throws std::runtime_error.
void open_page(const std::string& opener, const std::string& page);

}  // namespace duet
