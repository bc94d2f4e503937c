#include "integrators/wide_subpath_stages.h"

namespace duet {

void WideSubpathStages::fill_gaps() {
  gaps_.fill(paths_);
  gaps_.fill(subpaths_.vcm);
  gaps_.fill(subpaths_.vc);
  gaps_.fill(subpaths_.vm);
  gaps_.fill(subpaths_.carried);
}

bool WideSubpathStages::is_smooth(int i) const {
  const WideShape& shape = wide_.shapes[hits_.shape[i]];
  if (shape.always_smooth) return true;
  return std::max({ends_.flux.x[i], ends_.flux.y[i], ends_.flux.z[i]}) > 0;
}

void WideSubpathStages::make_special_vertices(int n, int depth) {
  for (int i = 0; i < n; ++i) vertex_of_[i] = -1;
  vertices_.clear();
  for (size_t k = 0; k < special_.size(); ++k) {
    const int i = special_[k];
    if (wide_.shapes[hits_.shape[i]].model != WideModel::other) continue;
    vertex_of_[i] = int32_t(vertices_.size());
    const PathVertex& v =
        vertices_.emplace_back(wide_.scene, surfaces_[k], -paths_.ray.direction.vector(i),
                               throughput(i), partials(i), depth);
    BsdfPair f;
    if (v.is_smooth() && carries(i) && !(lights_.pdf[i] < 0))
      f = v.eval_both_ways(lights_.wi.vector(i), transport_);
    lights_.value.set(i, f.value.r, f.value.g, f.value.b);
    lights_.bsdf_pdf[i] = f.pdf.value;
    ends_.reverse[i] = f.reverse.value;
    ends_.merges[i] = v.merges(f.pdf.value, f.reverse.value);
  }
  special_vertices_ = int(vertices_.size());
}

void WideSubpathStages::scatter_special_vertices() {
  for (const int i : special_) {
    const PathVertex* const v = special_vertex(i);
    if (!v) continue;
    const auto sample = scatter_at(i, v->bsdf);
    if (!sample) continue;
    if (sample->delta) {
      ends_.reverse[i] = specular_jacobian(*v, *sample);
    } else {
      ends_.reverse[i] = v->reverse_pdf(sample->wi, transport_);
      ends_.merges[i] = v->merges(sample->pdf.value, ends_.reverse[i]);
    }
  }
}

}  // namespace duet
