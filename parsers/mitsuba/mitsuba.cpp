#include "mitsuba/mitsuba.h"

#include "files/file_access.h"
#include "mitsuba/loader.h"
#include "mitsuba/scene_reader.h"

namespace duet {

std::optional<MitsubaScene> read_mitsuba(const std::string& file, const MitsubaOptions& options,
                                         Diagnostics& diagnostics) {
  Report report(diagnostics);
  const FileAccess access = with_disk(options.files);
  const NodeTree tree = load_tree(file, options, access, report);
  MitsubaScene scene;
  // What the tree lacks after an error must not hide errors in what it has. Without its root there
  // is nothing to look at.
  if (tree.nodes.front().folders) scene.description = SceneReader(access, report).read(tree, file);
  scene.parameters = tree.parameters;
  const FileVersion& version = tree.nodes.front().version;
  scene.version = fmt::format("{}.{}.{}", version.major, version.minor, version.patch);
  report.finish({std::make_shared<const std::string>(file), 1, 1});
  if (report.has_errors()) return std::nullopt;
  return scene;
}

}  // namespace duet
