// Which version of the library is there.
#pragma once

namespace duet {

/// Such as "0.1.0", by Semantic Versioning: before 1.0.0 every minor version may break programs.
[[gnu::visibility("default")]] const char* library_version();

}  // namespace duet
