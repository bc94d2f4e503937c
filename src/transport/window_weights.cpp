#include "transport/window_weights.h"

namespace duet {

namespace {

/// The reverse density of vertex i of a side whose last vertex is number n, with the pdfs `last`,
/// where the other side's end goes on from it.
double reverse_density(std::span<const VertexPdfs> side, const VertexPdfs& last, int i, int n,
                       const ConnectionEnd& end) {
  if (i == n) return double(end.arrival);
  if (i == n - 1) return double(end.beyond) * double(last.back);
  return double(side[size_t(i)].reverse);
}

}  // namespace

double WindowWeights::fewer(std::span<const VertexPdfs> light, const EndPdfs& ends, int m, int t,
                            const ConnectionEnd& end) const {
  const double direct = double(ends.light.back);
  double sum = 0, ratio = 1;
  // Vertex i changes sides: it is made from the eye's end now, and i light vertices are left.
  for (int i = m; i >= 1; --i) {
    const VertexPdfs& v = i == m ? ends.vertex : light[size_t(i)];
    ratio *= reverse_density(light, ends.vertex, i, m, end) / double(v.forward);
    // Of a single light vertex light samples have a density of their own.
    if (i == 1) ratio *= direct;
    ++t;
    const bool connections = (i == m || !v.specular) && (i == 1 || !light[size_t(i - 1)].specular);
    if (connections) sum += windows_.share(i, t) * ratio;
  }
  if (light[0].specular) return sum;
  const double found =
      m == 1 ? double(end.beyond) * double(ends.vertex.back) : double(light[0].reverse);
  return sum + windows_.share(0, t + 1) * ratio * found / direct;
}

double WindowWeights::more(int n, int s, const ConnectionEnd& end) const {
  const SubpathPdfs& eye = *eye_;
  double sum = 0, ratio = 1;
  for (int j = n; j >= 1; --j) {
    const VertexPdfs& v = eye[size_t(j)];
    ratio *= reverse_density(eye, eye[size_t(n)], j, n, end) / double(v.forward);
    ++s;
    const bool connections = (j == n || !v.specular) && (j == 1 || !eye[size_t(j - 1)].specular);
    if (connections) sum += windows_.share(s, j) * ratio;
  }
  return sum;
}

float WindowWeights::hit(const Subpath& subpath, float direct, float emission,
                         const LightSampleVariance& light_sample) const {
  const SubpathPdfs& eye = *eye_;
  const int n = int(eye.size()) - 1;  // the last vertex before the light
  if (n == 0) return 1;
  const double own = windows_.share(0, n + 2);
  if (own == 0) return 0;
  double sum = own;
  const VertexPdfs& last = eye[size_t(n)];
  const double found = double(subpath.forward);
  if (!last.specular) sum += windows_.share(1, n + 1) * double(direct) / found;
  // From two light vertices on the last eye vertex is among them.
  double ratio = double(emission) * double(subpath.cosine_out) /
                 (found * double(last.forward) * double(light_sample.gain(0)));
  for (int j = n, s = 2; j >= 1; --j, ++s) {
    const bool connections = !eye[size_t(j)].specular && (j == 1 || !eye[size_t(j - 1)].specular);
    if (connections) sum += windows_.share(s, j) * ratio;
    if (j > 1) ratio *= double(eye[size_t(j - 1)].reverse) / double(eye[size_t(j - 1)].forward);
  }
  return float(own / sum);
}

float WindowWeights::light_sample(const PathVertex& eye, float direct, float bsdf,
                                  const ConnectionEnd& eye_end) const {
  const int n = eye.depth;
  const double own = windows_.share(1, n + 1);
  if (own == 0) return 0;
  const double found = windows_.share(0, n + 2) * double(bsdf) / double(direct);
  const double gain = double(eye_end.light_sample.gain(1 / (*eye_)[1].forward));
  return float(own / (own + found + more(n, 1, eye_end) / gain));
}

float WindowWeights::camera(const PathVertex& light, const ConnectionEnd& light_end) const {
  const int m = light.depth;
  const double own = windows_.share(m + 1, 1);
  if (own == 0) return 0;
  const EndPdfs ends{light_->front(), light_->back()};
  const double gain = double(light_end.light_sample.gain(1 / light_end.arrival));
  return float(own / (own + gain * fewer(*light_, ends, m, 1, light_end)));
}

float WindowWeights::connection(const PathVertex& light, const ConnectionEnd& light_end,
                                const PathVertex& eye, const ConnectionEnd& eye_end) const {
  const int m = light.depth, n = eye.depth;
  const double own = windows_.share(m + 1, n + 1);
  if (own == 0) return 0;
  const EndPdfs ends = ends_ ? *ends_ : EndPdfs{light_subpath_[0], light_subpath_[size_t(m)]};
  return float(own /
               (own + fewer(light_subpath_, ends, m, n + 1, light_end) + more(n, m + 1, eye_end)));
}

}  // namespace duet
