// Image files as linear values, and what their headers say.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "image/image.h"

namespace duet {

/// An image file in linear values. Throws ReadError.
struct LinearImage {
  Image image;
  bool display_encoded = false;
  std::string spp;       ///< that its header says, or ""
  std::string denoiser;  ///< by which it was denoised, as its header says, or ""
  /// All that its header says.
  std::vector<std::pair<std::string, std::string>> header;
};
LinearImage load_linear(const std::string& path);
/// Throws std::runtime_error if colours are not finite: a reference with holes would let everything
/// pass there.
void check_finite(const Image& image, const std::string& path);
/// The same, and for an image that is no variance: its values are negative, more than rounding
/// makes those of a difference of moments.
void check_variance(const Image& image, const std::string& path);

/// An image whose number of samples is needed and known to nobody.
class UnknownSamples : public std::runtime_error {
 public:
  enum class Of { image, reference };
  UnknownSamples(Of of, std::string path)
      : std::runtime_error("it is not known how many samples " + path + " has"),
        of_(of),
        path_(std::move(path)) {}
  Of of() const { return of_; }
  const std::string& path() const { return path_; }

 private:
  Of of_;
  std::string path_;
};

}  // namespace duet
