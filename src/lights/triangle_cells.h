// Chooses points on a mesh by how much it emits.
#pragma once

#include "geometry/surface.h"
#include "math/distribution.h"
#include "textures/texture.h"

namespace duet {

/// Divides each triangle of a mesh into n² equal cells, as fine as the texture of its radiance if
/// there is one (else n = 1), and picks cells in proportion to the light that they emit. A part of
/// the probability is spread evenly, so that no cell is missed whose light the table did not see.
class TriangleCells {
 public:
  /// `shape` is a mesh and must stay where it is.
  TriangleCells(const Shape& shape, const ColorSlot& radiance);

  /// A point with its density per area.
  ShapePoint sample(const Point2f& u) const;
  /// A point of one triangle, with its density per area of that; it must emit.
  ShapePoint sample(uint32_t triangle, const Point2f& u) const;
  /// If the radiance is the same everywhere: the triangle of sample(u), and what takes the place of
  /// u.y on it.
  struct Choice {
    uint32_t triangle;
    float y;
  };
  Choice choose(const Point2f& u) const {
    const auto pick = cells_.sample(u.y, u);
    return {pick.index, pick.remapped};
  }
  /// The probability with which sample(u) chooses the triangle.
  float probability(uint32_t triangle) const {
    const uint32_t count = uint32_t(n_) * uint32_t(n_);
    return cells_.probability(triangle * count, count);
  }
  /// The density with which sample(triangle, u) makes a point of it.
  PdfA pdf_within(uint32_t triangle, const Point2f& barycentric) const;
  /// The density with which sample(u) makes a point of the mesh.
  PdfA pdf(uint32_t primitive, const Point2f& barycentric) const;
  /// Integral of the radiance's luminance over the mesh's area.
  double integral() const { return integral_; }

 private:
  /// Number of the cell within its triangle, and back: the corner with the smallest coordinates, in
  /// units of 1/n, of a cell, and whether it points the other way than the triangle.
  uint32_t cell_at(const Point2f& barycentric) const;
  struct Cell {
    int i, j;
    bool upper;
  };
  Cell cell(uint32_t number) const;
  /// Barycentric coordinates of the point that is at `b` in a cell's own.
  Point2f within(const Cell& cell, const Point2f& b) const;
  void choose_resolution(const ColorSlot& radiance);

  const Shape& shape_;
  int n_ = 1;
  int points_ = 1;  ///< at which the radiance of a cell is looked up
  DiscreteDistribution cells_;
  double integral_ = 0;
  PdfA uniform_;  ///< if the radiance is constant
};

}  // namespace duet
