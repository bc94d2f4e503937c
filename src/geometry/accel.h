// Ray queries against all shapes of a scene.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/shape.h"

namespace duet {

/// Whether update() will be called: then only what has moved is sorted anew, and rays are slower.
enum class AccelUse { still, moving };

/// An acceleration structure over shapes that must outlive it and stay where they are.
class Accel {
 public:
  /// The shapes in `top` stand in the scene directly; those of `groups` only through instances.
  /// `threads` bounds the threads used to build. Throws std::runtime_error if memory runs out.
  Accel(const std::vector<Shape>& shapes, ShapeRange top, const std::vector<ShapeRange>& groups,
        const std::vector<Instance>& instances, int threads, AccelUse use = AccelUse::still);
  ~Accel();
  Accel(const Accel&) = delete;
  Accel& operator=(const Accel&) = delete;

  /// Takes note of new places of some of the `top` shapes (as indices of all shapes) and of the
  /// instances. Meshes keep their arrays.
  void update(std::span<const uint32_t> shapes, std::span<const uint32_t> instances);

  /// The nearest hit with 0 < t < ray.tmax.
  bool closest_hit(const Ray& ray, Hit& hit) const;
  /// Whether anything lies between the ray's origin and ray.tmax.
  bool occluded(const Ray& ray) const;
  /// The box around everything.
  Bounds bounds() const;

 private:
  struct Device;
  void set_lead(const std::vector<Shape>& shapes, ShapeRange top);

  std::unique_ptr<Device> device_;
  /// Copies of what the queries need, so that they follow one pointer less.
  void* scene_ = nullptr;
  uint32_t top_first_ = 0, top_count_ = 0;
  const std::vector<ShapeRange>* groups_ = nullptr;
  const std::vector<Instance>* instances_ = nullptr;
  /// How far before their origin rays begin for Embree, which keeps what it finds there to itself.
  float lead_ = 0;
};

/// The version of Embree, such as "3.13.5".
const char* embree_version();

}  // namespace duet
