#include "files/file_cache.h"

namespace duet {

std::shared_ptr<const TriangleMesh> FileCache::mesh(const std::string& plugin,
                                                    const std::string& file,
                                                    const MeshOptions& options,
                                                    const SourceLocation& where) {
  const std::string key =
      fmt::format("{} {} {} {} {} {}\n{}", plugin, options.face_normals, options.flip_tex_coords,
                  options.max_smooth_angle.value_or(-1), options.shape_index,
                  options.obj_part.value_or(-1), file);
  const auto [entry, is_new] = meshes_.try_emplace(key);
  if (is_new)
    if (auto read =
            report_.from_file(where, [&] { return access_.read_mesh(plugin, file, options); }))
      entry->second = std::make_shared<TriangleMesh>(std::move(*read));
  return entry->second;
}

std::shared_ptr<const VolumeGrid> FileCache::volume_grid(const std::string& file,
                                                         const SourceLocation& where,
                                                         bool& is_float32) {
  const auto [entry, is_new] = volumes_.try_emplace(file);
  if (is_new)
    if (auto read = report_.from_file(where, [&] { return access_.read_volume(file); }))
      entry->second = std::make_shared<VolumeFile>(std::move(*read));
  if (!entry->second) return nullptr;
  is_float32 = entry->second->is_float32;
  return {entry->second, &entry->second->grid};
}

}  // namespace duet
