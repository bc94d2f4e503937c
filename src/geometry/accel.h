// Ray queries against all shapes of a scene.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/ray_batch.h"
#include "geometry/shape.h"

namespace duet {

/// Whether update() will be called: then only what has moved is sorted anew, and rays are slower.
enum class AccelUse { still, moving };

/// From so many instances on, where nothing in the scene moves, they are one geometry, which needs
/// a fifth of the memory of as many.
inline constexpr size_t kManyInstances = 1 << 16;

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
  /// The same for the first `n` rays of a batch, in packets as wide as the machine's registers.
  /// What is found depends on the other rays only where two surfaces are equally near, or by
  /// rounding at the edge of one. `blocked` is 1 or 0. Beyond the first n the results are anything.
  void closest_hits(const RayBatch& rays, int n, HitBatch& hits) const;
  void occluded(const RayBatch& rays, int n, BatchArray<int32_t>& blocked) const;
  /// The box around everything.
  Bounds bounds() const;

 private:
  struct Device;
  void choose_packets(const std::vector<Shape>& shapes);
  void attach_instances(AccelUse use);
  template <int kWidth>
  void intersect_packets(const RayBatch& rays, int n, HitBatch& hits) const;
  template <int kWidth>
  void occlude_packets(const RayBatch& rays, int n, BatchArray<int32_t>& blocked) const;

  std::unique_ptr<Device> device_;
  /// Copies of what the queries need, so that they follow one pointer less.
  void* scene_ = nullptr;
  uint32_t top_first_ = 0, top_count_ = 0;
  const std::vector<ShapeRange>* groups_ = nullptr;
  const std::vector<Instance>* instances_ = nullptr;
  int packet_ = 1;  ///< how many rays are traced at once
};

/// The version of Embree, such as "3.13.5".
const char* embree_version();

}  // namespace duet
