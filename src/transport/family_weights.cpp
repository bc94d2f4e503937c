#include "transport/family_weights.h"

namespace duet {

namespace {

/// Densities by family, relative to those of the technique at hand.
struct Sums {
  double unidirectional = 0, light_image = 0, connections = 0, merges = 0;
  double first_merge = 0;  ///< is among `merges`
  double all() const { return unidirectional + light_image + connections + merges; }
};

}  // namespace

FamilyWeights::Path& FamilyWeights::start(int count) const {
  path_.count = count;
  path_.found = 0;
  path_.gain = 1;
  return path_;
}

void FamilyWeights::take_light(Path& path, int m, const ConnectionEnd& end) const {
  const VertexPdfs& last = ends_ ? ends_->vertex : light_[size_t(m)];
  const double beyond = double(end.beyond) * double(last.back);
  path.direct = double(ends_ ? ends_->light.back : light_[0].back);
  path.emitted = double(m == 1 ? last.forward : light_[1].forward);
  if (!light_[0].specular) path.found = m == 1 ? beyond : double(light_[0].reverse);
  for (int i = 1; i <= m; ++i) {
    const VertexPdfs& v = i == m ? last : light_[size_t(i)];
    path.light[size_t(i)] = double(v.forward);
    path.eye[size_t(i)] = i == m ? double(end.arrival) : i == m - 1 ? beyond : double(v.reverse);
    path.specular[size_t(i)] = i < m && v.specular;
    path.merges[size_t(i)] = i < m ? v.merges : end.merges;
  }
}

void FamilyWeights::take_eye(Path& path, int n, const ConnectionEnd& end) const {
  for (int j = 1; j <= n; ++j) {
    const VertexPdfs& v = eye_[size_t(j)];
    const size_t i = size_t(path.count + 1 - j);
    path.eye[i] = double(v.forward);
    path.light[i] = j == n       ? double(end.arrival)
                    : j == n - 1 ? double(end.beyond) * double(eye_[size_t(n)].back)
                                 : double(v.reverse);
    path.specular[i] = j < n && v.specular;
    path.merges[i] = j < n ? v.merges : end.merges;
  }
}

// P_s is the density with which the first s vertices come from the light and all others from the
// eye, relative to that of the technique at hand, whether or not the two ends can be connected.
float FamilyWeights::weigh(const Path& path, int s, bool merges) const {
  const int last = path.count;
  const auto smooth = [&](int i) { return !path.specular[size_t(i)]; };
  const auto connections = [&](int i) {  // the two ends between vertex i and the next
    return (i == 0 || smooth(i)) && (i == last || smooth(i + 1));
  };
  const auto merges_at = [&](int i) { return smooth(i) && path.merges[size_t(i)]; };
  int first = last;  // seen from the eye
  while (first >= 1 && !merges_at(first)) --first;
  Sums sums;
  const auto add_merge = [&](int i, double density) {
    if (merges_at(i)) sums.merges += density * eta_;
    if (i == first) sums.first_merge = density * eta_;
  };
  double own = 0;
  const auto add = [&](int light_vertices, double density) {
    if (light_vertices <= 1) {
      if (light_vertices == 0 || smooth(1)) sums.unidirectional += density;
    } else if (connections(light_vertices - 1)) {
      (light_vertices == last + 1 ? sums.light_image : sums.connections) +=
          light_vertices == last + 1 ? density * light_paths_ : density;
    }
  };
  add(s, 1);
  own = s == last + 1 ? light_paths_ : 1.0;
  double ratio = 1;
  for (int i = s - 1; i >= 1; --i) {
    const double both = ratio * path.eye[size_t(i)];
    add_merge(i, both);
    if (merges && i == s - 1) own = both * eta_;
    if (i > 1) {
      ratio = both / path.light[size_t(i)];
      add(i, ratio);
    } else {
      add(1, both * path.direct / path.emitted);
      add(0, both * path.found / path.emitted);
    }
  }
  ratio = 1;
  if (s == 0) add(1, path.direct / path.found);
  if (s == 1) add(0, path.found / path.direct);
  for (int i = std::max(s, 1); i <= last; ++i) {
    const double both = i > 1    ? ratio * path.light[size_t(i)]
                        : s == 0 ? path.emitted / path.found
                                 : path.emitted / path.direct;
    add_merge(i, both);
    ratio = both / path.eye[size_t(i)];
    add(i + 1, ratio);
  }
  const double inverse = 1 / sums.all();
  shares_ = {float(sums.unidirectional * inverse), float(sums.light_image * inverse),
             float(sums.connections * inverse),    float(sums.merges * inverse),
             float(sums.first_merge * inverse),    float(path.gain)};
  return float(own * inverse);
}

float FamilyWeights::hit(const Subpath& subpath, float direct, float emission,
                         const LightSampleVariance& light_sample) const {
  const int n = int(eye_.size()) - 1;  // the last vertex before the light
  if (n == 0) {
    shares_ = {1, 0, 0, 0, 0};
    return 1;
  }
  Path& path = start(n);
  take_eye(path, n, {0, 0});
  for (int j = 1; j <= n; ++j) {
    const size_t i = size_t(n + 1 - j);
    path.light[i] = double(eye_[size_t(j)].reverse);
    path.specular[i] = eye_[size_t(j)].specular;
    path.merges[i] = eye_[size_t(j)].merges;
  }
  path.found = double(subpath.forward);
  path.direct = double(direct);
  path.emitted = double(emission) * double(subpath.cosine_out);
  path.count_direct(light_sample.gain(0));
  return weigh(path, 0, false);
}

float FamilyWeights::light_sample(const PathVertex& eye, float direct, float bsdf,
                                  const ConnectionEnd& eye_end) const {
  Path& path = start(eye.depth);
  take_eye(path, eye.depth, eye_end);
  path.found = double(bsdf);
  path.direct = double(direct);
  path.emitted = double(eye_end.arrival) * double(direct);
  if (eye.depth == 1) path.count_direct(eye_end.light_sample.gain(1 / eye_[1].forward));
  return weigh(path, 1, false);
}

float FamilyWeights::camera(const PathVertex& light, const ConnectionEnd& light_end) const {
  Path& path = start(light.depth);
  take_light(path, light.depth, light_end);
  if (light.depth == 1) path.count_direct(light_end.light_sample.gain(1 / light_end.arrival));
  return weigh(path, light.depth + 1, false);
}

float FamilyWeights::connection(const PathVertex& light, const ConnectionEnd& light_end,
                                const PathVertex& eye, const ConnectionEnd& eye_end) const {
  Path& path = start(light.depth + eye.depth);
  take_light(path, light.depth, light_end);
  take_eye(path, eye.depth, eye_end);
  return weigh(path, light.depth + 1, false);
}

// As if the light sub-path had made the common vertex, which the eye sub-path's density there then
// makes a merge.
float FamilyWeights::merge(const LightVertex& light, float light_reverse, const PathVertex& eye,
                           float eye_reverse) const {
  const int m = int(light.depth), n = eye.depth;
  Path& path = start(m + n - 1);
  const VertexPdfs& common = eye_[size_t(n)];
  take_light(path, m, {common.forward, light_reverse, true});
  if (m == 1 && n == 1) path.count_direct(light.light_sample_gain(1 / common.forward));
  take_eye(path, n - 1, {eye_reverse * common.back, 0, eye_[size_t(n - 1)].merges});
  // Seen from the merge, the last vertex and the one before are as recorded.
  if (n > 1) path.specular[size_t(path.count + 2 - n)] = eye_[size_t(n - 1)].specular;
  if (n > 2) path.light[size_t(path.count + 3 - n)] = double(eye_[size_t(n - 2)].reverse);
  return weigh(path, m + 1, true);
}

}  // namespace duet
