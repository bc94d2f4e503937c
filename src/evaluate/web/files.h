// The files of src/evaluate/web, which the build puts into the program (src/CMakeLists.txt).
#pragma once

namespace duet::web_files {

extern const char* const live_js;
extern const char* const page_css;
extern const char* const table_js;
extern const char* const viewer_js;

}  // namespace duet::web_files
