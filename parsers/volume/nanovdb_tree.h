// The tree of a NanoVDB grid in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>

#include "volume/nanovdb_file.h"

namespace duet {

/// The bytes of a grid, as aligned as NanoVDB's structures are.
class NanoVdbBlob {
 public:
  explicit NanoVdbBlob(size_t size)
      : data_(static_cast<uint8_t*>(::operator new(size, std::align_val_t(kAlignment)))),
        size_(size) {}
  NanoVdbBlob(NanoVdbBlob&& o) noexcept : data_(o.data_), size_(o.size_) { o.data_ = nullptr; }
  NanoVdbBlob& operator=(NanoVdbBlob&&) = delete;
  ~NanoVdbBlob() { ::operator delete(data_, std::align_val_t(kAlignment)); }

  uint8_t* data() { return data_; }
  const uint8_t* data() const { return data_; }
  size_t size() const { return size_; }

 private:
  static constexpr size_t kAlignment = 32;
  uint8_t* data_;
  size_t size_;
};

/// All voxels in the box of the active ones. What the grid says of itself is not trusted: messages
/// go to `in`, as for read_nanovdb().
NanoVdbGrid dense_nanovdb_grid(const NanoVdbBlob& blob, const ByteReader& in);

}  // namespace duet
