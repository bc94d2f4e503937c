// How readers of scenes get at the files that a scene names, and where those are looked for.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "curves/curve_file.h"
#include "measured/measured_file.h"
#include "mesh/ellipsoids.h"
#include "mesh/mesh_file.h"
#include "volume/vol_file.h"

namespace duet {

/// How the reader gets at files. What is left empty is done on the disk; tests put their own things
/// here.
struct FileAccess {
  /// Whether there is a file or folder of that name.
  std::function<bool(const std::string& path)> exists;
  /// The whole text of a file; nothing if it cannot be read.
  std::function<std::optional<std::string>(const std::string& path)> read;
  /// Reads the mesh file of an obj, ply or serialized shape; throws ReadError.
  std::function<TriangleMesh(const std::string& plugin, const std::string& path,
                             const MeshOptions& options)>
      read_mesh;
  /// Reads an OBJ file as 0.x divides it; throws ReadError.
  std::function<ObjFile(const std::string& path, const MeshOptions& options)> read_obj_parts;
  /// Reads a volume file; throws ReadError.
  std::function<VolumeFile(const std::string& path)> read_volume;
  /// Reads a file of ellipsoids; throws ReadError.
  std::function<std::vector<Ellipsoid>(const std::string& path)> read_ellipsoids;
  /// Reads a measured material; throws ReadError.
  std::function<MeasuredTable(const std::string& path)> read_measured;
  /// Reads a file of curves; throws ReadError.
  std::function<CurveSet(const std::string& path, CurveKind kind)> read_curves;
  /// Reads a file of 0.6's hair, to be of this radius; throws ReadError.
  std::function<CurveSet(const std::string& path, float radius)> read_hair;
  /// What messages name instead of a line (from 1) of a text that nobody has seen. Where it is null
  /// or returns null, they name file, line and column.
  std::function<std::shared_ptr<const std::string>(const std::string& path, int line)> place;
};

/// `access` with what it leaves open done on the disk.
FileAccess with_disk(FileAccess access);

/// The whole text of a file; throws ReadError.
std::string text_of(const std::string& path, const FileAccess& access);

/// The folder of a file, "." if it has none in its name.
std::string folder_of(const std::string& path);

/// The file or folder `name` in the first of `folders` that has it. Backslashes, as scenes made on
/// Windows have them, are understood as slashes if there is no such file otherwise.
std::optional<std::string> find_file(const std::string& name,
                                     const std::vector<std::string>& folders,
                                     const FileAccess& access);

/// The path with the current folder before it, if it is relative.
std::string absolute_path(const std::string& path);

/// `file "x" not found (looked in …)`
std::string not_found(const std::string& name, const std::vector<std::string>& folders);

}  // namespace duet
