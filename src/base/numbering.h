// Numbers distinct things 0, 1, 2, … in the order in which they first appear (a hash table of
// indices).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace duet {

/// The table holds numbers only; the caller keeps the things themselves, in an array by number.
class Numbering {
 public:
  Numbering() : Numbering(0) {}
  explicit Numbering(size_t expected) {
    size_t slots = 16;
    while (slots < 2 * expected) slots *= 2;
    slots_.assign(slots, kEmpty);
    hashes_.reserve(expected);
  }

  /// How many distinct things there are.
  uint32_t size() const { return uint32_t(hashes_.size()); }

  /// The number of the thing with this hash for which `is_same(number)` holds; if there is none,
  /// the next free number, which is size() before the call.
  template <class IsSame>
  uint32_t number(uint64_t hash, IsSame is_same) {
    const uint32_t h = uint32_t(hash);
    for (size_t i = h & mask();; i = (i + 1) & mask()) {
      const uint32_t n = slots_[i];
      if (n == kEmpty) {
        slots_[i] = size();
        hashes_.push_back(h);
        if (2 * hashes_.size() > slots_.size()) grow();
        return size() - 1;
      }
      if (hashes_[n] == h && is_same(n)) return n;
    }
  }

 private:
  static constexpr uint32_t kEmpty = 0xffffffff;
  size_t mask() const { return slots_.size() - 1; }
  void grow() {
    slots_.assign(2 * slots_.size(), kEmpty);
    for (uint32_t n = 0; n < size(); ++n) {
      size_t i = hashes_[n] & mask();
      while (slots_[i] != kEmpty) i = (i + 1) & mask();
      slots_[i] = n;
    }
  }

  std::vector<uint32_t> slots_;   ///< a number or kEmpty; the count is a power of two
  std::vector<uint32_t> hashes_;  ///< by number
};

}  // namespace duet
