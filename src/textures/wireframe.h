// The edges of triangles.
#pragma once

#include <optional>

#include "textures/shape_texture.h"

namespace duet {

struct WireframeOptions {
  Spectrum interior, edge;
  /// Distance from an edge at which its colour has gone, in the space of the mesh; without: a tenth
  /// of the mesh's mean edge length.
  std::optional<float> line_width;
  /// The share of the line width, at its end, over which the colours change; from 0 to 1.
  float step_width = 0.5f;
};

/// One colour along the edges of the mesh that is hit and another between them; the latter
/// everywhere on shapes that are no meshes. Meshes of a group have their lines before the group is
/// placed.
class Wireframe final : public ShapeTexture {
 public:
  explicit Wireframe(const WireframeOptions& options) : options_(options) {}

  std::string add_shape(const Shape& shape, bool is_mesh) override;

  Spectrum color(const Surface& s) const override;
  float value(const Surface& s) const override { return color(s).luminance(); }
  Point2f gradient(const Surface& s) const override;
  /// Of both colours, as in Mitsuba 0.6.
  Spectrum average() const override { return (options_.interior + options_.edge) * 0.5f; }
  bool needs_uv() const override { return false; }

 private:
  /// The share of the interior's colour, and its derivatives by the barycentric coordinates if they
  /// are wanted.
  float interior_share(const Surface& s, Point2f* derivatives) const;

  WireframeOptions options_;
  PerMesh<float> line_width_;
};

}  // namespace duet
