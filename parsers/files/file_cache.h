// The meshes and volumes that a scene names, each of which is read once.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "files/file_access.h"
#include "values/report.h"

namespace duet {

/// What several plugins name is shared. Errors are reported where the first of them stands.
class FileCache {
 public:
  FileCache(const FileAccess& access, Report& report) : access_(access), report_(report) {}

  /// Of an obj, ply or serialized shape; null after an error.
  std::shared_ptr<const TriangleMesh> mesh(const std::string& plugin, const std::string& file,
                                           const MeshOptions& options, const SourceLocation& where);
  /// Null after an error. Says of a grid whether its file has 32-bit floating-point numbers.
  std::shared_ptr<const VolumeGrid> volume_grid(const std::string& file,
                                                const SourceLocation& where, bool& is_float32);

 private:
  const FileAccess& access_;
  Report& report_;
  std::map<std::string, std::shared_ptr<const VolumeFile>> volumes_;
  std::map<std::string, std::shared_ptr<const TriangleMesh>> meshes_;
};

}  // namespace duet
