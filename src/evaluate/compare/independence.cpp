#include "evaluate/compare/independence.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "image/colours.h"
#include "math/hash.h"

namespace duet {

namespace {

/// Nothing for an image with holes, which fails whatever the others are.
std::optional<uint64_t> hash_of_pixels(const Image& image) {
  const Colours colours(image);
  uint64_t hash = 0;
  for (size_t i = 0; i < colours.pixels(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double value = colours(i, c);
      if (!std::isfinite(value)) return std::nullopt;
      hash = hash_combine(hash, std::bit_cast<uint64_t>(value));
    }
  return hash;
}

std::string seed_of(const LinearImage& image) {
  for (const auto& [name, value] : image.header)
    if (name == "seed") return value;
  return "";
}

}  // namespace

void ImagesOfSet::add(const LinearImage& image, const std::string& file) {
  const std::string seed = seed_of(image);
  if (const std::optional<uint64_t> hash = hash_of_pixels(image.image)) {
    const auto [equal, is_new] = by_pixels_.try_emplace(*hash, Seen{file, seed});
    const Seen& other = equal->second;
    if (!is_new && (seed.empty() || other.seed.empty()) && same_pixels_.empty())
      same_pixels_ = fmt::format(
          "{} has the same pixels as {}: if that is no scene without noise, the images of a set "
          "must have noise of their own, each with another seed (--seed)",
          file, other.file);
    if (!is_new && !seed.empty() && seed == other.seed)
      throw std::runtime_error(fmt::format(
          "{} has the same pixels as {}: the images of a set must have noise of their own; render "
          "each with another seed (--seed), or compare one image of each side without --batches",
          file, other.file));
  }
  if (seed.empty()) return;
  const auto [first, is_new] = by_seed_.try_emplace(seed, file);
  if (is_new || repeated_seeds_++ > 0) return;
  example_ = {{file, seed}, first->second};
}

std::string ImagesOfSet::warning() const {
  if (repeated_seeds_ == 0) return same_pixels_;
  const auto& [repeated, first] = example_;
  return fmt::format(
      "{} has the seed of {}, {}{}: images of one seed may have parts of their noise in common, "
      "and the test for bias takes them to be independent; render each with another seed (--seed)",
      repeated.file, first, repeated.seed,
      repeated_seeds_ > 1 ? fmt::format(" ({} more repeat seeds)", repeated_seeds_ - 1) : "");
}

std::string ImagesOfSet::shared_warning(const ImagesOfSet& other) const {
  for (const auto& [hash, seen] : by_pixels_)
    if (const auto same = other.by_pixels_.find(hash); same != other.by_pixels_.end())
      return fmt::format(
          "{} and {} have the same pixels: images that both sides have in common hide a bias",
          seen.file, same->second.file);
  return "";
}

}  // namespace duet
