#include "textures/grid_texture.h"

#include <cmath>

namespace duet {

const ColorSlot& GridTexture::slot(const Surface& s) const {
  const Point2f p = to_uv_(s.uv);
  const float x = std::abs(p.x - std::round(p.x)), y = std::abs(p.y - std::round(p.y));
  return x < line_width_ || y < line_width_ ? line_ : field_;
}

Spectrum GridTexture::average() const {
  const float inner = std::clamp(1 - 2 * line_width_, 0.0f, 1.0f), share = inner * inner;
  return field_.average() * share + line_.average() * (1 - share);
}

}  // namespace duet
