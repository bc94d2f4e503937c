#include "image/flip_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "image/flip.h"

namespace duet {

namespace {

using Triple = std::array<float, 3>;
using Plane = std::vector<float>;
using Planes = std::array<Plane, 3>;

/// XYZ from linear sRGB and back (ITU-R BT.709 primaries, D65), to nine digits.
constexpr float kToXyz[3][3] = {{0.412390799f, 0.357584339f, 0.180480788f},
                                {0.212639006f, 0.715168679f, 0.072192315f},
                                {0.019330819f, 0.119194780f, 0.950532152f}};
constexpr float kFromXyz[3][3] = {{3.240969942f, -1.537383178f, -0.498610760f},
                                  {-0.969243636f, 1.875967502f, 0.041555057f},
                                  {0.055630080f, -0.203976959f, 1.056971514f}};
/// White: the sums of the rows.
constexpr Triple kWhite = {0.950455926f, 1.0f, 1.089057751f};

Triple times(const float (&m)[3][3], const Triple& v) {
  Triple r;
  for (size_t i = 0; i < 3; ++i) r[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return r;
}

/// The opponent space YCxCz: CIELAB without its cube roots.
Triple to_opponent(const Triple& rgb) {
  const Triple c = times(kToXyz, rgb);
  const float x = c[0] / kWhite[0], y = c[1] / kWhite[1], z = c[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}
Triple from_opponent(const Triple& c) {
  const float y = (c[0] + 16) / 116, x = y + c[1] / 500, z = y - c[2] / 200;
  return times(kFromXyz, {x * kWhite[0], y * kWhite[1], z * kWhite[2]});
}

/// CIELAB with the chroma scaled by the lightness, for the Hunt effect: colours of dark things
/// matter less.
Triple to_hunt_lab(const Triple& rgb) {
  const auto f = [](float t) {
    constexpr float d = 6.0f / 29;
    return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0f / 29;
  };
  const Triple c = times(kToXyz, rgb);
  const float x = f(c[0] / kWhite[0]), y = f(c[1] / kWhite[1]), z = f(c[2] / kWhite[2]);
  const float l = 116 * y - 16;
  return {l, 0.01f * l * 500 * (x - y), 0.01f * l * 200 * (y - z)};
}

/// The HyAB distance: city blocks between lightness and chroma, Euclid within the chroma.
float hyab(const Triple& a, const Triple& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

/// Distances of colours spread over [0, 1] so that those of large ones, which all look alike, share
/// its end (2020, eq. 6).
float redistribute(float distance) {
  constexpr float exponent = 0.7f, bend_at = 0.4f, bend_to = 0.95f;
  static const float most =
      std::pow(hyab(to_hunt_lab({0, 1, 0}), to_hunt_lab({0, 0, 1})), exponent);
  const float d = std::pow(distance, exponent), bend = bend_at * most;
  return d < bend ? bend_to / bend * d : bend_to + (d - bend) / (most - bend) * (1 - bend_to);
}

/// A filter along one axis, its middle in the middle.
using Kernel = std::vector<float>;

/// The image filtered by `across` along the rows and by `down` along the columns; what lies outside
/// is like the nearest pixel.
Plane filtered(const Plane& image, int width, int height, const Kernel& across,
               const Kernel& down) {
  Plane rows(image.size()), result(image.size());
  const int rx = int(across.size()) / 2, ry = int(down.size()) / 2;
  Plane padded(size_t(width + 2 * rx));
  for (int y = 0; y < height; ++y) {
    const float* from = &image[size_t(y) * size_t(width)];
    for (int x = -rx; x < width + rx; ++x)
      padded[size_t(x + rx)] = from[std::clamp(x, 0, width - 1)];
    float* to = &rows[size_t(y) * size_t(width)];
    for (size_t k = 0; k < across.size(); ++k)
      for (int x = 0; x < width; ++x) to[x] += across[k] * padded[size_t(x) + k];
  }
  for (int y = 0; y < height; ++y) {
    float* to = &result[size_t(y) * size_t(width)];
    for (int k = -ry; k <= ry; ++k) {
      const float* from = &rows[size_t(std::clamp(y + k, 0, height - 1)) * size_t(width)];
      const float w = down[size_t(k + ry)];
      for (int x = 0; x < width; ++x) to[x] += w * from[x];
    }
  }
  return result;
}

/// What the eye does not resolve, filtered out: the contrast sensitivity of each opponent channel
/// as Gaussians exp(−π² d² / b) of weights a √(π/b), d in degrees (2020, sec. 4.1.1).
struct Sensitivity {
  struct Gaussian {
    Kernel kernel;
    float weight;
  };
  std::array<std::vector<Gaussian>, 3> of_channel;

  Sensitivity() {
    constexpr double widest = 0.04;
    const int radius = int(std::ceil(
        3 * std::sqrt(widest / (2 * std::numbers::pi * std::numbers::pi)) * kFlipPixelsPerDegree));
    const std::pair<double, double> terms[3][2] = {
        {{1, 0.0047}, {0, 0}}, {{1, 0.0053}, {0, 0}}, {{34.1, 0.04}, {13.5, 0.025}}};
    for (size_t channel = 0; channel < 3; ++channel) {
      double total = 0;
      for (const auto& [a, b] : terms[channel]) {
        if (a == 0) continue;
        Gaussian g;
        double sum = 0;
        for (int i = -radius; i <= radius; ++i) {
          const double d = i / kFlipPixelsPerDegree;
          g.kernel.push_back(float(std::exp(-std::numbers::pi * std::numbers::pi * d * d / b)));
          sum += g.kernel.back();
        }
        for (float& k : g.kernel) k = float(k / sum);
        g.weight = float(a * std::sqrt(std::numbers::pi / b) * sum * sum);
        total += g.weight;
        of_channel[channel].push_back(std::move(g));
      }
      for (Gaussian& g : of_channel[channel]) g.weight = float(g.weight / total);
    }
  }

  Plane apply(size_t channel, const Plane& image, int width, int height) const {
    Plane result(image.size());
    for (const Gaussian& g : of_channel[channel]) {
      const Plane part = filtered(image, width, height, g.kernel, g.kernel);
      for (size_t i = 0; i < result.size(); ++i) result[i] += g.weight * part[i];
    }
    return result;
  }
};

/// Detectors of edges and points: the first and second derivative of a Gaussian, each part of one
/// sign with the sum 1 (2020, sec. 4.2).
struct FeatureKernels {
  Kernel smooth, edge, point;

  FeatureKernels() {
    constexpr double feature_width = 0.082;  // in degrees
    const double deviation = 0.5 * feature_width * kFlipPixelsPerDegree;
    const int radius = int(std::ceil(3 * deviation));
    for (int i = -radius; i <= radius; ++i) {
      const double g = std::exp(-i * i / (2 * deviation * deviation));
      smooth.push_back(float(g));
      edge.push_back(float(-i * g));
      point.push_back(float((i * i / (deviation * deviation) - 1) * g));
    }
    for (Kernel* k : {&smooth, &edge, &point}) {
      double positive = 0, negative = 0;
      for (const float v : *k) (v > 0 ? positive : negative) += std::abs(v);
      for (float& v : *k) v = float(v / (v > 0 ? positive : negative));
    }
  }
};

/// The strength of edges and points of an image's lightness.
struct Features {
  Plane edges, points;

  Features(const Plane& lightness, int width, int height) {
    static const FeatureKernels k;
    const auto strength = [&](const Kernel& derivative) {
      const Plane x = filtered(lightness, width, height, derivative, k.smooth);
      Plane y = filtered(lightness, width, height, k.smooth, derivative);
      for (size_t i = 0; i < y.size(); ++i) y[i] = std::hypot(x[i], y[i]);
      return y;
    };
    edges = strength(k.edge);
    points = strength(k.point);
  }
};

/// One image as the metric sees it.
struct Seen {
  std::vector<Triple> colours;
  Features features;
};

Seen look(const std::vector<Triple>& rgb, int width, int height) {
  static const Sensitivity sensitivity;
  Planes opponent;
  for (Plane& p : opponent) p.resize(rgb.size());
  Plane lightness(rgb.size());
  for (size_t i = 0; i < rgb.size(); ++i) {
    const Triple c = to_opponent(rgb[i]);
    for (size_t k = 0; k < 3; ++k) opponent[k][i] = c[k];
    lightness[i] = (c[0] + 16) / 116;
  }
  for (size_t k = 0; k < 3; ++k) opponent[k] = sensitivity.apply(k, opponent[k], width, height);
  std::vector<Triple> colours(rgb.size());
  for (size_t i = 0; i < rgb.size(); ++i) {
    Triple c = from_opponent({opponent[0][i], opponent[1][i], opponent[2][i]});
    for (float& v : c) v = std::clamp(v, 0.0f, 1.0f);
    colours[i] = to_hunt_lab(c);
  }
  return {std::move(colours), Features(lightness, width, height)};
}

}  // namespace

std::vector<float> flip_map(const FlipColours& image, const FlipColours& reference, int width,
                            int height) {
  const Seen a = look(image, width, height), b = look(reference, width, height);
  Plane map(image.size());
  for (size_t i = 0; i < map.size(); ++i) {
    const float colour = redistribute(hyab(a.colours[i], b.colours[i]));
    const float feature = std::max(std::abs(a.features.edges[i] - b.features.edges[i]),
                                   std::abs(a.features.points[i] - b.features.points[i]));
    map[i] = std::pow(colour, 1 - std::sqrt(std::min(1.0f, feature / std::sqrt(2.0f))));
  }
  return map;
}

}  // namespace duet
