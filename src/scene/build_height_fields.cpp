// Height fields become meshes before anything else looks at the shapes.
#include <bit>
#include <cmath>

#include "geometry/height_field.h"
#include "image/resample.h"
#include "scene/builder.h"

namespace duet {

namespace {

/// Their triangles take up some gigabytes.
constexpr double kMostPatches = 1 << 26;

/// Numbers of heights are one more than a power of two.
int height_count(int pixels) {
  return int(std::bit_ceil(unsigned(std::max(pixels, 2) - 1))) + 1;
}

}  // namespace

bool SceneBuilder::read_heights(TextureId id, const HeightFieldShape& shape, const Spectrum& scale,
                                HeightField& out) {
  const TextureDescription& d = description_.textures[size_t(id)];
  const auto fill = [&](int width, int height, const auto& color) {
    out.columns = width, out.rows = height;
    if (double(height_count(width) - 1) * (height_count(height) - 1) > kMostPatches) {
      diagnostics_.error(d.where, "a height field of {} × {} pixels is too large", width, height);
      return false;
    }
    out.heights.reserve(size_t(width) * size_t(height));
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) out.heights.push_back((color(x, y) * scale).luminance());
    return true;
  };
  if (const auto* scaled = std::get_if<ScaledTextureDescription>(&d.model))
    return read_heights(scaled->inner, shape, scale * scaled->scale, out);
  if (const auto* t = std::get_if<BitmapTexture>(&d.model)) {
    const auto image = pixels(t->file, t->decoding(), d.where, Severity::error);
    if (!image) return false;
    if (!fill(image->width(), image->height(), [&](int x, int y) { return image->color(x, y); }))
      return false;
  } else if (std::holds_alternative<CheckerboardTexture>(d.model) ||
             std::holds_alternative<GridLinesTexture>(d.model)) {
    ShapeTextureSet outer = std::exchange(shape_textures_, {});
    const std::unique_ptr<Texture> made = std::visit(
        [&](auto pattern) {
          // As an image, Mitsuba 0.6 shows it before it is moved and scaled.
          if constexpr (requires { pattern.to_uv; }) pattern.to_uv = {};
          return pattern.build(*this, d.where);
        },
        d.model);
    const bool reads_mesh = !std::exchange(shape_textures_, std::move(outer)).empty();
    if (reads_mesh)
      diagnostics_.error(d.where, "heights cannot be read from the attributes of a mesh");
    if (!made || reads_mesh) return false;
    Surface point{};
    const auto look_up = [&](int x, int y) {
      point.uv = {(float(x) + 0.5f) / float(shape.width), (float(y) + 0.5f) / float(shape.height)};
      return made->color(point);
    };
    if (!fill(shape.width, shape.height, look_up)) return false;
  } else {
    diagnostics_.error(d.where, "this texture is no image and cannot be the heights of a surface");
    return false;
  }
  for (size_t i = 0; i < out.heights.size(); ++i)
    if (!std::isfinite(out.heights[i] *= float(shape.scale))) {
      diagnostics_.error(d.where, "the height of pixel ({}, {}) is not finite",
                         i % size_t(out.columns), i / size_t(out.columns));
      return false;
    }
  return true;
}

void SceneBuilder::height_field(ShapeDescription& d) {
  const auto* shape = std::get_if<HeightFieldShape>(&d.geometry);
  if (!shape) return;
  MeshShape result;
  HeightField field;
  field.shading_normals = shape->shading_normals;
  if (read_heights(shape->heights, *shape, Spectrum(1.0f), field)) {
    const int columns = height_count(field.columns), rows = height_count(field.rows);
    field.heights =
        enlarge(std::move(field.heights), field.columns, field.rows, columns, rows, *shape->filter);
    field.columns = columns, field.rows = rows;
    result.mesh = std::make_shared<TriangleMesh>(make_height_field(field));
  } else {
    result.mesh = std::make_shared<TriangleMesh>(make_rectangle());
  }
  d.geometry = std::move(result);
}

void SceneBuilder::height_fields() {
  for (ShapeDescription& d : description_.shapes) height_field(d);
  for (ShapeGroupDescription& g : description_.groups)
    for (ShapeDescription& d : g.shapes) height_field(d);
  for (SensorDescription& sensor : description_.sensors)
    for (ShapeDescription& d : sensor.target_shape) height_field(d);
}

}  // namespace duet
