// Light vertices with what connections of many pairs ask of them.
#pragma once

#include "transport/path_vertex.h"

namespace duet {

/// A light vertex as connections of many pairs of vertices see it: where its BSDF is a reflectance
/// nothing has to be bound again. `Surface` and `PathVertex` say what the terms mean.
struct ConnectionVertex {
  /// Values of `material`. Above them stand the glossy materials of batches, from 1: of these
  /// `flux` is what their reflectance is, and `reverse` is not valid.
  static constexpr int32_t kDiffuse = 0, kOther = -1;

  Point3f position{0};
  float offset = 0;
  Normal3f ng{0};
  Normal3f lit{0};    ///< the shading normal on the lit side; zero where nothing is reflected. Of
                      ///< materials that transmit the shading normal
  Spectrum flux;      ///< throughput times reflectance
  float reverse = 0;  ///< density of going back to the previous vertex
  float adjoint = 0;  ///< what adjoint_factor() has of the direction back: |l·n_s| / |l·n_g|
  float vcm = 0, vc = 0, vm = 0;  ///< Partials
  int32_t depth = 0;              ///< as a vertex's
  int32_t material = kOther;      ///< of kOther only the depth is valid
  int32_t faces = 0;  ///< 1 if all light stays on the lit side: position and `lit` are then valid,
                      ///< also where the rest is not
  int32_t shareable = 0;  ///< 1 if the group of a pixel would share it as a second eye vertex

  ConnectionVertex() = default;
  explicit ConnectionVertex(const PathVertex& v) : depth(v.depth) {
    const BsdfComponent* const only = v.bsdf.only_component();
    if (!only || !reflects(*only)) return;
    const Surface& s = v.surface;
    const float cosine = dot(s.shading.n, v.wo), geometric = dot(s.ng, v.wo);
    position = s.position;
    if (cosine * only->side > 0) lit = Normal3f(Vector3f(s.shading.n) * only->side);
    faces = 1;
    if (only->kind != ModelKind::diffuse || only->share != 1) return;
    offset = s.offset;
    ng = s.ng;
    flux = v.throughput * only->model.diffuse.reflectance;
    set_cosines(cosine, geometric);
    vcm = v.partials.vcm, vc = v.partials.vc, vm = v.partials.vm;
    material = kDiffuse;
  }

  bool is_placed() const { return material != kOther || faces; }
  /// Of the direction back with the shading and with the geometric normal.
  void set_cosines(float cosine, float geometric) {
    reverse = std::abs(cosine) * kInvPi;
    adjoint = geometric != 0 ? std::abs(cosine / geometric) : 0.0f;
  }

 private:
  /// Whether all light stays on the side of the shading normal that it comes from.
  static bool reflects(const BsdfComponent& c) {
    if (c.kind == ModelKind::principled) return c.model.principled.spec_trans == 0;
    return c.kind == ModelKind::diffuse || c.kind == ModelKind::plastic ||
           c.kind == ModelKind::rough_plastic || c.kind == ModelKind::rough_conductor;
  }
};

}  // namespace duet
