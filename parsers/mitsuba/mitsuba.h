// Reads Mitsuba scene files, versions 0.4 to 3.x.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "curves/curve_file.h"
#include "measured/measured_file.h"
#include "mesh/ellipsoids.h"
#include "mesh/mesh_file.h"
#include "scene/description.h"
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
};

class Vocabulary;

struct MitsubaOptions {
  /// The plugins that are known; null for those that come with the program. Must outlive reading.
  const Vocabulary* vocabulary = nullptr;
  /// Values of `$name` parameters; they win over the scene's own defaults.
  std::vector<std::pair<std::string, std::string>> defines;
  /// Further directories to look for files, after the scene's own.
  std::vector<std::string> search_paths;
  /// Methods that take the place of the scene's integrator afterwards, one after the other. One of
  /// another type is replaced, then: it may be unknown, its parameters are not checked, and of
  /// those only max_depth, rr_depth, hide_emitters and strict_normals are read. Integrators that
  /// make layers are no methods, and stay.
  std::vector<std::string> replacing_methods;
  FileAccess files;
};

struct MitsubaScene {
  SceneDescription description;
  std::string version;  ///< of the format, as the main file gives it: "3.0.0"
  /// The `$name` parameters that the scene has, with the values they got, in order of appearance.
  std::vector<std::pair<std::string, std::string>> parameters;
};

/// Reads a scene with everything it includes and the meshes it names. Nothing is returned if there
/// were errors; all errors of all files are in `diagnostics`.
std::optional<MitsubaScene> read_mitsuba(const std::string& file, const MitsubaOptions& options,
                                         Diagnostics& diagnostics);

}  // namespace duet
