// What an image file says about itself, without its pixels.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace duet {

/// How a file stores its numbers.
enum class StoredNumbers { bytes, halves, others };

struct ImageFacts {
  int width = 0, height = 0;  ///< of the pixels that there are
  int channels = 0;           ///< of all layers
  StoredNumbers numbers = StoredNumbers::others;
  /// Of EXR files the attributes that are text, numbers or chromaticities, of PNG files the text
  /// chunks, of JPEG files the lines `name: value` of the comment.
  std::vector<std::pair<std::string, std::string>> fields;
  /// Whether the file goes on to its end: false if it has been cut off.
  bool is_complete = false;

  /// The value of the first field with this name; empty if there is none.
  std::string field(const std::string& name) const;
};

/// Reads the facts of an EXR, PNG or JPEG file, in a time that hardly depends on its size. Throws
/// ReadError if it is missing, empty, of another kind, or damaged before the pixels begin.
ImageFacts read_image_facts(const std::string& path);

}  // namespace duet
