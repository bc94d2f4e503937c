// Whether the images of a set can be independent of each other, as tests for bias take them to be.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "evaluate/compare/linear_image.h"

namespace duet {

/// The images of a set, by their pixels and their seeds.
class ImagesOfSet {
 public:
  /// Throws std::runtime_error for an image with the pixels and the seed of another one. An image
  /// without noise has the same pixels with every seed.
  void add(const LinearImage& image, const std::string& file);
  /// That the pixels differ and seeds do not, or that pixels are the same and seeds are not known,
  /// or "".
  std::string warning() const;
  /// That images of this set are also in another one, or "".
  std::string shared_warning(const ImagesOfSet& other) const;

 private:
  struct Seen {
    std::string file, seed;
  };
  std::map<uint64_t, Seen> by_pixels_;
  std::map<std::string, std::string> by_seed_;  ///< the first file of each
  std::string same_pixels_;  ///< the warning for the first pair whose seeds are not known
  int repeated_seeds_ = 0;
  std::pair<Seen, std::string> example_;  ///< the first of them, and the file that has its seed
};

}  // namespace duet
