// Cryptomatte: mattes of all things in an image, as layers of ids and coverages by rank.
//
// Source: Friedman & Jones, "Fully Automatic ID Mattes with Support for Motion Blur and
// Transparency", SIGGRAPH 2015 posters, and Psyop's Cryptomatte specification 1.2.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace duet {

/// What a matte tells apart.
enum class MatteKind { object, material };
inline constexpr std::string_view kMatteKinds[] = {"object", "material"};

/// The kinds of these names, each once and in this order. Throws std::invalid_argument for others.
std::vector<MatteKind> matte_kinds(const std::vector<std::string>& names);

/// How many things a pixel can have, those that cover most of it. A layer holds two of them.
inline constexpr size_t kMatteRanks = 6;

/// MurmurHash3 of 32 bits with the seed 0. Source: Appleby, MurmurHash3_x86_32.
uint32_t murmur3_32(std::string_view text);

/// The id of a thing, by its name: its hash, with another exponent where it would be a float that
/// is no normal number.
uint32_t matte_id(std::string_view name);
/// The float with these bits.
float matte_value(uint32_t id);

/// "CryptoObject" or "CryptoMaterial".
std::string matte_name(MatteKind kind);
/// "CryptoObject00.R" (id), "CryptoObject00.G" (coverage), "CryptoObject00.B" (the next id) …
std::vector<std::string> matte_channels(MatteKind kind);
/// Whether a channel is one of those of any matte.
bool is_matte_channel(std::string_view channel);

/// What the names of header fields begin with that say how to read mattes.
inline constexpr std::string_view kMatteFields = "cryptomatte/";

}  // namespace duet
