#include "evaluate/render/output_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/system/standard_streams.h"
#include "evaluate/render/output.h"

namespace duet {

namespace {

void check_standard_output(const RenderOptions& o) {
  const auto& outputs = o.outputs;
  const auto count = std::count(outputs.begin(), outputs.end(), "-");
  if (count == 0) return;
  if (count > 1 || o.read.scenes.size() > 1)
    throw UsageError("-o -: standard output holds one image");
  if (o.denoise) throw UsageError("-o -: standard output holds one image, --denoise makes two");
  if (o.skip_existing) throw UsageError("-o -: --skip-existing needs images that can exist");
  if (const std::string why = standard_output_refusal(); !why.empty())
    throw UsageError("-o -: " + why);
}

void check_raw_films(const RenderOptions& o) {
  if (!o.raw.empty() && o.raw != "-" && image_format(o.raw) != "exr" && !o.raw.ends_with('/'))
    throw UsageError(fmt::format("--raw {}: raw films are .exr files", o.raw));
  if (o.raw == "-") throw UsageError("--raw -: raw films cannot go to standard output");
  if (!o.resume.empty() && o.read.scenes.size() > 1)
    throw UsageError("--resume: one film belongs to one scene; --checkpoint resumes several");
  if (o.writes_images) return;
  if (o.skip_existing) throw UsageError("--skip-existing: --raw without -o writes no image");
  if (o.denoise) throw UsageError("--denoise: --raw without -o writes no image");
  if (!o.mattes.empty())
    throw UsageError(
        "--cryptomatte: raw films hold no mattes, and --raw without -o writes no image");
}

/// A pattern for each scene's file of one kind.
struct PlannedOutput {
  const char* option;
  std::string pattern, extension;
  std::string may_replace = "";  ///< a use of its file that does no harm
};

}  // namespace

void check_parts(const RenderOptions& o) {
  check_raw_films(o);
  if (!o.samples && !o.slice) return;
  const std::string option = o.samples ? "--samples" : "--slice";
  if (!o.mattes.empty())
    throw UsageError(
        fmt::format("{}: the mattes of slices cannot be put together; render them (--cryptomatte) "
                    "with few samples apart",
                    option));
  if (o.samples && o.slice) throw UsageError("--slice: there is --samples already");
  if (o.budget.seconds || o.budget.target_error)
    throw UsageError(
        fmt::format("{}: samples that follow from --time or --target-error cannot be "
                    "cut into slices",
                    option));
  if (o.raw.empty() && !o.checkpoint)
    throw UsageError(fmt::format("{}: the slice goes to a raw film; name it with --raw", option));
}

void check_writable(const std::string& option, const std::string& path) {
  if (path.empty()) return;
  if (const std::string why = prepare_file(path); !why.empty())
    throw UsageError(fmt::format("{}: {}", option, why));
}

std::vector<std::string> check_outputs(const RenderOptions& o, FileUses uses) {
  check_standard_output(o);
  std::vector<PlannedOutput> planned;
  for (const std::string& pattern : o.outputs) planned.push_back({"-o", pattern, o.extension});
  if (!o.raw.empty()) planned.push_back({"--raw", o.raw, kRawExtension, kResume});
  if (planned.empty()) planned.push_back({"the image", "", o.extension});
  std::map<std::string, std::string> writers;
  std::vector<std::string> images;
  for (const std::string& scene : o.read.scenes)
    for (const auto& [option, pattern, extension, may_replace] : planned) {
      OutputNames names = output_names(scene);
      // What only the scene can say stays as it is: two scenes that differ only in that are too
      // much alike.
      names.integrator = "{integrator}", names.spp = "{spp}", names.seed = "{seed}";
      const std::string path = output_path(pattern, names, extension);
      names.spp = "another";
      if (o.skip_existing && !o.budget.spp && (o.budget.seconds || o.budget.target_error) &&
          path != output_path(pattern, names, extension))
        throw UsageError(fmt::format(
            "-o {}: --skip-existing cannot know {{spp}} before the scene is rendered", pattern));
      const auto [entry, is_new] = writers.try_emplace(path, scene);
      if (!is_new && o.read.scenes.size() > 1)
        throw UsageError(fmt::format(
            "-o {}: {} and {} would be written to one file; use a template with {{scene}} or "
            "{{folder}}",
            pattern.empty() ? path : pattern, entry->second, scene));
      uses.write(option, path, may_replace);
      if (scene == o.read.scenes[0] && extension != kRawExtension) images.push_back(path);
    }
  return images;
}

}  // namespace duet
