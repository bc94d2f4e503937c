// What is behind the handles of the public headers.
#pragma once

#include <memory>
#include <string>

#include "duet/comparison.h"
#include "duet/errors.h"
#include "duet/render.h"
#include "duet/rendered_image.h"
#include "duet/scene_file.h"
#include "evaluate/compare/linear_image.h"
#include "evaluate/report/header.h"
#include "evaluate/report/image_form.h"
#include "evaluate/report/loaded_scene.h"
#include "evaluate/report/read_scene.h"

namespace duet {

struct SceneFile::Contents {
  std::string name;
  LoadedScene loaded;
};

struct RenderedImage::Contents {
  Image image;
  ImageForm form;
  HeaderFields header;
  bool interrupted = false;
  std::shared_ptr<const Contents> denoised = {};  ///< or null
  std::string denoiser_failure = {};              ///< or ""
};

struct ComparedImage::Contents {
  LinearImage linear;
};

/// All threads that the process may have, for settings that ask for none. From the first call on
/// TBB keeps to them until the process ends. Throws std::invalid_argument.
int threads_or_all(int threads);

/// Throws std::invalid_argument for numbers that make no sense, whatever the scene.
void check_settings(const RenderSettings& settings);

/// Throws std::invalid_argument for a path with a zero byte, which would name another file.
void check_path(const std::string& path);

/// Throws std::invalid_argument for search paths with zero bytes.
ReadingOptions reading_options(const SceneFileOptions& options);

/// Throws SceneError.
LoadedScene read_or_throw(const std::string& name, const ReadingOptions& options);

/// Errors and warnings as the public headers have them.
std::vector<SceneMessage> scene_messages(const Diagnostics& diagnostics);

}  // namespace duet
