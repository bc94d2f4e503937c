#include "image/cryptomatte.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace duet {

namespace {

/// The bytes of a word, lowest first, whatever the machine's order.
uint32_t word_at(std::string_view bytes) {
  uint32_t word = 0;
  for (size_t i = 0; i < bytes.size(); ++i)
    word |= uint32_t(static_cast<unsigned char>(bytes[i])) << (8 * i);
  return word;
}

uint32_t scrambled(uint32_t word) {
  return std::rotl(word * 0xcc9e2d51u, 15) * 0x1b873593u;
}

}  // namespace

std::vector<MatteKind> matte_kinds(const std::vector<std::string>& names) {
  std::vector<MatteKind> kinds;
  for (const std::string& name : names)
    if (std::ranges::find(kMatteKinds, name) == std::end(kMatteKinds))
      throw std::invalid_argument(fmt::format("there are no mattes of \"{}\"; there are {}", name,
                                              fmt::join(kMatteKinds, " ")));
  for (size_t kind = 0; kind < std::size(kMatteKinds); ++kind)
    if (std::ranges::find(names, kMatteKinds[kind]) != names.end())
      kinds.push_back(MatteKind(kind));
  return kinds;
}

uint32_t murmur3_32(std::string_view text) {
  uint32_t hash = 0;
  std::string_view rest = text;
  for (; rest.size() >= 4; rest.remove_prefix(4))
    hash = std::rotl(hash ^ scrambled(word_at(rest.substr(0, 4))), 13) * 5 + 0xe6546b64u;
  hash ^= scrambled(word_at(rest));
  hash ^= uint32_t(text.size());
  hash = (hash ^ hash >> 16) * 0x85ebca6bu;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
  return hash ^ hash >> 16;
}

uint32_t matte_id(std::string_view name) {
  const uint32_t hash = murmur3_32(name), exponent = hash >> 23 & 255;
  return exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash;
}

float matte_value(uint32_t id) {
  return std::bit_cast<float>(id);
}

std::string matte_name(MatteKind kind) {
  return kind == MatteKind::object ? "CryptoObject" : "CryptoMaterial";
}

std::vector<std::string> matte_channels(MatteKind kind) {
  std::vector<std::string> names;
  for (size_t layer = 0; layer < kMatteRanks / 2; ++layer)
    for (const char letter : {'R', 'G', 'B', 'A'})
      names.push_back(fmt::format("{}{:02}.{}", matte_name(kind), layer, letter));
  return names;
}

bool is_matte_channel(std::string_view channel) {
  for (const MatteKind kind : {MatteKind::object, MatteKind::material}) {
    const std::vector<std::string> names = matte_channels(kind);
    if (std::find(names.begin(), names.end(), channel) != names.end()) return true;
  }
  return false;
}

}  // namespace duet
