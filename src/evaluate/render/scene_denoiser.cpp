#include "evaluate/render/scene_denoiser.h"

#include <algorithm>
#include <stdexcept>

#include "base/failures.h"
#include "evaluate/render/output.h"
#include "evaluate/report/denoised_image.h"

namespace duet {

SceneDenoiser::SceneDenoiser(const RenderOptions& options, IntegratorDescription& integrator)
    : options_(options) {
  if (!options.denoise) return;
  try {
    hidden_ = add_denoiser_layers(integrator, options.integrator);
  } catch (const std::invalid_argument& e) {
    throw UsageError(fmt::format("--denoise: {}", e.what()));
  }
}

void SceneDenoiser::load() {
  if (!options_.denoise) return;
  try {
    denoiser_.emplace(options_.threads);
  } catch (const std::runtime_error& e) {
    throw SceneFailure(fmt::format("--denoise: {}", e.what()));
  }
}

bool SceneDenoiser::hides(const std::string& channel) const {
  return std::find(hidden_.begin(), hidden_.end(), channel) != hidden_.end();
}

std::vector<std::string> SceneDenoiser::shown(const std::vector<std::string>& channels) const {
  std::vector<std::string> all;
  for (const std::string& channel : channels)
    if (!hides(channel)) all.push_back(channel);
  return all;
}

std::vector<std::string> SceneDenoiser::write(SceneImages& images, const Integrator& method,
                                              const RenderResult& result, const ImageForm& form,
                                              const HeaderFields& header) const {
  if (!denoiser_) return images.write(result, form, header);
  // The noisy image first: it is safe then whatever becomes of the other.
  RenderResult shown = result;
  shown.image = without_channels(result.image, hidden_);
  std::vector<std::string> written = images.write(shown, form, header);
  const Image clean = denoised_image(*denoiser_, result.image, method.layers_tell_noise());
  for (std::string& path :
       images.write_denoised(clean, result, form, denoised_header(header, denoiser_->name())))
    written.push_back(std::move(path));
  return written;
}

}  // namespace duet
