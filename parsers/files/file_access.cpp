#include "files/file_access.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "values/text.h"
#include "volume/volume_file.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

/// Larger texts are not scene descriptions.
constexpr uintmax_t kLargestText = uintmax_t(256) << 20;

std::optional<std::string> read_text(const std::string& path) {
  std::error_code error;
  // A pipe would wait forever.
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  const uintmax_t size = fs::file_size(path, error);
  if (error || size > kLargestText) return std::nullopt;
  std::ifstream in(path, std::ios::binary);
  std::string text(size_t(size), '\0');
  if (!in.read(text.data(), std::streamsize(size))) return std::nullopt;
  return text;
}

TriangleMesh read_mesh_file(const std::string& plugin, const std::string& path,
                            const MeshOptions& options) {
  if (plugin == "ply") return read_ply(path, options);
  if (plugin == "serialized") return read_serialized(path, options);
  return read_obj(path, options);
}

}  // namespace

FileAccess with_disk(FileAccess access) {
  if (!access.exists)
    access.exists = [](const std::string& path) {
      std::error_code error;
      return fs::exists(path, error);
    };
  if (!access.read) access.read = read_text;
  if (!access.read_mesh) access.read_mesh = read_mesh_file;
  if (!access.read_obj_parts)
    access.read_obj_parts = [](const std::string& path, const MeshOptions& options) {
      return read_obj_parts(path, options);
    };
  if (!access.read_volume) access.read_volume = read_volume;
  if (!access.read_ellipsoids)
    access.read_ellipsoids = [](const std::string& path) { return read_ellipsoids(path); };
  if (!access.read_measured)
    access.read_measured = [](const std::string& path) { return read_measured(path); };
  if (!access.read_curves)
    access.read_curves = [](const std::string& path, CurveKind kind) {
      return read_curves(path, kind);
    };
  if (!access.read_hair)
    access.read_hair = [](const std::string& path, float radius) {
      return read_hair(path, radius);
    };
  return access;
}

std::string text_of(const std::string& path, const FileAccess& access) {
  auto text = access.read(path);
  if (!text) throw ReadError(path + ": cannot be read");
  return std::move(*text);
}

std::string folder_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

std::optional<std::string> find_file(const std::string& name,
                                     const std::vector<std::string>& folders,
                                     const FileAccess& access) {
  const auto find = [&](const std::string& n) -> std::optional<std::string> {
    if (n.empty() || n.find('\0') != std::string::npos) return std::nullopt;
    if (fs::path(n).is_absolute()) return access.exists(n) ? std::optional(n) : std::nullopt;
    for (const std::string& folder : folders) {
      const std::string path =
          folder == "." ? n : (fs::path(folder) / n).lexically_normal().string();
      if (access.exists(path)) return path;
    }
    return std::nullopt;
  };
  if (auto path = find(name)) return path;
  if (name.find('\\') == std::string::npos) return std::nullopt;
  std::string slashes = name;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  return find(slashes);
}

std::string absolute_path(const std::string& path) {
  std::error_code error;
  const fs::path full = fs::absolute(path, error);
  return error ? path : full.lexically_normal().string();
}

std::string not_found(const std::string& name, const std::vector<std::string>& folders) {
  std::string looked;
  constexpr size_t most = 4;
  if (!fs::path(name).is_absolute())
    for (size_t i = 0; i < folders.size(); ++i) {
      if (i == most) {
        looked += ", …";
        break;
      }
      looked += (i ? ", " : "") + folders[i];
    }
  return "file " + in_quotes(name) + " not found" +
         (looked.empty() ? "" : " (looked in " + looked + ")");
}

}  // namespace duet
