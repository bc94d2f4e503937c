// The parts of which a JPEG file is made.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>

namespace duet {

/// Calls `visit` with the marker of each segment before the pixels, and how many bytes of data it
/// has, which can be read from the file then. Ends early where `visit` returns false. Source: ITU-T
/// T.81, annex B.
template <class Visit>
void visit_jpeg_segments(std::FILE* file, const Visit& visit) {
  constexpr uint8_t kScan = 0xda;
  std::array<uint8_t, 4> head;
  for (long at = 2; std::fseek(file, at, SEEK_SET) == 0 &&
                    std::fread(head.data(), 1, head.size(), file) == head.size();) {
    const size_t length = size_t(head[2]) << 8 | head[3];
    if (head[0] != 0xff || head[1] == kScan || length < 2) return;
    if (!visit(head[1], length - 2)) return;
    at += long(2 + length);
  }
}

}  // namespace duet
