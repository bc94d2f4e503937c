#include "volume/nanovdb_file.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "volume/nanovdb_tree.h"

namespace duet {

namespace {

constexpr uint64_t kMagic = 0x304244566f6e614eull;  ///< "NanoVDB0"
constexpr uint32_t kMajorVersion = 32;
enum class Codec : uint16_t { none = 0, zip = 1, blosc = 2 };

/// What a file says about one of its grids before their data.
struct Entry {
  uint64_t memory = 0, stored = 0;  ///< bytes
  Codec codec = Codec::none;
  std::string name;
};

Entry read_entry(ByteReader& in) {
  Entry e;
  e.memory = in.take_value<uint64_t>("a grid's description");
  e.stored = in.take_value<uint64_t>("a grid's description");
  // Key, number of voxels, type, class, boxes, size of a voxel: they stand in the data again.
  in.take(8 + 8 + 4 + 4 + 48 + 24 + 24, "a grid's description");
  const auto name_size = in.take_value<uint32_t>("a grid's description");
  in.take(16 + 12, "a grid's description");
  e.codec = Codec(in.take_value<uint16_t>("a grid's description"));
  in.take(2 + 4, "a grid's description");
  if (name_size > 4096) in.fail("has a grid with a name of {} characters", name_size);
  const auto* text = reinterpret_cast<const char*>(in.take(name_size, "a grid's name"));
  e.name.assign(text, strnlen(text, name_size));
  return e;
}

/// `bytes` of the file.
std::vector<uint8_t> read_bytes(ByteReader& in, uint64_t bytes) {
  if (bytes > in.remaining()) in.fail("the file ends in the middle of a grid");
  std::vector<uint8_t> data(bytes);
  for (uint64_t done = 0; done < bytes;) {
    const size_t count = size_t(std::min<uint64_t>(bytes - done, ByteReader::kBlock));
    std::memcpy(&data[done], in.take(count, "a grid"), count);
    done += count;
  }
  return data;
}

NanoVdbBlob read_blob(ByteReader& in, const Entry& e) {
  // What zlib can make of so many bytes, at the most.
  constexpr uint64_t kMostRatio = 1032;
  if (e.memory == 0) in.fail("has a grid of no bytes");
  if (e.codec == Codec::zip) {
    const auto size = in.take_value<uint64_t>("a grid");
    const std::vector<uint8_t> packed = read_bytes(in, size);
    if (e.memory / kMostRatio > size) in.fail("has a grid that cannot have {} bytes", e.memory);
    NanoVdbBlob blob(e.memory);
    uLongf length = uLongf(e.memory);
    if (uncompress(blob.data(), &length, packed.data(), uLongf(size)) != Z_OK || length != e.memory)
      in.fail("has a grid that cannot be decompressed");
    return blob;
  }
  if (e.codec != Codec::none)
    in.fail("is compressed by Blosc; without compression or by zip it can be read");
  const std::vector<uint8_t> plain = read_bytes(in, e.memory);
  NanoVdbBlob blob(plain.size());
  std::memcpy(blob.data(), plain.data(), plain.size());
  return blob;
}

/// Nothing if there is no such grid; `names` are those of all then, for people.
std::optional<NanoVdbGrid> find_grid(ByteReader& in, const std::string& name, std::string& names) {
  in.end_text();
  while (in.remaining() > 0) {
    if (in.take_value<uint64_t>("its header") != kMagic) in.fail("is not a NanoVDB file");
    const uint32_t version = in.take_value<uint32_t>("its header") >> 21;
    if (version != kMajorVersion)
      in.fail("is of version {} of NanoVDB; only {} is known", version, kMajorVersion);
    const auto count = in.take_value<uint16_t>("its header");
    in.take(2, "its header");
    std::vector<Entry> entries(count);
    for (Entry& e : entries) e = read_entry(in);
    for (const Entry& e : entries) {
      const uint64_t start = in.position();
      if (e.name == name) {
        const NanoVdbBlob blob = read_blob(in, e);
        return dense_nanovdb_grid(blob, in);
      }
      names += (names.empty() ? "" : ", ") + ("\"" + e.name + "\"");
      if (e.stored > in.size() - start) in.fail("the file ends in the middle of a grid");
      in.seek(start + e.stored);
    }
  }
  return std::nullopt;
}

}  // namespace

NanoVdbGrid parse_nanovdb(ByteReader& in, const std::string& name) {
  std::string names;
  if (auto grid = find_grid(in, name, names)) return *std::move(grid);
  in.fail("has no grid \"{}\"; it has {}", name, names.empty() ? "none" : names);
}

NanoVdbGrid read_nanovdb(const std::string& file, const std::string& name) {
  return parse_file(file, [&](ByteReader& in) { return parse_nanovdb(in, name); });
}

std::optional<NanoVdbGrid> find_nanovdb(const std::string& file, const std::string& name) {
  return parse_file(file, [&](ByteReader& in) {
    std::string names;
    return find_grid(in, name, names);
  });
}

}  // namespace duet
