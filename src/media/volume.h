// Quantities that vary in space: a grid of values, or a constant in its place.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "math/spectrum.h"
#include "math/transform.h"
#include "media/volume_grid.h"

namespace duet {

/// The box around a box's eight corners after `map`, from one space to another.
template <class Map>
void map_box(const Map& map, const Point3f& lower, const Point3f& upper, Point3f& mapped_lower,
             Point3f& mapped_upper) {
  mapped_lower = Point3f(INFINITY), mapped_upper = Point3f(-INFINITY);
  for (int corner = 0; corner < 8; ++corner) {
    Point3f p;
    for (int i = 0; i < 3; ++i) p[i] = corner >> i & 1 ? upper[i] : lower[i];
    p = map(p);
    for (int i = 0; i < 3; ++i) {
      mapped_lower[i] = std::min(mapped_lower[i], p[i]);
      mapped_upper[i] = std::max(mapped_upper[i], p[i]);
    }
  }
}

/// A symmetric 3×3 matrix: xx, yy, zz, xy, xz, yz.
using SymmetricMatrix = std::array<float, 6>;

/// A grid placed in the world.
class GridVolume {
 public:
  /// The unit cube is the grid's own space.
  GridVolume(std::shared_ptr<const VolumeGrid> grid, const Matrix4& to_world, VolumeFilter filter,
             VolumeWrap wrap, VolumeNodes nodes);

  int channels() const { return grid_->channels; }
  const VolumeGrid& grid() const { return *grid_; }
  /// How many different values there may be along each axis of the unit cube.
  const std::array<int, 3>& resolution() const { return grid_->size; }
  Point3f to_local(const Point3f& p) const { return to_world_.inverse(p); }
  Vector3f to_local(const Vector3f& v) const { return to_world_.inverse(v); }

  /// The value at a point of the grid's own space. A colour asked for a number yields its
  /// luminance.
  float local_value(const Point3f& p) const;
  Spectrum local_color(const Point3f& p) const;
  /// The same at a point of the world.
  float value(const Point3f& p) const { return local_value(to_local(p)); }
  Spectrum color(const Point3f& p) const { return local_color(to_local(p)); }
  SymmetricMatrix matrix(const Point3f& p) const;

  /// The box in the world outside of which there is nothing, whatever a lookup says: around the
  /// unit cube, as in Mitsuba 3.
  void world_box(Point3f& lower, Point3f& upper) const;

  /// The greatest value of any channel that local_value() and local_color() yield in the box
  /// between two points of the grid's own space.
  float maximum(const Point3f& lower, const Point3f& upper) const;

 private:
  /// The eight nodes around a point, or one if nothing is interpolated, and what each counts.
  struct Neighbours {
    size_t node[8];
    float weight[8];
    int count;
  };
  Neighbours neighbours(const Point3f& p) const;
  float node_coordinate(float x, int axis) const;
  int wrapped(int i, int axis) const;

  std::shared_ptr<const VolumeGrid> grid_;
  Transform to_world_;
  VolumeFilter filter_;
  VolumeWrap wrap_;
  VolumeNodes nodes_;
};

struct ColorVolumeSlot {
  Spectrum constant;
  const GridVolume* grid = nullptr;
  Spectrum operator()(const Point3f& p) const { return grid ? grid->color(p) : constant; }
};

struct FloatVolumeSlot {
  float constant = 0;
  const GridVolume* grid = nullptr;
  float operator()(const Point3f& p) const { return grid ? grid->value(p) : constant; }
};

struct MatrixVolume {
  SymmetricMatrix constant{};
  const GridVolume* grid = nullptr;
  SymmetricMatrix operator()(const Point3f& p) const { return grid ? grid->matrix(p) : constant; }
};

}  // namespace duet
