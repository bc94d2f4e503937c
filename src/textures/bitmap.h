// Image textures.
#pragma once

#include <memory>

#include "textures/bitmap_pixels.h"
#include "textures/texture.h"

namespace duet {

/// An image on the unit square of texture coordinates: the first row lies along v = 0, texel i of n
/// has its centre at (i + 1/2) / n. Several textures may share the pixels.
class Bitmap final : public Texture {
 public:
  Bitmap(std::shared_ptr<const BitmapPixels> pixels, TextureFilter filter, WrapMode wrap_u,
         WrapMode wrap_v, const UvTransform& to_uv);

  Spectrum color(const Surface& s) const override;
  float value(const Surface& s) const override;
  /// Of the bilinear interpolant, which is not continuous; zero without interpolation.
  Point2f gradient(const Surface& s) const override;
  Spectrum average() const override { return pixels_->average(); }
  Point2i resolution() const override { return {pixels_->width(), pixels_->height()}; }
  void prefetch(const Surface& s) const override;

 private:
  /// The two texels between which a coordinate lies along one axis and the weight of the second.
  struct Span {
    int first, second;  ///< or kZero, kOne
    float t;
  };
  /// Not texels, but the constants that 0.x puts around the image.
  static constexpr int kZero = -1, kOne = -2;

  static Span span(float coordinate, int size, WrapMode wrap);
  static int nearest(float coordinate, int size, WrapMode wrap);
  Point2f image_coordinates(const Point2f& uv) const {
    return {m_[0][0] * uv.x + m_[0][1] * uv.y + m_[0][2],
            m_[1][0] * uv.x + m_[1][1] * uv.y + m_[1][2]};
  }
  template <class Texel>
  auto look_up(const Surface& s, const Texel& texel) const;
  template <class Texel>
  static auto bordered(const Texel& texel);
  float grey(const Surface& s) const;
  Spectrum full_color(const Surface& s) const;

  std::shared_ptr<const BitmapPixels> pixels_;
  TextureFilter filter_;
  WrapMode wrap_u_, wrap_v_;
  bool bordered_;  ///< by constants
  float m_[2][3];
};

}  // namespace duet
