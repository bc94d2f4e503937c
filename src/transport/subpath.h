// One random walk for both sides: from vertex to vertex, with the sums of multiple importance
// sampling carried along.
#pragma once

#include "math/sampler.h"
#include "scene/path_limits.h"
#include "transport/counters.h"
#include "transport/path_vertex.h"
#include "transport/roulette.h"
#include "transport/vertex_pdfs.h"

namespace duet {

struct SubpathOptions {
  int rr_depth = kUsualRrDepth;  ///< segments before roulette begins
  bool strict_normals = false;
};

/// A sub-path between two vertices.
struct Subpath {
  Ray ray;                    ///< to the next vertex
  Spectrum throughput;        ///< on arrival there
  Partials partials{};        ///< on leaving the last one
  float carried = 1;          ///< product of what scattering has left, without what refraction adds
  Point3f from{};             ///< the last vertex
  bool from_specular = true;  ///< it was left by a delta lobe, or is on the lens
  float cosine_out = 1;       ///< |cos| with which the last vertex was left
  bool unmerged = true;       ///< nothing so far could have been merged (Bsdf::merges())
  float forward = 0;          ///< density per solid angle of the ray
  SubpathPdfs* pdfs = nullptr;  ///< filled if not null
};

/// Records the arrival of a sub-path at a vertex; `d2` and `cosine` as in arrive().
inline void record_arrival(Subpath& subpath, float d2, float cosine) {
  if (!subpath.pdfs) return;
  subpath.pdfs->push_back({subpath.forward * cosine / d2, 0, subpath.cosine_out / d2, false});
}

/// Where and how a sub-path arrives at a vertex.
struct Arrival {
  Point3f at;
  float d2;                 ///< squared distance from the last vertex
  float cosine;             ///< geometric; in a medium the extinction in its place
  float transmittance = 1;  ///< the nominal one on the way from there
};

/// The sums at the first vertex of an eye sub-path, where light tracing competes. `camera_ray`
/// starts at the camera, which the sub-path's ray may not do.
inline Partials first_eye_partials(const Scene& scene, const Ray& camera_ray, const Arrival& a,
                                   const TechniqueSet& set, Subpath& subpath) {
  const float importance = scene.camera->importance(camera_ray, distance(a.at, camera_ray.origin));
  subpath.forward = importance * a.d2;
  Partials p;
  if (set.camera_connections)
    p.vcm = set.light_paths / (set.connection_share * importance * a.cosine * a.transmittance);
  return p;
}

/// Records that the last vertex was left, by which the one before learns its reverse density.
inline void record_departure(Subpath& subpath, float reverse, bool specular, bool merges) {
  if (!subpath.pdfs) return;
  SubpathPdfs& pdfs = *subpath.pdfs;
  pdfs.back().specular = specular, pdfs.back().merges = merges;
  if (pdfs.size() > 1) pdfs[pdfs.size() - 2].reverse = reverse * pdfs.back().back;
}

/// Whether a sub-path goes on from a vertex `depth` segments from its start; its throughput then
/// makes up for those that end.
inline bool survives(int depth, const SubpathOptions& options, const Roulette& roulette,
                     Sampler& sampler, Subpath& subpath) {
  if (depth < options.rr_depth) return true;
  // Relative to what the sub-path began with: the same for dim and for bright lights.
  const float survival = russian_roulette(roulette.at(depth), subpath.carried, sampler);
  if (survival == 0) return false;
  subpath.throughput *= 1 / survival;
  subpath.carried /= survival;
  return true;
}

/// What leave_specular() asks of a delta lobe that was sampled at a vertex.
inline float specular_jacobian(const PathVertex& v, const BsdfSample& s) {
  if (s.eta == 1) return 1;
  const Normal3f& n = v.surface.shading.n;
  return std::abs(dot(n, v.wo)) / (std::abs(dot(n, s.wi)) * s.eta * s.eta);
}

/// Chooses where a sub-path goes on from a surface; see scatter(). With `passes` one that goes
/// straight on stays the sub-path that had not come to the surface yet, but for ray and throughput.
template <Transport transport, bool passes>
inline bool scatter_on_surface(const PathVertex& v, const TechniqueSet& set,
                               const SubpathOptions& options, Sampler& sampler, Subpath& subpath,
                               bool* passed_straight) {
  const Point2f direction = sampler.next_2d();
  const float choice = v.bsdf.needs_choice() ? sampler.next_1d() : 0.5f;
  const auto s = v.bsdf.sample(choice, direction, transport);
  if (passed_straight) *passed_straight = s && s->null;
  if (!s) return false;
  constexpr bool to_light = transport == Transport::radiance;
  // Strictness is about the direction towards the light, whoever traces the sub-path.
  if (options.strict_normals && sides_differ(v.surface, to_light ? s->wi : v.wo)) return false;
  Spectrum weight = s->weight;
  if (!to_light) weight *= adjoint_factor(v.surface, v.wo, s->wi);
  subpath.throughput = v.throughput * weight;
  subpath.carried *= weight.max();
  if (to_light) subpath.carried *= s->eta * s->eta;
  if (!(subpath.throughput.max() > 0)) return false;
  if (passes && s->null) {
    subpath.ray = spawn_ray(v.surface, s->wi);
    if (subpath.pdfs) subpath.pdfs->pop_back();
    return true;
  }
  if (!survives(v.depth, options, kSubpathRoulette, sampler, subpath)) return false;
  const float cosine_out = v.cosine(s->wi);
  if (s->delta) {
    const float jacobian = specular_jacobian(v, *s);
    subpath.partials = leave_specular(v.partials, cosine_out, jacobian);
    subpath.forward = 1;
    record_departure(subpath, jacobian, true, false);
  } else {
    const float reverse = v.bsdf.reverse_pdf(s->wi, transport).value;
    const bool merges = v.merges(s->pdf.value, reverse);
    subpath.partials = leave(v.partials, {s->pdf.value, reverse, cosine_out}, set, merges);
    subpath.forward = s->pdf.value;
    subpath.unmerged &= !merges;
    record_departure(subpath, reverse, false, merges);
  }
  subpath.cosine_out = cosine_out;
  subpath.from = v.position();
  subpath.from_specular = s->delta;
  subpath.ray = spawn_ray(v.surface, s->wi);
  return true;
}

/// Chooses where a sub-path goes on from a vertex; false if it ends. Uses up to four dimensions of
/// the sampler. The roulette divides the throughput and is left out of all densities.
template <Transport transport>
inline bool scatter(const PathVertex& v, const TechniqueSet& set, const SubpathOptions& options,
                    Sampler& sampler, Subpath& subpath, bool* passed_straight = nullptr) {
  return scatter_on_surface<transport, false>(v, set, options, sampler, subpath, passed_straight);
}

}  // namespace duet
