// Rendering.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <duet/rendered_image.h>
#include <duet/scene_file.h>

namespace duet {

/// A layer for each technique.
enum class RenderedTechniques { none, weighted, raw };

/// What `duet render` can be told, with the same meaning. Where nothing is said the scene decides.
struct RenderSettings {
  // When to stop: the first limit that is reached.
  std::optional<int> spp;              ///< samples per pixel
  std::optional<double> seconds;       ///< wall time
  std::optional<double> target_error;  ///< relative standard error, such as 0.01

  std::string integrator;  ///< a method instead of the scene's: "auto", "path", "bdpt", "vcm" …
  std::vector<std::pair<std::string, std::string>> parameters;  ///< of the method
  std::vector<std::string> layers;                              ///< "albedo", "depth" …
  std::vector<std::string> cryptomatte;  ///< "object", "material": mattes as further layers
  bool denoise = false;                  ///< whether RenderedImage::denoised() has an image
  RenderedTechniques techniques = RenderedTechniques::none;

  std::optional<uint64_t> seed;
  bool strict_sampler = false;  ///< the sampler that the scene names, instead of Sobol' points
  int threads = 0;              ///< 0: all, or what DUET_THREADS says
  std::optional<std::array<int, 2>> size;  ///< width and height
  std::optional<std::array<int, 4>> crop;  ///< x, y, width, height, in pixels
  size_t sensor = 0;
};

/// How far a render is.
struct RenderedShare {
  double fraction = 0;  ///< of the budget, as far as it is known
  double spp = 0;       ///< samples per pixel
  double seconds = 0;
};

/// How a render is watched and stopped.
struct RenderWatch {
  /// From any thread, one at a time; the last time when the render has ended, with a fraction of 1
  /// unless it was cancelled.
  std::function<void(const RenderedShare&)> progress = {};
  std::function<void(const std::string&)> warning = {};  ///< from the calling thread
  /// From the calling thread. Such images have no mattes and no denoised one beside them, which are
  /// made when the render has ended.
  std::function<void(const RenderedImage&)> image_so_far = {};
  double image_seconds = 10;                  ///< between images so far
  const std::atomic<bool>* cancel = nullptr;  ///< to be set by any thread
};

/// The image, which has the same bits as that of `duet render` with the same settings, whatever the
/// number of threads; nothing if it was cancelled before every pixel had a sample. Throws
/// SceneError for what the method cannot render, std::invalid_argument, std::out_of_range and
/// MemoryError; and DenoiserError, before it renders, if Open Image Denoise is asked for and cannot
/// be loaded.
[[gnu::visibility("default")]] std::optional<RenderedImage> render_file(
    const SceneFile& scene, const RenderSettings& settings, const RenderWatch& watch = {});

}  // namespace duet
