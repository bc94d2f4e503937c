// What lies between the surface and a scattering model: a perturbed frame or a coat.
#pragma once

#include "materials/coat.h"
#include "materials/tilt.h"

namespace duet {

/// How many covers a model can have over it.
inline constexpr int kMaxCovers = 2;

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
