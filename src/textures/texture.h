// What a material parameter may be: a constant, or a texture looked up at each hit.
#pragma once

#include <vector>

#include "geometry/surface.h"
#include "math/spectrum.h"

namespace duet {

/// A function on surfaces. A colour texture asked for a number yields its luminance, a grey one
/// asked for a colour yields grey, as in Mitsuba.
class Texture {
 public:
  virtual ~Texture() = default;
  virtual Spectrum color(const Surface& s) const = 0;
  virtual float value(const Surface& s) const = 0;
  /// Derivatives of value() by the surface's texture coordinates.
  virtual Point2f gradient(const Surface& s) const = 0;
  /// Mean over the texture's domain: used to weigh one light or lobe against another.
  virtual Spectrum average() const = 0;
  /// Whether a lookup reads the texture coordinates (and not just where on the mesh it is).
  virtual bool needs_uv() const { return true; }
  /// How finely the texture varies over the unit square of texture coordinates: texels along u and
  /// v.
  virtual Point2i resolution() const { return {1, 1}; }
  /// Tells the processor that a lookup will follow: memory is far away.
  virtual void prefetch(const Surface&) const {}
};

/// A colour parameter. The constant costs no call.
struct ColorSlot {
  Spectrum constant;
  const Texture* texture = nullptr;

  Spectrum operator()(const Surface& s) const { return texture ? texture->color(s) : constant; }
  Spectrum average() const { return texture ? texture->average() : constant; }
  bool is_constant() const { return !texture; }
  void list_texture(std::vector<const Texture*>& out) const {
    if (texture) out.push_back(texture);
  }
  bool needs_uv() const { return texture && texture->needs_uv(); }
};

/// A number parameter.
struct FloatSlot {
  float constant = 0;
  const Texture* texture = nullptr;

  float operator()(const Surface& s) const { return texture ? texture->value(s) : constant; }
  Point2f gradient(const Surface& s) const { return texture ? texture->gradient(s) : Point2f(); }
  float average() const { return texture ? texture->average().luminance() : constant; }
  bool is_constant() const { return !texture; }
  void list_texture(std::vector<const Texture*>& out) const {
    if (texture) out.push_back(texture);
  }
  bool needs_uv() const { return texture && texture->needs_uv(); }
};

}  // namespace duet
