// Moves a scene through the time that the shutter is open.
#pragma once

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "scene/description.h"

namespace duet {

class SceneBuilder;

/// What moves, with the way that it takes.
struct Mover {
  enum class Kind { shape, instance, light, sensor };
  Kind kind;
  /// Among the shapes of the scene that are no instances, the instances, or the lights of the
  /// description. The sensor is the one that is looked through.
  uint32_t index = 0;
  Matrix4 first;  ///< what the motion moves
  Motion motion;
  std::shared_ptr<const TriangleMesh> mesh;  ///< of a shape that has one, in its own space
};

/// Takes from a description all that moves while a sensor's shutter is open, and leaves everything
/// standing: as it is when half the time is over or, if nothing moves, when the shutter opens.
/// A shape that neither shines nor measures becomes an instance, which is fast to move.
std::vector<Mover> take_movers(SceneDescription& description, size_t sensor);

/// Poses a scene. To be used between passes only, from one thread, by who holds a MotionLease.
class SceneMotion {
 public:
  /// `builder` has built the scene without errors, from what take_movers() left.
  SceneMotion(std::shared_ptr<SceneBuilder> builder, std::vector<Mover> movers, double open,
              double close);

  /// Puts everything where it is at a share of the time from the opening of the shutter (0) to its
  /// closing (1). Does nothing if it is there already.
  void pose(double share);
  /// Triangles that each pose moves and sorts anew.
  size_t moved_triangles() const;

 private:
  friend class MotionLease;
  std::shared_ptr<SceneBuilder> builder_;
  std::vector<Mover> movers_;
  double open_, close_;
  double share_ = 0.5;                     ///< where everything is
  std::atomic<std::thread::id> holder_{};  ///< of the lease, if any
};

/// The right to pose a scene and to look at it, while it lives: one thread at a time has it, which
/// renders one sample after the other. Of a scene that stands still, whose motion is null,
/// everybody may have one.
class MotionLease {
 public:
  /// A thread that has a lease may take further ones. Throws std::runtime_error if another thread
  /// has one.
  explicit MotionLease(SceneMotion* motion);
  ~MotionLease();
  MotionLease(const MotionLease&) = delete;
  MotionLease& operator=(const MotionLease&) = delete;

 private:
  SceneMotion* motion_;  ///< to be given back; null if there is nothing to give back
};

}  // namespace duet
