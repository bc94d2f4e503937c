// Where a scene stands among those of one call, and how long the others may take.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace duet {

class Batch {
 public:
  explicit Batch(size_t scenes) : scenes_(scenes) {}

  void begin_scene();
  /// `rendered`: whether the time it took says something about the others.
  void end_scene(bool rendered);

  /// Whether there are several scenes.
  bool is_several() const { return scenes_ > 1; }
  /// "[3/45] " while the third scene is under way; nothing if it is the only one.
  std::string label() const;
  /// Seconds until all scenes are done, if this one takes `scene_left` more and those to come take
  /// the mean of it and of those that were rendered.
  double seconds_left(double scene_left) const;

 private:
  using Clock = std::chrono::steady_clock;
  double scene_seconds() const;

  size_t scenes_, current_ = 0, rendered_ = 0;
  double rendered_seconds_ = 0;
  Clock::time_point scene_start_ = Clock::now();
};

}  // namespace duet
