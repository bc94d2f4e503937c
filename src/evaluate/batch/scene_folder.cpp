#include "evaluate/batch/scene_folder.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/file_names.h"
#include "evaluate/batch/pbrt_skim.h"
#include "mitsuba/loader.h"
#include "pbrt/pbrt.h"

namespace duet::batch {

namespace fs = std::filesystem;

namespace {

std::string path_key(const std::string& path) {
  std::error_code ignored;
  const fs::path canonical = fs::weakly_canonical(path, ignored);
  return canonical.empty() ? path : canonical.string();
}

/// Whether an .xml file is a scene. What it includes is added to `parts`.
bool is_mitsuba_scene(const std::string& file, std::set<std::string>& parts) {
  MitsubaOptions options;
  options.replacing_methods = {"path"};
  bool looks_like_scene = false;
  FileAccess access = with_disk({});
  access.read = [&, on_disk = access.read](const std::string& path) {
    auto text = on_disk(path);
    if (path == file)
      looks_like_scene = text && text->find("<scene") != text->npos;
    else
      parts.insert(path_key(path));
    return text;
  };
  Diagnostics ignored;
  Report report(ignored);
  const NodeTree tree = load_tree(file, options, access, report);
  const auto is_sensor = [](const Node& node) { return node.kind == PluginKind::sensor; };
  if (std::any_of(tree.nodes.begin(), tree.nodes.end(), is_sensor)) return looks_like_scene;
  // Without its root nothing is known of the file.
  return looks_like_scene && !tree.nodes.front().folders;
}

bool is_pbrt_scene(const std::string& file) {
  try {
    pbrt::Lexer in(file);
    while (in.peek() != pbrt::Kind::end)
      if (in.peek() != pbrt::Kind::word)
        take_parameters(in);
      else if (in.take_word() == "WorldBegin")
        return true;
    return false;
  } catch (const pbrt::SyntaxError&) {
    return true;  // rendering it will tell where
  } catch (const ReadError&) {
    return true;
  }
}

/// All files below a folder that may be scenes.
std::vector<std::string> scene_candidates(const std::string& folder, Diagnostics& diagnostics) {
  std::vector<std::string> files;
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, error), end;
  for (; !error && entry != end; entry.increment(error)) {
    const std::string path = entry->path().string();
    const bool may_be = extension_of(path) == ".xml" || pbrt::is_pbrt_file(path);
    std::error_code ignored;
    if (may_be && entry->is_regular_file(ignored)) files.push_back(path);
  }
  if (error)
    diagnostics.error({std::make_shared<const std::string>(folder), 0, 0},
                      "not all of this folder can be read: {}", error.message());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::vector<Job> scenes_below(const std::string& folder, Diagnostics& diagnostics) {
  std::set<std::string> parts;
  std::vector<std::string> scenes = scene_candidates(folder, diagnostics);
  std::erase_if(scenes, [&](const std::string& file) {
    return pbrt::is_pbrt_file(file) ? !is_pbrt_scene(file) : !is_mitsuba_scene(file, parts);
  });
  std::vector<Job> jobs;
  for (const std::string& scene : scenes) {
    if (parts.contains(path_key(scene))) continue;
    Job job;
    job.where.file = std::make_shared<const std::string>(scene);
    job.scene = scene;
    jobs.push_back(std::move(job));
  }
  if (jobs.empty() && !diagnostics.has_errors())
    diagnostics.error({std::make_shared<const std::string>(folder), 0, 0},
                      "there is no scene in this folder or below it");
  return jobs;
}

}  // namespace duet::batch
