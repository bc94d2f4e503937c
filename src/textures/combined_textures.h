// Textures made of others, and the simplest patterns that these are combined with.
#pragma once

#include <cmath>

#include "math/transform.h"
#include "textures/texture.h"
#include "textures/texture_kinds.h"

namespace duet {

/// (1 − amount) · first + amount · second.
class MixTexture final : public Texture {
 public:
  MixTexture(const ColorSlot& first, const ColorSlot& second, const FloatSlot& amount)
      : first_(first), second_(second), amount_(amount) {}
  Spectrum color(const Surface& s) const override {
    const float t = amount_(s);
    return first_(s) * (1 - t) + second_(s) * t;
  }
  float value(const Surface& s) const override;
  Point2f gradient(const Surface& s) const override;
  Spectrum average() const override;
  bool needs_uv() const override {
    return first_.needs_uv() || second_.needs_uv() || amount_.needs_uv();
  }

 private:
  ColorSlot first_, second_;
  FloatSlot amount_;
};

/// The product of two textures, colour by colour.
class ProductTexture final : public Texture {
 public:
  ProductTexture(const ColorSlot& first, const ColorSlot& second)
      : first_(first), second_(second) {}
  Spectrum color(const Surface& s) const override { return first_(s) * second_(s); }
  float value(const Surface& s) const override;
  Point2f gradient(const Surface& s) const override;
  /// As if the two had nothing to do with each other.
  Spectrum average() const override { return first_.average() * second_.average(); }
  bool needs_uv() const override { return first_.needs_uv() || second_.needs_uv(); }

 private:
  ColorSlot first_, second_;
};

/// a · first + (1 − a) · second, where a is the cosine between the geometric normal and a unit
/// direction, either way round.
class DirectionMixTexture final : public Texture {
 public:
  DirectionMixTexture(const ColorSlot& first, const ColorSlot& second, const Vector3f& direction)
      : first_(first), second_(second), direction_(direction) {}
  Spectrum color(const Surface& s) const override {
    const float a = weight(s);
    return first_(s) * a + second_(s) * (1 - a);
  }
  float value(const Surface& s) const override;
  /// How the normal turns is left out.
  Point2f gradient(const Surface& s) const override;
  Spectrum average() const override { return (first_.average() + second_.average()) * 0.5f; }
  bool needs_uv() const override { return first_.needs_uv() || second_.needs_uv(); }

 private:
  float weight(const Surface& s) const { return std::abs(dot(Vector3f(s.ng), direction_)); }

  ColorSlot first_, second_;
  Vector3f direction_;
};

/// That of x; see TextureFunction.
float apply(TextureFunction function, float x);

/// A function of another texture, colour by colour.
class FunctionTexture final : public Texture {
 public:
  FunctionTexture(const Texture& inner, TextureFunction function)
      : inner_(inner), function_(function) {}
  Spectrum color(const Surface& s) const override { return of(inner_.color(s)); }
  float value(const Surface& s) const override { return apply(function_, inner_.value(s)); }
  Point2f gradient(const Surface& s) const override;
  /// That of the mean.
  Spectrum average() const override { return of(inner_.average()); }
  bool needs_uv() const override { return inner_.needs_uv(); }
  Point2i resolution() const override { return inner_.resolution(); }

 private:
  Spectrum of(const Spectrum& c) const {
    return {apply(function_, c.r), apply(function_, c.g), apply(function_, c.b)};
  }

  const Texture& inner_;
  TextureFunction function_;
};

/// Linear between the corners of the unit square of texture coordinates, and beyond, or in each
/// square anew; `v01` is at u = 0, v = 1.
class BilerpTexture final : public Texture {
 public:
  BilerpTexture(const Spectrum& v00, const Spectrum& v01, const Spectrum& v10, const Spectrum& v11,
                const UvTransform& to_uv, bool repeats)
      : v00_(v00), v01_(v01), v10_(v10), v11_(v11), to_uv_(to_uv), repeats_(repeats) {}
  Spectrum color(const Surface& s) const override { return at(place(s)); }
  float value(const Surface& s) const override { return color(s).luminance(); }
  Point2f gradient(const Surface& s) const override;
  Spectrum average() const override { return (v00_ + v01_ + v10_ + v11_) * 0.25f; }

 private:
  Spectrum at(const Point2f& p) const {
    return (v00_ * (1 - p.y) + v01_ * p.y) * (1 - p.x) + (v10_ * (1 - p.y) + v11_ * p.y) * p.x;
  }

  Point2f place(const Surface& s) const {
    const Point2f p = to_uv_(s.uv);
    return repeats_ ? Point2f{p.x - std::floor(p.x), p.y - std::floor(p.y)} : p;
  }

  Spectrum v00_, v01_, v10_, v11_;
  UvTransform to_uv_;
  bool repeats_;
};

/// Round dots in some of the unit squares around the integer points of texture coordinates,
/// moved a little by noise.
/// Source: Pharr, Jakob, Humphreys, "Physically Based Rendering", 3rd ed., 2016, section 10.5.
class DotsTexture final : public Texture {
 public:
  DotsTexture(const ColorSlot& inside, const ColorSlot& outside, const UvTransform& to_uv)
      : inside_(inside), outside_(outside), to_uv_(to_uv) {}
  Spectrum color(const Surface& s) const override { return slot(s)(s); }
  float value(const Surface& s) const override;
  /// Zero wherever it exists, but for that of the two textures, which is left out.
  Point2f gradient(const Surface&) const override { return {0, 0}; }
  Spectrum average() const override;

 private:
  const ColorSlot& slot(const Surface& s) const {
    return is_in_dot(to_uv_(s.uv)) ? inside_ : outside_;
  }
  static bool is_in_dot(const Point2f& p);

  static constexpr float kRadius = 0.35f;
  ColorSlot inside_, outside_;
  UvTransform to_uv_;
};

}  // namespace duet
