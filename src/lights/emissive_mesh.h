// Where on a mesh that emits light samples end and emitted rays start.
#pragma once

#include <memory>
#include <span>

#include "lights/light_tree.h"
#include "lights/triangle_cells.h"

namespace duet {

/// What light from a mesh is bounded by, without power.
LightBounds mesh_light_bounds(const Shape& shape, bool two_sided);

/// Chooses points of a mesh: for emitted rays by what they emit; for light samples by a tree over
/// what triangles send to a point, if there is one, else in the same way.
class EmissiveMesh {
 public:
  /// `shape` is a mesh and must stay where it is.
  EmissiveMesh(const Shape& shape, const ColorSlot& radiance, bool two_sided,
               LightSelection selection);

  /// The choice for emitted rays.
  const TriangleCells& cells() const { return cells_; }

  /// A light sample's point: with the density of cells() there, and its own.
  struct DirectPoint {
    ShapePoint point;
    PdfA pdf;
  };
  DirectPoint sample_direct(const Point3f& from, const Point2f& u) const;
  /// The density with which sample_direct() makes a point of a triangle.
  PdfA pdf_direct(const Point3f& from, uint32_t triangle, const Point2f& barycentric) const;

  /// By which light samples choose triangles, or null.
  const LightTree* tree() const { return tree_.get(); }
  struct Query {
    const EmissiveMesh* mesh;
    Point3f from;
    Point2f u;
  };
  struct Choice {
    uint32_t triangle;
    float y;  ///< with u.x the place on the triangle, by square_to_triangle()
    /// With a tree: with which sample_direct() chooses the triangle.
    float probability;
  };
  /// The choices of sample_direct() for many points, with the same bits. Only of meshes whose
  /// radiance is the same everywhere.
  static void choose(std::span<const Query> queries, Choice* choices);

 private:
  void make_tree(bool two_sided);
  float probability(const Point3f& from, uint32_t triangle) const;
  /// Whether a number chooses by cells(): it is then remapped to [0, 1), else to that of the tree.
  static bool chooses_by_cells(double& fine);
  const Shape& shape_;
  TriangleCells cells_;
  std::unique_ptr<const LightTree> tree_;
};

}  // namespace duet
