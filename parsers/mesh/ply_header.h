// The header of a PLY file: which elements of which properties follow.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/byte_reader.h"

namespace duet {

enum class PlyFormat { ascii, little_endian, big_endian };

/// The types of the format's first description, and Mitsuba's 64-bit integers and half floats.
enum class PlyType {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float16,
  float32,
  float64
};
/// Size in a binary file.
size_t size_in_bytes(PlyType type);
bool is_integer(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type;
  bool is_list = false;
  PlyType count_type{};  ///< of a list
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// Index of a property that is a single number, or −1.
  int find(const std::string& name) const;
  /// The fewest bytes that one element takes up in the file.
  uint64_t least_bytes(PlyFormat format) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
};

/// Leaves the reader at the first byte after the header. Checks that the file is large enough for
/// the elements it announces.
PlyHeader read_ply_header(ByteReader& in);

}  // namespace duet
