#include "integrators/wide_mesh_lights.h"

#include "base/instruction_sets.h"
#include "integrators/wide_kernels.h"
#include "math/warp.h"

namespace duet {

/// What light samples of meshes are made of, one after the other.
struct MeshLightRoom {
  std::array<EmissiveMesh::Query, kBatch> queries;
  std::array<EmissiveMesh::Choice, kBatch> choices;
  BatchArray<int32_t> light;
  BatchTriples from;
  WideTriangles triangles;
  BatchArray<float> x, y;  ///< numbers that make points of the triangles
  BatchArray<float> b1, b2;
  WidePoints points;
  BatchArray<float> probability;  ///< EmissiveMesh::Choice::probability
  ListedLightSamples samples;
};

namespace {

constexpr int kMeshLightNumbers = sizeof(MeshLight) / sizeof(float);
static_assert(kMeshLightNumbers == 7);

[[gnu::always_inline]] inline MeshLight mesh_light_at(const float* f, int i) {
  MeshLight l;
  l.radiance = Spectrum(f[i], f[i + 1], f[i + 2]);
  l.even = f[i + 3];
  l.emission = f[i + 4];
  l.sides.two_sided = f[i + 5];
  l.sides.by_shading = f[i + 6];
  return l;
}

DUET_WIDEST void find_barycentrics(int n, MeshLightRoom& p) {
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const Point2f b = square_to_triangle({p.x[k], p.y[k]});
    p.b1[k] = b.x;
    p.b2[k] = b.y;
  }
}

DUET_WIDEST void see_points(int n, const float* lights, MeshLightRoom& p) {
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const MeshLight l = mesh_light_at(lights, p.light[k] * kMeshLightNumbers);
    const Point3f p0 = p.triangles.p0.point(k);
    const Vector3f twice = cross(p.triangles.p1.point(k) - p0, p.triangles.p2.point(k) - p0);
    const float chosen = 1 / (0.5f * std::sqrt(length_squared(twice))) * p.probability[k];
    const EmittingPoint point{p.points.position.point(k), p.points.ng.vector(k),
                              p.points.ns.vector(k), p.points.offset[k]};
    const SeenPoint s = l.sides.see(p.from.point(k), point, l.even > 0 ? l.even : chosen);
    p.samples.set(k, s.wi, s.target, l.radiance, s.pdf);
  }
}

}  // namespace

void WideMeshLights::add(const Light& light) {
  Source& source = sources_.emplace_back();
  MeshLight& numbers = lights_.emplace_back();
  if (light.kind() != LightKind::area) return;
  const auto& area = static_cast<const AreaLight&>(light);
  source.points = area.mesh();
  if (!source.points) return;
  source.mesh = WideMesh(area.shape());
  numbers = area.mesh_light();
  any_ = true;
  smooth_ |= source.mesh.normals != nullptr;
}

int WideMeshLights::choose(int n, const WidePoints& points, const WideNumbers& numbers,
                           const LightChoices& choice, MeshLightRoom& room) const {
  size_t count = 0;
  for (int i = 0; i < n; ++i) {
    const EmissiveMesh* const mesh = sources_[choice.light[i]].points;
    if (!mesh) continue;
    room.samples.at[int(count)] = i;
    room.queries[count++] = {
        mesh, points.position.point(i), {numbers.light_x[i], numbers.light_y[i]}};
  }
  EmissiveMesh::choose({room.queries.data(), count}, room.choices.data());
  return int(count);
}

void WideMeshLights::fetch(int count, const LightChoices& choice, MeshLightRoom& room) const {
  for (int k = 0; k < count; ++k) room.light[k] = int32_t(choice.light[room.samples.at[k]]);
  const auto mesh = [&](int k) -> const WideMesh& { return sources_[size_t(room.light[k])].mesh; };
  const auto triangle = [&](int k) { return room.choices[size_t(k)].triangle; };
  for (int k = 0; k < count; ++k) mesh(k).prefetch_triangle(triangle(k));
  const auto prefetch_corners = [&](int k) { mesh(k).prefetch_corners(triangle(k)); };
  for (int k = 0; k < std::min(count, WideMesh::kAhead); ++k) prefetch_corners(k);
  for (int k = 0; k < count; ++k) {
    if (k + WideMesh::kAhead < count) prefetch_corners(k + WideMesh::kAhead);
    mesh(k).get_corners(k, triangle(k), smooth_, room.triangles);
    const EmissiveMesh::Query& query = room.queries[size_t(k)];
    room.from.set(k, query.from);
    room.x[k] = query.u.x;
    room.y[k] = room.choices[size_t(k)].y;
    room.probability[k] = room.choices[size_t(k)].probability;
  }
}

void WideMeshLights::sample(int n, const WidePoints& points, const WideNumbers& numbers,
                            const LightChoices& choice, WideLightSamples& samples) const {
  if (!any_) return;
  MeshLightRoom room;
  const int count = choose(n, points, numbers, choice, room);
  fetch(count, choice, room);
  find_barycentrics(count, room);
  (smooth_ ? make_smooth_points : make_points)(count, room.triangles, {room.b1, room.b2},
                                               room.points);
  see_points(count, &lights_.data()->radiance.r, room);
  for (int k = 0; k < count; ++k)
    room.samples.copy(k, lights_[size_t(room.light[k])].emission, choice, samples);
}

}  // namespace duet
