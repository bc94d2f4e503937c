#include "textures/bitmap.h"

namespace duet {

Bitmap::Bitmap(std::shared_ptr<const BitmapPixels> pixels, TextureFilter filter, WrapMode wrap_u,
               WrapMode wrap_v, const UvTransform& to_uv)
    : pixels_(std::move(pixels)), filter_(filter), wrap_u_(wrap_u), wrap_v_(wrap_v) {
  const auto has = [&](WrapMode w) { return wrap_u == w || wrap_v == w; };
  bordered_ = has(WrapMode::zero) || has(WrapMode::one);
  for (size_t i = 0; i < 2; ++i)
    for (size_t j = 0; j < 3; ++j) m_[i][j] = float(to_uv.m[i][j]);
}

namespace {

/// Rounds down. (std::floor is a call on older processors.) `x` must be in the range of int.
inline int round_down(float x) {
  const int i = int(x);
  return i - int(float(i) > x);
}

/// The coordinate within the unit interval for the modes that repeat the image, and one that a few
/// texels beyond it for the others. Takes anything, also NaN: far out no fraction is left anyway.
inline float fold(float x, WrapMode wrap) {
  if (!(std::abs(x) < 0x1p24f)) [[unlikely]]
    x = x > 0 ? 2.0f : -1.0f;
  if (wrap == WrapMode::repeat) return x - float(round_down(x));
  if (wrap == WrapMode::mirror) return std::abs(x - 2 * float(round_down(0.5f * x + 0.5f)));
  return std::clamp(x, -1.0f, 2.0f);
}

/// Derivative of fold().
inline float fold_slope(float x, WrapMode wrap) {
  if (wrap != WrapMode::mirror || !(std::abs(x) < 0x1p24f)) return 1;
  return x < 2 * float(round_down(0.5f * x + 0.5f)) ? -1.0f : 1.0f;
}

}  // namespace

inline Bitmap::Span Bitmap::span(float coordinate, int size, WrapMode wrap) {
  const float end = fold(coordinate, wrap) * float(size) + 0.5f;
  if (wrap == WrapMode::repeat) {
    const int i = int(end);
    return {i > 0 ? i - 1 : size - 1, i < size ? i : 0, end - float(i)};
  }
  const float x = end - 1;
  const int i = round_down(x), last = size - 1;
  const float t = x - float(i);
  // Beyond the edge of a mirrored image lies its edge.
  if (wrap == WrapMode::mirror || wrap == WrapMode::clamp)
    return {std::clamp(i, 0, last), std::clamp(i + 1, 0, last), t};
  const int border = wrap == WrapMode::zero ? kZero : kOne;
  const auto texel = [&](int j) { return j < 0 || j > last ? border : j; };
  return {texel(i), texel(i + 1), t};
}

inline int Bitmap::nearest(float coordinate, int size, WrapMode wrap) {
  const int i = round_down(fold(coordinate, wrap) * float(size));
  if (wrap == WrapMode::zero || wrap == WrapMode::one)
    if (i < 0 || i >= size) return wrap == WrapMode::zero ? kZero : kOne;
  return std::clamp(i, 0, size - 1);
}

template <class Texel>
inline auto Bitmap::look_up(const Surface& s, const Texel& texel) const {
  const Point2f p = image_coordinates(s.uv);
  if (filter_ == TextureFilter::nearest)
    return texel(nearest(p.x, pixels_->width(), wrap_u_), nearest(p.y, pixels_->height(), wrap_v_));
  const Span u = span(p.x, pixels_->width(), wrap_u_), v = span(p.y, pixels_->height(), wrap_v_);
  const float b = u.t * v.t, w10 = u.t - b, w01 = v.t - b, w00 = 1 - v.t - w10;
  return texel(u.first, v.first) * w00 + texel(u.second, v.first) * w10 +
         texel(u.first, v.second) * w01 + texel(u.second, v.second) * b;
}

/// Texels with constants around them, for the modes of 0.x.
template <class Texel>
inline auto Bitmap::bordered(const Texel& texel) {
  return [&texel](int x, int y) {
    using Value = decltype(texel(0, 0));
    if (x < 0 || y < 0) return Value((x < 0 ? x : y) == kZero ? 0.0f : 1.0f);
    return texel(x, y);
  };
}

inline float Bitmap::grey(const Surface& s) const {
  return pixels_->visit_grey([&](const auto& texel) {
    return bordered_ ? look_up(s, bordered(texel)) : look_up(s, texel);
  });
}

inline Spectrum Bitmap::full_color(const Surface& s) const {
  return pixels_->visit_color([&](const auto& texel) {
    return bordered_ ? look_up(s, bordered(texel)) : look_up(s, texel);
  });
}

void Bitmap::prefetch(const Surface& s) const {
  const Point2f p = image_coordinates(s.uv);
  const int x = nearest(p.x, pixels_->width(), wrap_u_);
  const Span v = span(p.y, pixels_->height(), wrap_v_);
  if (x < 0 || v.first < 0 || v.second < 0) return;
  pixels_->prefetch(x, v.first);
  pixels_->prefetch(x, v.second);
}

Spectrum Bitmap::color(const Surface& s) const {
  return pixels_->is_grey() ? Spectrum(grey(s)) : full_color(s);
}

float Bitmap::value(const Surface& s) const {
  return pixels_->is_grey() ? grey(s) : full_color(s).luminance();
}

Point2f Bitmap::gradient(const Surface& s) const {
  if (filter_ == TextureFilter::nearest) return {0, 0};
  const BitmapPixels& pixels = *pixels_;
  const auto texel = [&](int x, int y) { return pixels.value(x, y); };
  const auto fetch = bordered(texel);
  const Point2f p = image_coordinates(s.uv);
  const Span u = span(p.x, pixels.width(), wrap_u_), v = span(p.y, pixels.height(), wrap_v_);
  const float f00 = fetch(u.first, v.first), f10 = fetch(u.second, v.first),
              f01 = fetch(u.first, v.second), f11 = fetch(u.second, v.second);
  // Per texel. The resolution comes last, as in Mitsuba, which is not the true derivative where
  // to_uv turns an image that is not square; a single row or column counts as two there.
  const float dx = lerp(f10 - f00, f11 - f01, v.t) * fold_slope(p.x, wrap_u_);
  const float dy = lerp(f01 - f00, f11 - f10, u.t) * fold_slope(p.y, wrap_v_);
  return {(m_[0][0] * dx + m_[1][0] * dy) * float(std::max(pixels.width(), 2)),
          (m_[0][1] * dx + m_[1][1] * dy) * float(std::max(pixels.height(), 2))};
}

}  // namespace duet
