// What lies between the surface and a scattering model: a perturbed frame or a coat.
#pragma once

#include <algorithm>

#include "materials/coat.h"
#include "materials/tilt.h"

namespace duet {

/// How many covers a model can have over it.
inline constexpr int kMaxCovers = 2;

/// How many covers a material makes, at most.
struct CoverCount {
  int deep = 0;   ///< over one model
  int total = 0;  ///< over all of its models

  /// Of a cover around this.
  CoverCount covered() const { return {deep + 1, total + 1}; }
  /// Of materials that are bound together, and of those of which one is.
  friend CoverCount both(const CoverCount& a, const CoverCount& b) {
    return {std::max(a.deep, b.deep), a.total + b.total};
  }
  friend CoverCount either(const CoverCount& a, const CoverCount& b) {
    return {std::max(a.deep, b.deep), std::max(a.total, b.total)};
  }
};

/// Either of the two.
struct Cover {
  bool is_coat;
  union {
    Tilt tilt;
    Coat coat;
  };

  Cover() {}
  void set(const Tilt& t) { is_coat = false, tilt = t; }
  void set(const Coat& c) { is_coat = true, coat = c; }
};

}  // namespace duet
