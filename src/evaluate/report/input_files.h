// The files that a scene is made of, found out by watching the reader.
#pragma once

#include <string>
#include <vector>

#include "evaluate/report/fingerprint.h"
#include "files/file_access.h"

namespace duet {

/// Watches how the reader gets at files: the texts it reads, and every file that it looks for and
/// finds, as it does for meshes, textures and tables before they are read.
class InputFiles {
 public:
  /// The same access, watched; this object must outlive it.
  FileAccess watch(FileAccess access);
  /// Of the contents of all files in the order in which they were found, whatever their names.
  Fingerprint fingerprint() const;

 private:
  Fingerprint texts_;
  std::vector<std::string> found_;  ///< each once
};

}  // namespace duet
