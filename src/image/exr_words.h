// OpenEXR files of unsigned integers, which are read and written row by row: their planes may be
// larger than the memory that is left.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "image/text_fields.h"

namespace duet {

/// A part of the file. Channels are words of 32 bits.
struct WordPlane {
  std::string name;
  int width = 0, height = 0;
  std::vector<std::string> channels;  ///< in the order of a pixel's words in a row
};

/// Writes planes, and texts as attributes of the first. `row(plane, y, words)` is to fill in the
/// words of a row, pixel by pixel; it is called row after row. Throws std::runtime_error, which
/// names `path`; what was there before stays then.
void write_words(const std::string& path, std::span<const WordPlane> planes,
                 const TextFields& texts,
                 const std::function<void(size_t, int, std::span<uint32_t>)>& row);

/// All functions throw ReadError, which names the file.
class WordReader {
 public:
  explicit WordReader(const std::string& path);
  ~WordReader();
  /// A text attribute of the first plane; nothing if there is none.
  const std::string* text(const std::string& name) const;
  /// Reads the part of a plane's name, which must have its size and its channels. Calls
  /// `row(y, words)` row after row.
  void read(const WordPlane& plane,
            const std::function<void(int, std::span<const uint32_t>)>& row) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace duet
