// Open Image Denoise, which makes a guess of the image without noise.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "image/denoiser_library.h"

namespace duet {

/// What guides the denoiser of an image. Three values per pixel each, in rows from the top.
struct DenoiserGuides {
  int width = 0, height = 0;
  std::vector<float> albedo;  ///< from 0 to 1
  std::vector<float> normal;  ///< from −1 to 1, zero where nothing is seen
};

/// Its "RT" filter for linear colours on the CPU, guided by albedo and normals that are denoised
/// first, each by itself. Source: its documentation, "Ray tracing denoising filter".
class Denoiser {
 public:
  /// Loads the library. Throws std::runtime_error if it cannot, or if it cannot work here.
  explicit Denoiser(int threads);

  /// "Open Image Denoise 2.5.1".
  const std::string& name() const { return name_; }
  /// Denoises guides. Throws std::runtime_error if the library fails, for want of memory perhaps.
  DenoiserGuides clean(DenoiserGuides noisy) const;
  /// Colours, linear and of any scale, without most of their noise and with a bias of unknown size.
  /// Negative ones become zero. `clean` are their guides without noise. Throws as clean().
  std::vector<float> denoise(DenoiserGuides& clean, std::vector<float> colours) const;

 private:
  struct Release {
    void operator()(OidnDeviceHandle* device) const {
      load_denoiser_library().release_device(device);
    }
    void operator()(OidnFilterHandle* filter) const {
      load_denoiser_library().release_filter(filter);
    }
  };
  using Filter = std::unique_ptr<OidnFilterHandle, Release>;

  Filter new_filter() const;
  void set(const Filter& filter, const char* name, const DenoiserGuides& size,
           std::vector<float>& pixels) const;
  /// Lets it do its work.
  void run(const Filter& filter) const;
  /// Throws if something has failed since it was asked last.
  void check() const;

  const OidnFunctions& oidn_;
  std::unique_ptr<OidnDeviceHandle, Release> device_;
  std::string name_;
};

}  // namespace duet
