#include "textures/checkerboard.h"

namespace duet {

Checkerboard::Checkerboard(const ColorSlot& first, const ColorSlot& second,
                           const UvTransform& to_uv, bool swap_values)
    : first_(first), second_(second), to_uv_(to_uv), swap_values_(swap_values) {}

bool Checkerboard::on_first(const Point2f& uv) const {
  const Point2f p = to_uv_(uv);
  return (p.x - std::floor(p.x) > 0.5f) == (p.y - std::floor(p.y) > 0.5f);
}

Spectrum Checkerboard::color(const Surface& s) const {
  return on_first(s.uv) ? first_(s) : second_(s);
}

float Checkerboard::value(const Surface& s) const {
  const ColorSlot& slot = on_first(s.uv) != swap_values_ ? first_ : second_;
  return slot.texture ? slot.texture->value(s) : slot.constant.mean();
}

}  // namespace duet
