// Mitsuba's own binary meshes, versions 3 (Mitsuba 0.2 to 0.4) and 4: several zlib streams, each a
// mesh, and a table of their positions at the end of the file.
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "mesh/formats.h"

namespace duet {

namespace {

constexpr uint16_t kMagic = 0x041c;
constexpr uint32_t kHasNormals = 0x1, kHasTexcoords = 0x2, kHasColors = 0x8, kFaceNormals = 0x10,
                   kDoublePrecision = 0x2000;
/// DEFLATE encodes at most 258 bytes by two bits.
constexpr uint64_t kGreatestRatio = 1032;

/// Where mesh `index` begins, from the table at the end of the file.
uint64_t find_mesh(ByteReader& in, int version, int index) {
  if (index < 0) in.fail("there is no mesh {}", index);
  // A file of one mesh may lack the table.
  if (index == 0) return 0;
  in.seek(in.size() - sizeof(uint32_t));
  const uint64_t count = in.take_value<uint32_t>("the number of meshes");
  const uint64_t entry = version == 4 ? sizeof(uint64_t) : sizeof(uint32_t);
  if (count > (in.size() - sizeof(uint32_t)) / entry)
    in.fail("the table of meshes is damaged (it has {} entries)", count);
  if (uint64_t(index) >= count) in.fail("there is no mesh {}; there are {}", index, count);
  in.seek(in.size() - sizeof(uint32_t) - (count - uint64_t(index)) * entry);
  const uint64_t position = version == 4 ? in.take_value<uint64_t>("the table of meshes")
                                         : in.take_value<uint32_t>("the table of meshes");
  if (position > in.size()) in.fail("the table of meshes is damaged (mesh at byte {})", position);
  return position;
}

/// Decompresses a zlib stream.
class Inflater {
 public:
  explicit Inflater(ByteReader& in) : in_(in) {
    if (inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Fills `count` bytes. Throws ReadError if the data are damaged or end before.
  void read(void* target, size_t count) {
    if (inflate_some(target, count) < count) in_.fail("the mesh ends before all its data");
  }
  template <class T>
  T read() {
    T value;
    read(&value, sizeof(T));
    return value;
  }
  /// Reads the rest of the stream, and so its checksum.
  void finish() {
    uint8_t rest[4096];
    while (inflate_some(rest, sizeof(rest)) > 0) {
    }
  }
  /// Upper bound of what can still be read.
  uint64_t greatest_rest() const { return (in_.remaining() + 1) * kGreatestRatio; }

 private:
  /// As many bytes as there are, up to `count`.
  size_t inflate_some(void* target, size_t count) {
    size_t done = 0;
    while (done < count && !ended_) {
      const std::span<const uint8_t> input = in_.peek(ByteReader::kBlock / 2);
      if (input.empty()) in_.fail("the file ends in the middle of the mesh");
      const uInt offered = uInt(std::min<size_t>(input.size(), ByteReader::kBlock));
      const uInt wanted = uInt(std::min<size_t>(count - done, size_t(1) << 30));
      stream_.next_in = const_cast<Bytef*>(input.data());
      stream_.avail_in = offered;
      stream_.next_out = static_cast<Bytef*>(target) + done;
      stream_.avail_out = wanted;
      const int status = inflate(&stream_, Z_NO_FLUSH);
      if (status == Z_MEM_ERROR) throw std::bad_alloc();
      if (status != Z_OK && status != Z_STREAM_END)
        in_.fail("the compressed data are damaged ({})", stream_.msg ? stream_.msg : "no progress");
      in_.skip(offered - stream_.avail_in);
      done += wanted - stream_.avail_out;
      ended_ = status == Z_STREAM_END;
    }
    return done;
  }

  ByteReader& in_;
  z_stream stream_{};
  bool ended_ = false;
};

/// Reads count × width numbers. Memory is filled as the data arrive, so that a false count costs
/// none.
void read_numbers(Inflater& data, bool is_double, size_t count, std::vector<float>& values) {
  constexpr size_t kChunk = size_t(1) << 16;
  values.reserve(count);
  std::vector<double> chunk;
  while (values.size() < count) {
    const size_t n = std::min(kChunk, count - values.size());
    if (is_double) {
      chunk.resize(n);
      data.read(chunk.data(), n * sizeof(double));
      values.insert(values.end(), chunk.begin(), chunk.end());
    } else {
      values.resize(values.size() + n);
      data.read(values.data() + values.size() - n, n * sizeof(float));
    }
  }
}

/// Reads `count` elements made of single-precision numbers, or skips them.
template <class T>
void read_tuples(Inflater& data, bool is_double, size_t count, std::vector<T>& result, bool keep) {
  constexpr size_t kWidth = sizeof(T) / sizeof(float), kChunk = size_t(1) << 16;
  if (keep) result.reserve(count);
  std::vector<float> single;
  for (size_t done = 0; done < count;) {
    const size_t n = std::min(kChunk, count - done);
    single.clear();
    read_numbers(data, is_double, n * kWidth, single);
    done += n;
    if (!keep) continue;
    result.resize(done);
    std::memcpy(static_cast<void*>(result.data() + done - n), single.data(), n * sizeof(T));
  }
}

}  // namespace

TriangleMesh parse_serialized(ByteReader& in, const MeshOptions& options) {
  const char* const kHeader = "the header";
  if (in.take_value<uint16_t>(kHeader) != kMagic) in.fail("not a .serialized file");
  const int version = in.take_value<uint16_t>(kHeader);
  if (version != 3 && version != 4)
    in.fail("is of version {}; only versions 3 and 4 can be read", version);
  in.seek(find_mesh(in, version, options.shape_index));
  if (in.take_value<uint16_t>(kHeader) != kMagic)
    in.fail("mesh {} does not begin where the table says", options.shape_index);
  in.take(sizeof(uint16_t), kHeader);

  Inflater data(in);
  const uint32_t flags = data.read<uint32_t>();
  if (version == 4) {
    size_t length = 0;
    while (data.read<char>() != 0)
      if (++length > 65536) in.fail("the name of the mesh does not end");
  }
  const uint64_t vertices = data.read<uint64_t>(), triangles = data.read<uint64_t>();
  const bool is_double = flags & kDoublePrecision;
  const uint64_t vertex_bytes =
      (is_double ? 8 : 4) * (3u + (flags & kHasNormals ? 3 : 0) + (flags & kHasTexcoords ? 2 : 0) +
                             (flags & kHasColors ? 3 : 0));
  const uint64_t limit = data.greatest_rest();
  if (vertices > limit / vertex_bytes || triangles > limit / 12 ||
      vertices > std::numeric_limits<uint32_t>::max())
    in.fail("{} vertices and {} triangles are more than the file can hold", vertices, triangles);

  MeshOptions effective = options;
  if (options.dialect == MeshDialect::mitsuba0 && (flags & kFaceNormals))
    effective.face_normals = true;
  TriangleMesh mesh;
  read_tuples(data, is_double, vertices, mesh.positions, true);
  if (flags & kHasNormals)
    read_tuples(data, is_double, vertices, mesh.normals,
                !effective.face_normals && !options.max_smooth_angle);
  if (flags & kHasTexcoords) read_tuples(data, is_double, vertices, mesh.uvs, true);
  if (flags & kHasColors) {
    MeshAttribute& colors = mesh.attributes.emplace_back();
    colors.name = "vertex_color";
    read_numbers(data, is_double, 3 * vertices, colors.data);
  }
  mesh.triangles.reserve(triangles);
  constexpr size_t kChunk = size_t(1) << 16;
  while (mesh.triangles.size() < triangles) {
    const size_t n = std::min<size_t>(kChunk, triangles - mesh.triangles.size());
    mesh.triangles.resize(mesh.triangles.size() + n);
    data.read(mesh.triangles.data() + mesh.triangles.size() - n, n * 3 * sizeof(uint32_t));
  }
  data.finish();
  finish_mesh(in, effective, mesh);
  return mesh;
}

}  // namespace duet
