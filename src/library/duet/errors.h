// What the library throws beside std::invalid_argument (settings and paths that make no sense),
// std::out_of_range (a sensor or a window that there is not) and std::bad_alloc.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace duet {

/// An error or a warning about a scene.
struct SceneMessage {
  bool is_error = true;
  /// The file, or of a description the object ("scene.ball.radius"); "" if it is not known.
  std::string file;
  int line = 0, column = 0;  ///< from 1; 0 if they are not known, and in descriptions
  std::string text;          ///< "file:line:column: error: what is wrong"
};

/// Errors in a scene; what() has all of them, a line each.
class [[gnu::visibility("default")]] SceneError : public std::runtime_error {
 public:
  /// With all messages, warnings among them; the first error of them is first(), which is empty if
  /// there is none.
  explicit SceneError(std::vector<SceneMessage> messages);
  const std::vector<SceneMessage>& messages() const {
    return messages_;
  }
  const SceneMessage& first() const;

 private:
  std::vector<SceneMessage> messages_;
};

/// A file that cannot be read or written; what() names it.
class [[gnu::visibility("default")]] FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Open Image Denoise is asked for, and cannot be loaded or has failed.
class [[gnu::visibility("default")]] DenoiserError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// There is not enough memory, or not as much as DUET_MEMORY_LIMIT allows.
class [[gnu::visibility("default")]] MemoryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace duet
