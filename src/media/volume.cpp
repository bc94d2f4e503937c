#include "media/volume.h"

namespace duet {

GridVolume::GridVolume(std::shared_ptr<const VolumeGrid> grid, const Matrix4& to_world,
                       VolumeFilter filter, VolumeWrap wrap, VolumeNodes nodes)
    : grid_(std::move(grid)), to_world_(to_world), filter_(filter), wrap_(wrap), nodes_(nodes) {}

/// Where a coordinate of the unit cube lies among the nodes.
inline float GridVolume::node_coordinate(float x, int axis) const {
  const float n = float(grid_->size[size_t(axis)]);
  switch (nodes_) {
    case VolumeNodes::on_faces:
      return x * (n - 1);
    case VolumeNodes::beyond:
      return x * (n - 2) + 0.5f;
    case VolumeNodes::within:
      break;
  }
  return x * n - 0.5f;
}

inline int GridVolume::wrapped(int i, int axis) const {
  const int n = grid_->size[size_t(axis)];
  if (i >= 0 && i < n) [[likely]]
    return i;
  if (wrap_ == VolumeWrap::clamp) return std::clamp(i, 0, n - 1);
  const int round = i >= 0 ? i / n : (i + 1) / n - 1;
  const int rest = i - round * n;
  return wrap_ == VolumeWrap::mirror && round % 2 != 0 ? n - 1 - rest : rest;
}

inline GridVolume::Neighbours GridVolume::neighbours(const Point3f& p) const {
  Neighbours out;
  out.count = 0;
  size_t index[3][2];
  float weight[3][2];
  // Far outside a coordinate has no fraction any more, and must not become too large an integer.
  constexpr float kFar = 1 << 24;
  for (int i = 0; i < 3; ++i) {
    if (nodes_ != VolumeNodes::within && !(p[i] >= 0 && p[i] <= 1)) return out;
    const float x = std::clamp(node_coordinate(p[i], i), -kFar, kFar);
    const bool interpolates = filter_ == VolumeFilter::trilinear;
    const float floor = std::floor(interpolates ? x : x + 0.5f);
    const float f = interpolates ? x - floor : 0.0f;
    index[i][0] = size_t(wrapped(int(floor), i));
    index[i][1] = size_t(wrapped(int(floor) + 1, i));
    weight[i][0] = 1 - f, weight[i][1] = f;
  }
  const size_t width = size_t(grid_->size[0]), height = size_t(grid_->size[1]);
  out.count = filter_ == VolumeFilter::trilinear ? 8 : 1;
  for (int k = 0; k < out.count; ++k) {
    const int x = k & 1, y = k >> 1 & 1, z = k >> 2;
    out.node[k] = (index[2][z] * height + index[1][y]) * width + index[0][x];
    out.weight[k] = weight[0][x] * weight[1][y] * weight[2][z];
  }
  return out;
}

float GridVolume::local_value(const Point3f& p) const {
  if (grid_->channels != 1) return local_color(p).luminance();
  const Neighbours n = neighbours(p);
  float sum = 0;
  for (int k = 0; k < n.count; ++k) sum += n.weight[k] * grid_->values[n.node[k]];
  return sum;
}

Spectrum GridVolume::local_color(const Point3f& p) const {
  if (grid_->channels == 1) return Spectrum(local_value(p));
  const Neighbours n = neighbours(p);
  Spectrum sum;
  for (int k = 0; k < n.count; ++k) {
    const float* v = &grid_->values[3 * n.node[k]];
    sum += Spectrum(v[0], v[1], v[2]) * n.weight[k];
  }
  return sum;
}

SymmetricMatrix GridVolume::matrix(const Point3f& p) const {
  const Neighbours n = neighbours(to_local(p));
  SymmetricMatrix sum{};
  for (int k = 0; k < n.count; ++k)
    for (size_t i = 0; i < 6; ++i) sum[i] += n.weight[k] * grid_->values[6 * n.node[k] + i];
  return sum;
}

void GridVolume::world_box(Point3f& lower, Point3f& upper) const {
  map_box(to_world_, Point3f(0), Point3f(1), lower, upper);
}

float GridVolume::maximum(const Point3f& lower, const Point3f& upper) const {
  int first[3], last[3];
  for (int i = 0; i < 3; ++i) {
    // One more on each side, for rounding.
    first[i] = int(std::floor(node_coordinate(lower[i], i))) - 1;
    last[i] = int(std::floor(node_coordinate(upper[i], i))) + 2;
    if (wrap_ == VolumeWrap::clamp || nodes_ != VolumeNodes::within) {
      first[i] = std::clamp(first[i], 0, grid_->size[size_t(i)] - 1);
      last[i] = std::clamp(last[i], 0, grid_->size[size_t(i)] - 1);
    }
  }
  const size_t channels = size_t(grid_->channels);
  float most = 0;
  for (int z = first[2]; z <= last[2]; ++z)
    for (int y = first[1]; y <= last[1]; ++y)
      for (int x = first[0]; x <= last[0]; ++x) {
        const size_t node =
            (size_t(wrapped(z, 2)) * size_t(grid_->size[1]) + size_t(wrapped(y, 1))) *
                size_t(grid_->size[0]) +
            size_t(wrapped(x, 0));
        for (size_t c = 0; c < channels; ++c)
          most = std::max(most, grid_->values[node * channels + c]);
      }
  return most;
}

}  // namespace duet
