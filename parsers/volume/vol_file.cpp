#include "volume/vol_file.h"

#include <cmath>
#include <cstring>
#include <numbers>

namespace duet {

namespace {

enum class Encoding : int32_t { float32 = 1, float16 = 2, uint8 = 3, directions = 4 };

/// IEEE 754 binary16.
float half_to_float(uint16_t h) {
  const int exponent = h >> 10 & 31, mantissa = h & 1023;
  const float sign = h & 0x8000 ? -1.0f : 1.0f;
  if (exponent == 0) return sign * std::ldexp(float(mantissa), -24);
  if (exponent == 31) return mantissa ? NAN : sign * INFINITY;
  return sign * std::ldexp(float(mantissa + 1024), exponent - 25);
}

size_t bytes_per_node(Encoding encoding, int channels) {
  switch (encoding) {
    case Encoding::float32:
      return 4 * size_t(channels);
    case Encoding::float16:
      return 2 * size_t(channels);
    case Encoding::uint8:
      return size_t(channels);
    case Encoding::directions:
      return 2;
  }
  return 0;
}

/// Spherical coordinates in steps of π/255 and 2π/255.
void decode_direction(const uint8_t* bytes, float* out) {
  constexpr double step = std::numbers::pi / 255;
  const double theta = bytes[0] * step, phi = 2 * bytes[1] * step;
  out[0] = float(std::sin(theta) * std::cos(phi));
  out[1] = float(std::sin(theta) * std::sin(phi));
  out[2] = float(std::cos(theta));
}

void decode_node(Encoding encoding, const uint8_t* bytes, int channels, float* out) {
  if (encoding == Encoding::directions) return decode_direction(bytes, out);
  for (int c = 0; c < channels; ++c) {
    if (encoding == Encoding::float32) {
      std::memcpy(&out[c], bytes + 4 * c, 4);
    } else if (encoding == Encoding::float16) {
      uint16_t half;
      std::memcpy(&half, bytes + 2 * c, 2);
      out[c] = half_to_float(half);
    } else {
      out[c] = float(bytes[c]) / 255;
    }
  }
}

Encoding read_header(ByteReader& in, VolumeGrid& grid) {
  if (in.size() < 4 || std::memcmp(in.take(3, "the header"), "VOL", 3) != 0)
    in.fail("is not a volume file");
  if (const int version = in.take_value<uint8_t>("the header"); version != 3)
    in.fail("is of version {}; only 3 is known", version);
  const int encoding = in.take_value<int32_t>("the header");
  if (encoding < 1 || encoding > 4) in.fail("has the unknown encoding {}", encoding);
  for (int& n : grid.size) n = in.take_value<int32_t>("the header");
  const auto& [x, y, z] = grid.size;
  grid.channels = in.take_value<int32_t>("the header");
  constexpr int most = 1 << 16;
  for (const int n : grid.size)
    if (n < 1 || n > most) in.fail("has an impossible size of {} x {} x {}", x, y, z);
  if (grid.channels != 1 && grid.channels != 3 && grid.channels != 6)
    in.fail("has {} channels; there can be 1, 3 or 6", grid.channels);
  if (Encoding(encoding) == Encoding::directions && grid.channels != 3)
    in.fail("has directions with {} channels instead of 3", grid.channels);
  for (auto* corner : {&grid.lower, &grid.upper})
    for (float& v : *corner) v = in.take_value<float>("the header");
  for (size_t i = 0; i < 3; ++i)
    if (!std::isfinite(grid.lower[i]) || !std::isfinite(grid.upper[i]) ||
        !(grid.upper[i] > grid.lower[i]))
      in.fail("fills no box: from {} {} {} to {} {} {}", grid.lower[0], grid.lower[1],
              grid.lower[2], grid.upper[0], grid.upper[1], grid.upper[2]);
  return Encoding(encoding);
}

}  // namespace

VolumeFile parse_vol(ByteReader& in) {
  in.end_text();
  VolumeFile file;
  VolumeGrid& grid = file.grid;
  const Encoding encoding = read_header(in, grid);
  file.is_float32 = encoding == Encoding::float32;
  const size_t node_bytes = bytes_per_node(encoding, grid.channels);
  const size_t nodes = grid.node_count();
  if (in.remaining() / node_bytes < nodes)
    in.fail("ends in the middle of its values: {} bytes instead of {}", in.remaining(),
            nodes * node_bytes);
  const size_t channels = size_t(grid.channels);
  grid.values.resize(nodes * channels);
  for (size_t i = 0; i < nodes; ++i) {
    float* out = &grid.values[i * channels];
    decode_node(encoding, in.take(node_bytes, "its values"), grid.channels, out);
    for (size_t c = 0; c < channels; ++c)
      if (!std::isfinite(out[c])) in.fail("value {} is not finite", i * channels + c);
  }
  return file;
}

VolumeFile read_vol(const std::string& file) {
  return parse_file(file, parse_vol);
}

}  // namespace duet
