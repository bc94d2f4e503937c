#include "lights/emissive_mesh.h"

#include <array>

#include "math/warp.h"

namespace duet {

namespace {

/// Share of points on meshes with a tree that are chosen by what triangles emit.
constexpr float kEvenShare = 0.1f;
/// Triangles in a leaf of a tree: a few next to each other are nearly as good from anywhere.
constexpr uint32_t kTrianglesInLeaf = 4;

/// The probability of a triangle, from that with which the tree chooses it and its share of what
/// the mesh emits. (Triangles that emit nothing are not in the tree, so that its share is that of
/// all others.)
float mix(float by_tree, float even) {
  return lerp(by_tree, even, kEvenShare);
}

LightBounds triangle_bounds(const Shape& shape, uint32_t triangle, bool two_sided) {
  const TriangleMesh& mesh = *shape.mesh;
  LightBounds b;
  for (const uint32_t corner : mesh.triangles[triangle]) b.box.extend(mesh.positions[corner]);
  if (two_sided)
    b.normals = DirectionCone::all();
  else if (triangle_area(mesh, triangle) > 0)
    b.normals = {Vector3f(point_on_triangle(shape, triangle, {1 / 3.0f, 1 / 3.0f}).ng)};
  return b;
}

}  // namespace

LightBounds mesh_light_bounds(const Shape& shape, bool two_sided) {
  LightBounds all;
  for (uint32_t t = 0; t < shape.mesh->triangles.size(); ++t)
    all.extend(triangle_bounds(shape, t, two_sided));
  return all;
}

EmissiveMesh::EmissiveMesh(const Shape& shape, const ColorSlot& radiance, bool two_sided,
                           LightSelection selection)
    : shape_(shape), cells_(shape, radiance) {
  if (needs_tree(shape.mesh->triangles.size(), selection)) make_tree(two_sided);
}

void EmissiveMesh::make_tree(bool two_sided) {
  const uint32_t count = uint32_t(shape_.mesh->triangles.size());
  std::vector<LightTree::Entry> entries;
  entries.reserve(count);
  for (uint32_t t = 0; t < count; ++t) {
    LightBounds b = triangle_bounds(shape_, t, two_sided);
    b.power = cells_.probability(t);
    if (b.power > 0) entries.push_back({b, t});
  }
  tree_ = std::make_unique<LightTree>(std::move(entries), count, kTrianglesInLeaf);
}

bool EmissiveMesh::chooses_by_cells(double& fine) {
  const double share = double(kEvenShare);
  if (fine < share) {
    fine = double(std::min(float(fine) / kEvenShare, kBelowOne));
    return true;
  }
  fine = (fine - share) / (1 - share);
  return false;
}

float EmissiveMesh::probability(const Point3f& from, uint32_t triangle) const {
  const float even = tree_->power(triangle);
  return even > 0 ? mix(tree_->probability(triangle, from), even) : 0.0f;
}

EmissiveMesh::DirectPoint EmissiveMesh::sample_direct(const Point3f& from, const Point2f& u) const {
  if (!tree_) {
    const ShapePoint p = cells_.sample(u);
    return {p, p.pdf};
  }
  double fine = fine_variate(u.y, u);
  if (chooses_by_cells(fine)) {
    const ShapePoint p = cells_.sample({u.x, float(fine)});
    return {p, pdf_direct(from, p.primitive, p.barycentric)};
  }
  const LightTree::Pick pick = tree_->sample(fine, from);
  ShapePoint p = cells_.sample(pick.light, {u.x, pick.remapped});
  const PdfA pdf{p.pdf.value * mix(pick.probability, pick.power)};
  p.pdf = cells_.pdf(pick.light, p.barycentric);
  return {p, pdf};
}

PdfA EmissiveMesh::pdf_direct(const Point3f& from, uint32_t triangle,
                              const Point2f& barycentric) const {
  if (!tree_) return cells_.pdf(triangle, barycentric);
  const float chosen = probability(from, triangle);
  return {chosen > 0 ? cells_.pdf_within(triangle, barycentric).value * chosen : 0.0f};
}

void EmissiveMesh::choose(std::span<const Query> queries, Choice* choices) {
  constexpr size_t kAtOnce = NodeChoices::kPoints;
  std::array<LightTree::Query, kAtOnce> of_trees;
  std::array<LightTree::Pick, kAtOnce> picks;
  std::array<uint32_t, kAtOnce> waiting;
  for (size_t begin = 0; begin < queries.size(); begin += kAtOnce) {
    size_t count = 0;
    for (size_t k = begin; k < std::min(queries.size(), begin + kAtOnce); ++k) {
      const auto& [mesh, from, u] = queries[k];
      double fine = mesh->tree_ ? fine_variate(u.y, u) : 0;
      if (!mesh->tree_) {
        const auto [triangle, y] = mesh->cells_.choose(u);
        choices[k] = {triangle, y, 0};
      } else if (chooses_by_cells(fine)) {
        const auto [triangle, y] = mesh->cells_.choose({u.x, float(fine)});
        choices[k] = {triangle, y, mesh->probability(from, triangle)};
      } else {
        waiting[count] = uint32_t(k);
        of_trees[count++] = {mesh->tree_.get(), fine, from};
      }
    }
    LightTree::sample({of_trees.data(), count}, picks.data());
    for (size_t a = 0; a < count; ++a) {
      const LightTree::Pick& pick = picks[a];
      choices[waiting[a]] = {pick.light, pick.remapped, mix(pick.probability, pick.power)};
    }
  }
}

}  // namespace duet
