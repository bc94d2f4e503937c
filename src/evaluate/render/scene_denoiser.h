// The denoised image of one scene, if it is asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evaluate/render/render_options.h"
#include "evaluate/render/scene_images.h"
#include "image/denoiser.h"

namespace duet {

class SceneDenoiser {
 public:
  /// Has the method render the layers that guide the denoiser, if the options ask for it. Throws
  /// UsageError if its image has no colours.
  SceneDenoiser(const RenderOptions& options, IntegratorDescription& integrator);
  /// Loads the denoiser, if the options ask for it. Throws SceneFailure if there is none.
  void load();

  /// Whether a channel is rendered for the denoiser only, and not part of the image.
  bool hides(const std::string& channel) const;
  /// Those that are part of the image.
  std::vector<std::string> shown(const std::vector<std::string>& channels) const;

  /// Writes the image of a method and then the denoised one; returns the names of the files. Throws
  /// std::runtime_error.
  std::vector<std::string> write(SceneImages& images, const Integrator& method,
                                 const RenderResult& result, const ImageForm& form,
                                 const HeaderFields& header) const;

 private:
  const RenderOptions& options_;
  std::optional<Denoiser> denoiser_;
  std::vector<std::string> hidden_;
};

}  // namespace duet
