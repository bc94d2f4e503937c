// Reads the numbers of a PLY file's elements one after the other, whatever their format and type.
#pragma once

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <system_error>

#include "mesh/ply_header.h"

namespace duet {

/// From IEEE 754 binary16.
inline float half_to_float(uint16_t h) {
  const uint32_t exponent = (h >> 10) & 31, mantissa = h & 1023;
  const float sign = h & 0x8000 ? -1.0f : 1.0f;
  if (exponent == 0) return sign * float(mantissa) * 0x1p-24f;
  if (exponent == 31) return mantissa ? NAN : sign * INFINITY;
  return sign * std::ldexp(float(1024 + mantissa), int(exponent) - 25);
}

class PlyValues {
 public:
  PlyValues(ByteReader& in, PlyFormat format)
      : in_(in),
        ascii_(format == PlyFormat::ascii),
        swap_((format == PlyFormat::big_endian) != (std::endian::native == std::endian::big)) {}

  /// The next number. Exact in double but for 64-bit integers beyond 2⁵³.
  double next(PlyType type, const char* what) {
    return ascii_ ? text(what) : binary(in_.take(size_in_bytes(type), what), type);
  }

  /// The next number, which must be an integer ≥ 0.
  uint64_t next_count(PlyType type, const char* what) {
    const double x = next(type, what);
    if (!(x >= 0 && x < 0x1p53) || x != std::floor(x)) in_.fail("{} cannot be {}", what, x);
    return uint64_t(x);
  }

  void skip(const PlyProperty& property) {
    const uint64_t n =
        property.is_list ? next_count(property.count_type, "the length of a list") : 1;
    for (uint64_t i = 0; i < n; ++i) next(property.type, "a property");
  }

 private:
  double text(const char* what) {
    const std::string_view word = in_.next_word();
    if (word.empty()) in_.fail("the file ends before {}", what);
    const std::string_view digits = word[0] == '+' ? word.substr(1) : word;
    double x = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), x);
    // Out of range is so large that it is infinite, or so small that it is zero.
    if (error == std::errc::result_out_of_range)
      x = digits.find("e-") == digits.npos && digits.find("E-") == digits.npos ? INFINITY : 0;
    if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
      in_.fail("\"{}\" is not a number ({})", word, what);
    return x;
  }

  template <class T>
  double as(const uint8_t* bytes) const {
    uint8_t ordered[sizeof(T)];
    for (size_t i = 0; i < sizeof(T); ++i) ordered[i] = bytes[swap_ ? sizeof(T) - 1 - i : i];
    T value;
    std::memcpy(&value, ordered, sizeof(T));
    return double(value);
  }

  double binary(const uint8_t* bytes, PlyType type) const {
    switch (type) {
      case PlyType::int8:
        return as<int8_t>(bytes);
      case PlyType::uint8:
        return as<uint8_t>(bytes);
      case PlyType::int16:
        return as<int16_t>(bytes);
      case PlyType::uint16:
        return as<uint16_t>(bytes);
      case PlyType::int32:
        return as<int32_t>(bytes);
      case PlyType::uint32:
        return as<uint32_t>(bytes);
      case PlyType::int64:
        return as<int64_t>(bytes);
      case PlyType::uint64:
        return as<uint64_t>(bytes);
      case PlyType::float16:
        return half_to_float(uint16_t(as<uint16_t>(bytes)));
      case PlyType::float32:
        return as<float>(bytes);
      case PlyType::float64:
        return as<double>(bytes);
    }
    return 0;
  }

  ByteReader& in_;
  bool ascii_, swap_;
};

}  // namespace duet
