#include "materials/measured.h"

#include <algorithm>
#include <cmath>

#include "materials/special_materials.h"

namespace duet {

namespace {

/// Where a sum that grows linearly from `first` to `last` per unit has reached the share u ∈ [0, 1]
/// of its whole.
float linear_quantile(float first, float last, float u) {
  const float sum = first + last;
  if (!(sum > 0)) return u;
  // Of the two ways to write the root, the one without cancellation.
  const float root = std::sqrt(std::max(first * first + (last - first) * sum * u, 0.0f));
  const float below = first + root;
  return below > 0 ? std::min(sum * u / below, 1.0f) : 1.0f;
}

/// The share of the sum up to x ∈ [0, 1].
float linear_share(float first, float last, float x) {
  const float sum = first + last;
  return sum > 0 ? x * (2 * first + (last - first) * x) / sum : x;
}

/// The cell of a grid of `count` nodes in which the coordinate lies, which becomes that in the
/// cell.
uint32_t cell_of(float& x, uint32_t count) {
  x = std::clamp(x, 0.0f, 1.0f) * float(count - 1);
  const uint32_t i = std::min(uint32_t(x), count - 2);
  x -= float(i);
  return i;
}

/// The first of two neighbouring parameters, and the weight of the second.
uint32_t find_parameter(const std::vector<float>& values, float x, float& weight) {
  weight = 0;
  if (values.size() < 2) return 0;
  const auto after = std::upper_bound(values.begin() + 1, values.end() - 1, x);
  const size_t i = size_t(after - values.begin()) - 1;
  weight = std::clamp((x - values[i]) / (values[i + 1] - values[i]), 0.0f, 1.0f);
  return uint32_t(i);
}

float bilinear(const float* v, size_t width, float x, float y) {
  const float lower = v[0] + (v[1] - v[0]) * x, upper = v[width] + (v[width + 1] - v[width]) * x;
  return lower + (upper - lower) * y;
}

float grid_value(const MeasuredTable::Grid& grid, Point2f p) {
  const uint32_t x = cell_of(p.x, grid.size[0]), y = cell_of(p.y, grid.size[1]);
  return bilinear(&grid.values[size_t(y) * grid.size[0] + x], grid.size[0], p.x, p.y);
}

/// Numbers from 0 to 1 for the angles of a direction: the polar one in steps that are finer near
/// the pole.
float theta_to_unit(float theta) {
  return std::sqrt(theta * (2 * kInvPi));
}
float phi_to_unit(float phi) {
  return (phi + kPi) * (0.5f * kInvPi);
}
/// The polar angle, also exact near the pole.
float elevation(const Vector3f& w) {
  return 2 *
         std::asin(std::min(0.5f * std::sqrt(w.x * w.x + w.y * w.y + (w.z - 1) * (w.z - 1)), 1.0f));
}

}  // namespace

WarpGrid::WarpGrid(const MeasuredTable::Grid& grid, const std::vector<float>& first,
                   const std::vector<float>& second)
    : width_(grid.size[0]),
      height_(grid.size[1]),
      first_(first),
      second_(second),
      values_(grid.values) {
  const size_t count = first.size() * second.size(), n = grid.nodes();
  rows_.resize(count * height_ * (width_ - 1));
  columns_.resize(count * (height_ - 1));
  const double dx = 0.5 / (width_ - 1), dy = 0.5 / (height_ - 1);
  for (size_t g = 0; g < count; ++g) {
    float* const v = &values_[g * n];
    float* const row = &rows_[g * height_ * (width_ - 1)];
    float* const column = &columns_[g * (height_ - 1)];
    std::vector<double> whole(height_);
    for (uint32_t y = 0; y < height_; ++y)
      for (uint32_t x = 0; x + 1 < width_; ++x) {
        whole[y] += dx * (double(v[y * width_ + x]) + double(v[y * width_ + x + 1]));
        row[y * (width_ - 1) + x] = float(whole[y]);
      }
    double sum = 0;
    for (uint32_t y = 0; y + 1 < height_; ++y) {
      sum += dy * (whole[y] + whole[y + 1]);
      column[y] = float(sum);
    }
    const float norm = sum > 0 ? float(1 / sum) : 0.0f;
    std::for_each(v, v + n, [&](float& f) { f *= norm; });
    std::for_each(row, row + height_ * (width_ - 1), [&](float& f) { f *= norm; });
    std::for_each(column, column + height_ - 1, [&](float& f) { f *= norm; });
  }
}

WarpGrid::Mix WarpGrid::mix(float first, float second) const {
  float a, b;
  const uint32_t i = find_parameter(first_, first, a), j = find_parameter(second_, second, b);
  const uint32_t count = uint32_t(second_.size());
  const uint32_t i1 = std::min(i + 1, uint32_t(first_.size()) - 1), j1 = std::min(j + 1, count - 1);
  return {{i * count + j, i * count + j1, i1 * count + j, i1 * count + j1},
          {(1 - a) * (1 - b), (1 - a) * b, a * (1 - b), a * b}};
}

float WarpGrid::value(const Mix& mix, const std::vector<float>& table, size_t stride,
                      size_t index) const {
  float sum = 0;
  for (int k = 0; k < 4; ++k)
    if (mix.weight[k] > 0) sum += mix.weight[k] * table[mix.grid[k] * stride + index];
  return sum;
}

Point2f WarpGrid::sample(const Mix& mix, const Point2f& u, float& density) const {
  const size_t nodes = size_t(width_) * height_, steps = width_ - 1;
  const auto column = [&](uint32_t y) { return value(mix, columns_, height_ - 1, y); };
  const auto row = [&](uint32_t y, uint32_t x) {
    return value(mix, rows_, height_ * steps, y * steps + x);
  };
  const auto node = [&](uint32_t y, uint32_t x) {
    return value(mix, values_, nodes, size_t(y) * width_ + x);
  };
  // The index of the first of `count` growing sums that is not below u.
  const auto find = [](uint32_t count, float x, const auto& sum) {
    uint32_t begin = 0, end = count - 1;
    while (begin < end) {
      const uint32_t middle = (begin + end) / 2;
      if (sum(middle) < x)
        begin = middle + 1;
      else
        end = middle;
    }
    return begin;
  };
  const auto share = [](float x, float before, float after) {
    return after > before ? std::clamp((x - before) / (after - before), 0.0f, 1.0f) : 0.5f;
  };
  const float down = u.y * column(height_ - 2);
  const uint32_t y = find(height_ - 1, down, column);
  const float wy = linear_quantile(row(y, width_ - 2), row(y + 1, width_ - 2),
                                   share(down, y > 0 ? column(y - 1) : 0.0f, column(y)));
  const auto between = [&](float a, float b) { return a + (b - a) * wy; };
  const auto blended = [&](uint32_t x) { return between(row(y, x), row(y + 1, x)); };
  const float along = u.x * blended(width_ - 2);
  const uint32_t x = find(width_ - 1, along, blended);
  const float first = between(node(y, x), node(y + 1, x));
  const float last = between(node(y, x + 1), node(y + 1, x + 1));
  const float wx =
      linear_quantile(first, last, share(along, x > 0 ? blended(x - 1) : 0.0f, blended(x)));
  density = first + (last - first) * wx;
  return {(float(x) + wx) / float(width_ - 1), (float(y) + wy) / float(height_ - 1)};
}

Point2f WarpGrid::invert(const Mix& mix, const Point2f& p, float& density) const {
  const size_t nodes = size_t(width_) * height_, steps = width_ - 1;
  Point2f w = p;
  const uint32_t x = cell_of(w.x, width_), y = cell_of(w.y, height_);
  const auto between = [&](float a, float b) { return a + (b - a) * w.y; };
  const auto row = [&](uint32_t yy, uint32_t xx) {
    return value(mix, rows_, height_ * steps, yy * steps + xx);
  };
  const auto node = [&](uint32_t yy, uint32_t xx) {
    return value(mix, values_, nodes, size_t(yy) * width_ + xx);
  };
  const auto blended = [&](uint32_t xx) { return between(row(y, xx), row(y + 1, xx)); };
  const float first = between(node(y, x), node(y + 1, x));
  const float last = between(node(y, x + 1), node(y + 1, x + 1));
  density = first + (last - first) * w.x;
  const float before = x > 0 ? blended(x - 1) : 0.0f, whole = blended(width_ - 2);
  const float along = before + (blended(x) - before) * linear_share(first, last, w.x);
  const float above = y > 0 ? value(mix, columns_, height_ - 1, y - 1) : 0.0f;
  const float below = value(mix, columns_, height_ - 1, y);
  return {whole > 0 ? along / whole : w.x,
          above + (below - above) * linear_share(row(y, width_ - 2), row(y + 1, width_ - 2), w.y)};
}

float WarpGrid::density(const Mix& mix, const Point2f& p) const {
  Point2f w = p;
  const uint32_t x = cell_of(w.x, width_), y = cell_of(w.y, height_);
  float sum = 0;
  for (int k = 0; k < 4; ++k)
    if (mix.weight[k] > 0)
      sum += mix.weight[k] *
             bilinear(&values_[mix.grid[k] * size_t(width_) * height_ + size_t(y) * width_ + x],
                      width_, w.x, w.y);
  return sum;
}

namespace {

/// The quarter or half of all directions that was measured has wo in it after mirroring.
struct Mirroring {
  float x = 1, y = 1;
  Mirroring(const Vector3f& wo, int reduction) {
    if (reduction < 2) return;
    y = std::copysign(1.0f, -wo.y);
    x = reduction == 4 ? std::copysign(1.0f, -wo.x) : y;
  }
  Vector3f operator()(const Vector3f& w) const { return {w.x * x, w.y * y, w.z}; }
};

int measured_reduction(const std::vector<float>& phi) {
  if (phi.size() <= 2) return 0;
  const float range = phi.back() - phi.front();
  return range > 0 ? int(std::lrint(2 * kPi / range)) : 0;
}

}  // namespace

MeasuredBrdf::MeasuredBrdf(std::shared_ptr<const MeasuredTable> table)
    : table_(std::move(table)),
      vndf_(table_->vndf, table_->phi, table_->theta),
      luminance_(table_->luminance, table_->phi, table_->theta),
      isotropic_(table_->phi.size() <= 2),
      reduction_(measured_reduction(table_->phi)) {}

ModelEval MeasuredBrdf::eval(const Vector3f& wo_any, const Vector3f& wi_any) const {
  if (!(wo_any.z > 0 && wi_any.z > 0)) return {};
  const Mirroring mirror(wo_any, reduction_);
  const Vector3f wo = mirror(wo_any), wi = mirror(wi_any);
  const Vector3f m = normalize(wo + wi);
  const float theta = elevation(wo), phi = std::atan2(wo.y, wo.x);
  Point2f u_m{theta_to_unit(elevation(m)),
              phi_to_unit(std::atan2(m.y, m.x) - (isotropic_ ? phi : 0.0f))};
  u_m.y -= std::floor(u_m.y);
  const WarpGrid::Mix mix = vndf_.mix(phi, theta);
  float vndf;
  const Point2f u = vndf_.invert(mix, u_m, vndf);
  ModelEval e;
  const MeasuredTable::Grid& rgb = table_->rgb;
  Point2f w = u;
  const uint32_t x = cell_of(w.x, rgb.size[0]), y = cell_of(w.y, rgb.size[1]);
  for (int k = 0; k < 4; ++k) {
    if (!(mix.weight[k] > 0)) continue;
    for (int c = 0; c < 3; ++c) {
      const size_t grid = size_t(mix.grid[k]) * 3 + size_t(c);
      e.value[c] +=
          mix.weight[k] * bilinear(&rgb.values[grid * rgb.nodes() + size_t(y) * rgb.size[0] + x],
                                   rgb.size[0], w.x, w.y);
    }
  }
  if (table_->has_jacobian) {
    const float area = grid_value(table_->sigma, {theta_to_unit(theta), phi_to_unit(phi)});
    e.value *= area > 0 ? grid_value(table_->ndf, u_m) / (4 * area) : 0.0f;
  }
  const float sin_m = std::sqrt(m.x * m.x + m.y * m.y);
  const float jacobian = std::max(2 * kPi * kPi * u_m.x * sin_m, 1e-6f) * 4 * dot(wo, m);
  e.pdf = jacobian > 0 ? vndf * luminance_.density(mix, u) / jacobian : 0.0f;
  return e;
}

std::optional<Vector3f> MeasuredBrdf::sample(const Vector3f& wo_any, const Point2f& v) const {
  if (!(wo_any.z > 0)) return std::nullopt;
  const Mirroring mirror(wo_any, reduction_);
  const Vector3f wo = mirror(wo_any);
  const float theta = elevation(wo), phi = std::atan2(wo.y, wo.x);
  const WarpGrid::Mix mix = vndf_.mix(phi, theta);
  float density;
  const Point2f u = luminance_.sample(mix, {v.y, v.x}, density);
  const Point2f u_m = vndf_.sample(mix, u, density);
  const float phi_m = (2 * u_m.y - 1) * kPi + (isotropic_ ? phi : 0.0f);
  const float theta_m = u_m.x * u_m.x * (kPi / 2), sin_m = std::sin(theta_m);
  const Vector3f m(std::cos(phi_m) * sin_m, std::sin(phi_m) * sin_m, std::cos(theta_m));
  const Vector3f wi = mirror(reflect(wo, m));
  return wi.z > 0 ? std::optional(normalize(wi)) : std::nullopt;
}

ModelEval MeasuredModel::eval(const Vector3f& wo, const Vector3f& wi, Transport transport) const {
  ModelEval e = brdf->eval(wo, wi);
  if (transport == Transport::radiance || !(wo.z > 0 && wi.z > 0)) return e;
  e.value = brdf->eval(wi, wo).value * (wi.z / wo.z);
  return e;
}

std::optional<ModelSample> MeasuredModel::sample(const Vector3f& wo, float, const Point2f& v,
                                                 Transport transport) const {
  const auto wi = brdf->sample(wo, v);
  if (!wi) return std::nullopt;
  return sample_from(eval(wo, *wi, transport), *wi);
}

}  // namespace duet
