#include "textures/combined_textures.h"

#include "textures/noise.h"

namespace duet {

namespace {

float number_of(const ColorSlot& slot, const Surface& s) {
  return slot.texture ? slot.texture->value(s) : slot.constant.luminance();
}

Point2f gradient_of(const ColorSlot& slot, const Surface& s) {
  return slot.texture ? slot.texture->gradient(s) : Point2f();
}

float noise_of_plane(float x, float y) {
  return perlin_noise({x, y, 0.5f});
}

/// Whether the square around an integer point has a dot: two of five have.
bool has_dot(float x, float y) {
  return noise_of_plane(x + 0.5f, y + 0.5f) > 0;
}

}  // namespace

float MixTexture::value(const Surface& s) const {
  const float t = amount_(s);
  return number_of(first_, s) * (1 - t) + number_of(second_, s) * t;
}

Point2f MixTexture::gradient(const Surface& s) const {
  const float t = amount_(s), step = number_of(second_, s) - number_of(first_, s);
  return gradient_of(first_, s) * (1 - t) + gradient_of(second_, s) * t +
         amount_.gradient(s) * step;
}

Spectrum MixTexture::average() const {
  const float t = amount_.average();
  return first_.average() * (1 - t) + second_.average() * t;
}

float ProductTexture::value(const Surface& s) const {
  return number_of(first_, s) * number_of(second_, s);
}

Point2f ProductTexture::gradient(const Surface& s) const {
  return gradient_of(first_, s) * number_of(second_, s) +
         gradient_of(second_, s) * number_of(first_, s);
}

float DirectionMixTexture::value(const Surface& s) const {
  const float a = weight(s);
  return number_of(first_, s) * a + number_of(second_, s) * (1 - a);
}

Point2f DirectionMixTexture::gradient(const Surface& s) const {
  const float a = weight(s);
  return gradient_of(first_, s) * a + gradient_of(second_, s) * (1 - a);
}

float apply(TextureFunction function, float x) {
  switch (function) {
    case TextureFunction::inverse:
      return std::max(1 - x, 0.0f);
    case TextureFunction::root:
      return std::sqrt(std::max(x, 0.0f));
    case TextureFunction::v3_roughness: {
      const float l = std::log(std::max(x, 1e-3f));
      return 1.62142f + l * (0.819955f + l * (0.1734f + l * (0.0171201f + l * 0.000640711f)));
    }
    case TextureFunction::metal_k: {
      const float r = std::min(std::max(x, 0.0f), 0.9999f);
      return 2 * std::sqrt(r / (1 - r));
    }
    case TextureFunction::positive:
      return x > 0 ? 1.0f : 0.0f;
  }
  __builtin_unreachable();
}

Point2f FunctionTexture::gradient(const Surface& s) const {
  const float x = inner_.value(s), step = 1e-3f;
  const float slope = (apply(function_, x + step) - apply(function_, x - step)) / (2 * step);
  return inner_.gradient(s) * slope;
}

Point2f BilerpTexture::gradient(const Surface& s) const {
  const Point2f p = place(s);
  const float along_x = at({1, p.y}).luminance() - at({0, p.y}).luminance();
  const float along_y = at({p.x, 1}).luminance() - at({p.x, 0}).luminance();
  const auto& m = to_uv_.m;
  return {along_x * float(m[0][0]) + along_y * float(m[1][0]),
          along_x * float(m[0][1]) + along_y * float(m[1][1])};
}

float DotsTexture::value(const Surface& s) const {
  return number_of(slot(s), s);
}

bool DotsTexture::is_in_dot(const Point2f& p) {
  const float x = std::floor(p.x + 0.5f), y = std::floor(p.y + 0.5f);
  if (!has_dot(x, y)) return false;
  constexpr float kShift = 0.5f - kRadius;
  const float dx = p.x - (x + kShift * noise_of_plane(x + 1.5f, y + 2.8f));
  const float dy = p.y - (y + kShift * noise_of_plane(x + 4.5f, y + 9.8f));
  return dx * dx + dy * dy < kRadius * kRadius;
}

Spectrum DotsTexture::average() const {
  constexpr int kSquares = 64;
  int dots = 0;
  for (int i = 0; i < kSquares * kSquares; ++i)
    dots += has_dot(float(i % kSquares), float(i / kSquares));
  const float share = float(dots) / float(kSquares * kSquares) * float(kPi) * kRadius * kRadius;
  return inside_.average() * share + outside_.average() * (1 - share);
}

}  // namespace duet
