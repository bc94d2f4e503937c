// Light vertices on diffuse surfaces, with what connections ask of them.
#pragma once

#include "transport/path_vertex.h"

namespace duet {

/// A light vertex whose BSDF is a reflectance, as connections of many pairs of vertices see it:
/// nothing has to be bound again. `Surface` and `PathVertex` say what the terms mean.
struct DiffuseVertex {
  Point3f position{0};
  float offset = 0;
  Normal3f ng{0};
  Normal3f lit{0};    ///< the shading normal on the lit side; zero where nothing is reflected
  Spectrum flux;      ///< throughput times reflectance
  float reverse = 0;  ///< density of going back to the previous vertex
  float adjoint = 0;  ///< what adjoint_factor() has of the direction back: |l·n_s| / |l·n_g|
  float vcm = 0, vc = 0, vm = 0;  ///< Partials
  int32_t depth = 0;              ///< as a vertex's
  int32_t other = 1;  ///< 1 for vertices on surfaces that are not diffuse; then nothing is valid
                      ///< but the depth, and `lit`, which is zero

  DiffuseVertex() = default;
  explicit DiffuseVertex(const PathVertex& v) : depth(v.depth) {
    const BsdfComponent* const diffuse = v.bsdf.plain_diffuse();
    if (!diffuse || diffuse->share != 1) return;
    const Surface& s = v.surface;
    const float cosine = dot(s.shading.n, v.wo), geometric = dot(s.ng, v.wo);
    position = s.position;
    offset = s.offset;
    ng = s.ng;
    if (cosine * diffuse->side > 0) lit = Normal3f(Vector3f(s.shading.n) * diffuse->side);
    flux = v.throughput * diffuse->model.diffuse.reflectance;
    reverse = std::abs(cosine) * kInvPi;
    adjoint = geometric != 0 ? std::abs(cosine / geometric) : 0.0f;
    vcm = v.partials.vcm, vc = v.partials.vc, vm = v.partials.vm;
    other = 0;
  }
};

}  // namespace duet
