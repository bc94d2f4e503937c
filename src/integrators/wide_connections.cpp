// Connections of a batch of eye sub-paths with light sub-paths of their tile.
#include <algorithm>

#include "integrators/wide_conductor.h"
#include "integrators/wide_dielectric.h"
#include "integrators/wide_eye.h"
#include "integrators/wide_plastic.h"
#include "integrators/wide_principled.h"

namespace duet {

void WideEye::connect(int n, int depth, Sums& sums, RenderCounters& counters) {
  const std::vector<ConnectionVertex>& vertices = plan_.lights->connection_vertices();
  const int most = limits_.max_depth - depth - 1;
  if (!plan_.set.connections || vertices.empty() || most <= 0) return;
  if (plan_.drawn) return connect_drawn(n, depth, sums, counters);
  for (int i = 0; i < n; ++i) {
    if (!carries(i)) continue;
    LightSubpath light = light_subpath(i, depth);
    if (!connects_at(i)) light.count = 0;
    int& count = light.count;
    while (count > 0 && vertices[light.first + uint32_t(count) - 1].depth > most) --count;
    counters.connections.failed_specular += uint64_t(std::min(most, light.length) - count);
    if (!special_vertex(i))
      find_pairs(i, light, depth, sums, counters);
    else
      for (int k = 0; k < count; ++k)
        connect_one_by_one(i, light_vertex(light, k), 0, depth, sums, counters);
  }
  for (size_t list = 0; list < pairs_.size(); ++list) flush_pairs(list, depth, sums, counters);
  flush_single(sums, counters);
}

WideEye::LightSubpath WideEye::light_subpath(int i, int depth) const {
  const LightVertices& vertices = plan_.lights->vertices();
  const size_t index =
      plan_.sharing->at_vertex(own_light_[size_t(paths_.id[i])], vertices.ends.size(), depth);
  const uint32_t first = vertices.first(index);
  return {index, first, int(vertices.ends[index] - first), vertices.lengths[index]};
}

bool WideEye::connects_at(int i) {
  const PathVertex* const special = special_vertex(i);
  return special ? special->is_smooth() : is_smooth(i);
}

void WideEye::connect_drawn(int n, int depth, Sums& sums, RenderCounters& counters) {
  constexpr int kAhead = 16;
  const std::vector<ConnectionVertex>& vertices = plan_.lights->connection_vertices();
  std::array<uint32_t, kAhead> drawn;
  for (int i = 0; i < n; ++i) {
    if (!carries(i) || !connects_at(i)) continue;
    for (int first = 0; first < plan_.drawn->count(); first += kAhead) {
      const int count = std::min(plan_.drawn->count() - first, kAhead);
      for (int k = 0; k < count; ++k) {
        drawn[size_t(k)] = plan_.drawn->draw(~keys_[size_t(paths_.id[i])], depth, first + k);
        __builtin_prefetch(&vertices[drawn[size_t(k)]]);
        __builtin_prefetch(&vertices[drawn[size_t(k)]].depth);
      }
      for (int k = 0; k < count; ++k)
        connect_drawn(i, first + k, drawn[size_t(k)], depth, sums, counters);
    }
  }
  for (size_t list = 0; list < pairs_.size(); ++list) flush_pairs(list, depth, sums, counters);
  flush_single(sums, counters);
}

void WideEye::connect_drawn(int i, int k, uint32_t index, int depth, Sums& sums,
                            RenderCounters& counters) {
  const ConnectionVertex& l = plan_.lights->connection_vertices()[index];
  if (l.depth + depth + 1 > limits_.max_depth) return;
  const bool special = special_vertex(i);
  const Vector3f d = l.position - points_.position.point(i);
  // The side on which an eye vertex is lit is known of those in lanes alone.
  const bool lit = wide_.shapes[hits_.shape[i]].transmits || dot(ends_.lit.vector(i), d) > 0;
  const bool faces = special || (lit && !(limits_.strict_normals && has_two_sides(i, d)));
  if (l.is_placed() && !(faces && (!l.faces || dot(l.lit, d) < 0))) {
    ++counters.connections.failed_zero;
    return;
  }
  if (special || l.material == ConnectionVertex::kOther || index >= kMostPairVertices) {
    const LightVertex& packed = plan_.lights->vertices().vertices[index];
    const PathVertex light = Unpacked<PathVertex>{packed, wide_.scene};
    return connect_one_by_one(i, light, k, depth, sums, counters);
  }
  const size_t number = l.material == ConnectionVertex::kDiffuse
                            ? size_t(wide_.shapes[hits_.shape[i]].pair_list())
                            : pairs_.size() - 1;
  PairList& list = pairs_[number];
  if (list.count == kBatch) flush_pairs(number, depth, sums, counters);
  list.pairs.eye[list.count] = i;
  list.pairs.light[list.count] = int32_t(index);
  list.pairs.drawn[list.count++] = ConnectionRoulette::event(0, 0, k);
}

void WideEye::find_pairs(int i, const LightSubpath& light, int depth, Sums& sums,
                         RenderCounters& counters) {
  const ConnectionVertex* const vertices = plan_.lights->connection_vertices().data() + light.first;
  const Point3f position = points_.position.point(i);
  const Vector3f lit = ends_.lit.vector(i);
  const bool strict = limits_.strict_normals;
  const WideShape& shape = wide_.shapes[hits_.shape[i]];
  const auto own = size_t(shape.pair_list());
  const int transmits = shape.transmits;
  const auto is_pair = [counts = groups_ && depth == 1](const ConnectionVertex& l) {
    if (l.material == ConnectionVertex::kDiffuse) return !counts || l.shareable != 0;
    return l.material != ConnectionVertex::kOther;
  };
  for (int k = 0; k < light.count; ++k) {
    const ConnectionVertex& l = vertices[k];
    if (!is_pair(l)) {
      const Vector3f d = l.position - position;
      if (l.faces && !((transmits || dot(lit, d) > 0) && dot(l.lit, d) < 0))
        ++counters.connections.failed_zero;
      else
        connect_one_by_one(i, light_vertex(light, k), 0, depth, sums, counters);
      continue;
    }
    const size_t number = l.material == ConnectionVertex::kDiffuse ? own : pairs_.size() - 1;
    PairList& list = pairs_[number];
    if (list.count == kBatch) flush_pairs(number, depth, sums, counters);
    // Without branches: half of the vertices do not face each other, and which cannot be predicted.
    const Vector3f d = l.position - position;
    const int face = (transmits | int(dot(lit, d) > 0)) & ((1 - l.faces) | int(dot(l.lit, d) < 0)) &
                     int(!(strict && has_two_sides(i, d)));
    list.pairs.eye[list.count] = i;
    list.pairs.light[list.count] = int32_t(light.first - first_light_) + k;
    list.count += face;
    counters.connections.failed_zero += uint64_t(1 - face);
  }
}

void WideEye::weigh(size_t number, int depth) {
  const auto& [pairs, count] = pairs_[number];
  const ConnectionVertex* const light = plan_.lights->connection_vertices().data() + first_light_;
  if (number + 1 == pairs_.size()) return weigh_glossy_lights(count, pairs, depth);
  // The light vertices are diffuse: first eye vertices of a group have those that it would share.
  const WideConnections c = connections(depth, depth == 1 ? float(plan_.set.pixel_group) : 1.0f);
  if (number == 0) return weigh_pairs(count, pairs, c, light, shadows_);
  const WideVertices vertices{paths_, points_, numbers_};
  WideGlossy& g = glossy_;
  std::copy_n(pairs.eye.begin(), count, g.at.begin());
  find_directions(count, pairs, points_, light, g.towards);
  const auto evaluate = [&, n = count](const auto& material) {
    evaluate_glossy(n, material, vertices, g);
    reverse_glossy(n, material, vertices, g);
  };
  std::visit(evaluate, wide_.glossy[number - 1]);
  weigh_glossy_pairs(count, pairs, c, light, g, shadows_);
}

void WideEye::weigh_glossy_lights(int count, const WidePairs& pairs, int depth) {
  const ConnectionVertex* const light = plan_.lights->connection_vertices().data() + first_light_;
  const LightVertex* const packed = plan_.lights->vertices().vertices.data() + first_light_;
  GlossyLightVertices& l = glossy_lights_;
  find_directions(count, pairs, points_, light, eye_bsdfs_.towards);
  for (int k = 0; k < count; ++k) {
    const ConnectionVertex& v = light[pairs.light[k]];
    const LightVertex& p = packed[pairs.light[k]];
    eye_bsdfs_.material[k] = wide_.shapes[hits_.shape[pairs.eye[k]]].pair_list();
    eye_bsdfs_.at[k] = pairs.eye[k];
    l.bsdfs.material[k] = v.material;
    l.bsdfs.at[k] = k;
    l.bsdfs.towards.set(k, -eye_bsdfs_.towards.vector(k));
    l.paths.ray.direction.set(k, -p.direction_to_previous());
    l.points.ns.set(k, v.lit);
    l.points.reflectance.set(k, v.flux.r, v.flux.g, v.flux.b);
    const Spectrum throughput = p.throughput(v.ng);
    l.throughput.set(k, throughput.r, throughput.g, throughput.b);
  }
  evaluate_ends_.evaluate(count, {paths_, points_, numbers_}, eye_bsdfs_);
  evaluate_ends_.evaluate(count, {l.paths, l.points, numbers_, Transport::importance}, l.bsdfs);
  weigh_glossy_ends(count, pairs, connections(depth), light, {eye_bsdfs_, l.bsdfs, l.throughput},
                    shadows_);
}

void WideEye::flush_pairs(size_t number, int depth, Sums& sums, RenderCounters& counters) {
  int& count = pairs_[number].count;
  if (count == 0) return;
  weigh(number, depth);
  const auto zero = std::count(shadows_.blocked.begin(), shadows_.blocked.begin() + count,
                               WideShadowRays::kNothing);
  const Tested tested = test_connections(count, shadows_, sums);
  counters.shadow_rays += uint64_t(tested.rays);
  counters.connections.failed_zero += uint64_t(zero);
  counters.connections.skipped += uint64_t(count - zero - tested.rays);
  counters.connections.failed_occluded += uint64_t(tested.rays - tested.lit);
  counters.connections.contributed += uint64_t(tested.lit);
  count = 0;
}

void WideEye::connect_one_by_one(int i, const PathVertex& light, int drawn, int depth, Sums& sums,
                                 RenderCounters& counters) {
  const int id = paths_.id[i];
  const ConnectionRoulette own = roulette(id);
  const PathVertex& eye = eye_vertex(i, depth);
  const auto ends = weigh_ends(context(id, own, counters), light, eye, drawn, scale());
  if (!ends) return;
  const Ray ray = spawn_ray_to(eye.surface, ends->target);
  const int k = single_count_++;
  single_.ray.origin.set(k, ray.origin);
  single_.ray.direction.set(k, ray.direction);
  single_.ray.tmax[k] = ray.tmax;
  const Spectrum value = ends->connection.value * ends->connection.weight;
  single_.contribution.set(k, value.r, value.g, value.b);
  single_.varying[k] = groups_ && groups_->shares(id) ? varying_part(light, eye, *ends) : 0.0f;
  single_.id[k] = id;
  single_.blocked[k] = 0;
  if (single_count_ == kBatch) flush_single(sums, counters);
}

float WideEye::varying_part(const PathVertex& light, const PathVertex& eye,
                            const EndsConnection& ends) const {
  const struct End {
    Partials partials;
  } at_light{light.partials}, constant{{eye.partials.vcm, eye.partials.vc - eye.partials.vm, 0}};
  return 1 - ends.connection.weight /
                 weights_[0].connection(at_light, ends.light_end, constant, ends.eye_end);
}

WideEye::Tested WideEye::test_connections(int n, WideShadowRays& rays, Sums& sums) {
  if (!sums.groups) return test_shadows(n, rays, sums.samples);
  const struct {
    Sums& sums;
    const BatchArray<int32_t>& ids;
    const BatchArray<float>& varying;
    void add(int k, const Spectrum& s) const { sums.add(ids[k], s, varying[k]); }
  } by_number{sums, tested_ids_, rays.varying};
  for (int k = 0; k < n; ++k) {
    tested_ids_[k] = rays.id[k];
    rays.id[k] = k;
  }
  return test_shadows(n, rays, by_number);
}

void WideEye::flush_single(Sums& sums, RenderCounters& counters) {
  const Tested tested = test_connections(single_count_, single_, sums);
  counters.shadow_rays += uint64_t(tested.rays);
  counters.connections.failed_occluded += uint64_t(tested.rays - tested.lit);
  counters.connections.contributed += uint64_t(tested.lit);
  single_count_ = 0;
}

const PathVertex& WideEye::eye_vertex(int i, int depth) {
  if (vertex_of_[i] < 0) {
    vertex_of_[i] = int32_t(vertices_.size());
    vertices_.emplace_back(wide_.scene, wide_.scene.surface(paths_.ray[i], hit(i)),
                           -paths_.ray.direction.vector(i), throughput(i), partials(i), depth);
  }
  return vertices_[size_t(vertex_of_[i])];
}

const PathVertex& WideEye::light_vertex(const LightSubpath& light, int number) {
  UnpackedSubpath& known = unpacked_subpaths_[light.index % unpacked_subpaths_.size()];
  if (known.subpath != light.index) {
    known = {light.index, int(unpacked_.size())};
    const LightVertices& vertices = plan_.lights->vertices();
    for (const LightVertex& v : vertices.subpath(light.index))
      unpacked_.emplace_back(Unpacked<PathVertex>{v, wide_.scene});
  }
  return unpacked_[size_t(known.first + number)];
}

}  // namespace duet
