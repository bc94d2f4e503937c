#include "evaluate/render/scene_images.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "base/diagnostics.h"
#include "base/failures.h"
#include "base/system/standard_streams.h"
#include "evaluate/render/file_settings_text.h"
#include "evaluate/report/denoised_image.h"
#include "evaluate/report/partial_image.h"
#include "evaluate/report/provenance.h"
#include "image/image_facts.h"

namespace duet {

SceneImages::SceneImages(const RenderOptions& options, const std::string& scene,
                         const OutputNames& names, const Fingerprint& settings, int planned_spp,
                         Messages& messages)
    : options_(options),
      scene_(host_free(scene)),
      names_(names),
      settings_(settings),
      planned_spp_(planned_spp),
      messages_(messages) {}

std::vector<std::string> SceneImages::paths(Kind kind, int spp) const {
  OutputNames names = names_;
  names.spp = fmt::to_string(spp);
  std::vector<std::string> result;
  for (const std::string& pattern : options_.outputs)
    result.push_back(output_path(pattern, names, options_.extension));
  if (result.empty()) result.push_back(output_path("", names, options_.extension));
  if (kind == Kind::denoised)
    for (std::string& path : result) path = denoised_path(path);
  return result;
}

std::vector<std::string> SceneImages::planned() const {
  std::vector<std::string> all = paths(Kind::rendered, planned_spp_);
  if (options_.denoise)
    for (std::string& path : paths(Kind::denoised, planned_spp_)) all.push_back(std::move(path));
  return all;
}

void SceneImages::add_to(FileUses& uses) const {
  for (const std::string& path : planned()) uses.write("-o", path);
}

std::vector<std::string> SceneImages::partial_paths(Kind kind, int spp) const {
  if (options_.keep_partial_name) return paths(kind, spp);
  // The name of the image that it is a part of.
  std::vector<std::string> result = paths(kind, options_.budget.spp ? planned_spp_ : spp);
  for (std::string& path : result)
    if (!is_standard_output(path)) path = partial_path(path);
  return result;
}

std::string SceneImages::settings_hash(Kind kind, const std::string& path) const {
  Fingerprint all = settings_;
  if (kind == Kind::denoised) all.add("denoised");
  // What the film says about tones is part of the scene.
  if (const std::string text = file_settings_text(path, options_.files); !text.empty())
    all.add(text);
  return all.text();
}

bool SceneImages::are_finished() const {
  // Each says why it is not.
  const bool rendered = are_finished(Kind::rendered);
  return (!options_.denoise || are_finished(Kind::denoised)) && rendered;
}

bool SceneImages::are_finished(Kind kind) const {
  bool finished = true;
  for (const std::string& path : paths(kind, planned_spp_)) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
      finished = false;
    } else if (const std::string why = unfinished_reason(path, settings_hash(kind, path));
               !why.empty()) {
      messages_.info("{} is rendered again: {}", path, why);
      finished = false;
    }
  }
  return finished;
}

RenderResult SceneImages::stored_result() const {
  RenderResult result;
  try {
    const ImageFacts facts = read_image_facts(planned()[0]);
    result.spp = int(std::strtod(facts.field("spp").c_str(), nullptr));
    const std::string error = facts.field("relativeStandardError");
    if (!error.empty()) result.relative_rmse = std::strtod(error.c_str(), nullptr);
  } catch (const ReadError&) {
    // It has been moved away meanwhile: nothing is known of its error.
  }
  return result;
}

std::vector<std::string> SceneImages::write_files(Kind kind, const Image& image,
                                                  const RenderResult& result, const ImageForm& form,
                                                  const HeaderFields& header) const {
  const std::vector<std::string> written =
      result.interrupted ? partial_paths(kind, result.spp) : paths(kind, result.spp);
  TryAll files;
  for (const std::string& path : written) {
    HeaderFields fields = header;
    fields.emplace_back("settingsHash", settings_hash(kind, path));
    files.run([&] {
      write_image(path, image, form, fields, options_.files);
      if (!result.interrupted) remove_partial(path, scene_);
    });
  }
  files.finish();
  return written;
}

std::vector<std::string> SceneImages::write(const RenderResult& result, const ImageForm& form,
                                            const HeaderFields& header) {
  const std::vector<std::string> written =
      write_files(Kind::rendered, result.image, result, form, header);
  std::error_code ignored;
  for (const std::string& path : partial_)
    if (std::find(written.begin(), written.end(), path) == written.end())
      std::filesystem::remove(path, ignored);
  partial_ = result.interrupted ? written : std::vector<std::string>{};
  return written;
}

std::vector<std::string> SceneImages::write_denoised(const Image& image, const RenderResult& result,
                                                     const ImageForm& form,
                                                     const HeaderFields& header) {
  const std::vector<std::string> written = write_files(Kind::denoised, image, result, form, header);
  if (result.interrupted) partial_.insert(partial_.end(), written.begin(), written.end());
  return written;
}

}  // namespace duet
