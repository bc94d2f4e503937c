// The SGGX microflake distribution.
#include "math/warp.h"
#include "media/phase_functions.h"

namespace duet {

namespace {

/// The square of the area that an ellipsoid turns to `w`: wᵀ S w.
float squared_area(const SymmetricMatrix& s, const Vector3f& w) {
  return std::max(0.0f, w.x * w.x * s[0] + w.y * w.y * s[1] + w.z * w.z * s[2] +
                            2 * (w.x * w.y * s[3] + w.x * w.z * s[4] + w.y * w.z * s[5]));
}

/// The lower triangle M with S = M Mᵀ. A matrix that is nearly or wholly singular (fibres without
/// thickness, empty places of a grid) is treated as if it were a little thicker.
struct Factor {
  float xx, yx, zx, yy, zy, zz;

  explicit Factor(const SymmetricMatrix& s) {
    const float least = 1e-6f * (s[0] + s[1] + s[2]) + 1e-30f;
    xx = std::sqrt(std::max(s[0], least));
    yx = s[3] / xx;
    zx = s[4] / xx;
    yy = std::sqrt(std::max(s[1] - yx * yx, least));
    zy = (s[5] - zx * yx) / yy;
    zz = std::sqrt(std::max(s[2] - zx * zx - zy * zy, least));
  }
  Vector3f times(const Vector3f& v) const {
    return {xx * v.x, yx * v.x + yy * v.y, zx * v.x + zy * v.y + zz * v.z};
  }
  Vector3f transposed_times(const Vector3f& v) const {
    return {xx * v.x + yx * v.y + zx * v.z, yy * v.y + zy * v.z, zz * v.z};
  }
  /// M⁻¹ v.
  Vector3f solve(const Vector3f& v) const {
    const float x = v.x / xx, y = (v.y - yx * x) / yy;
    return {x, y, (v.z - zx * x - zy * y) / zz};
  }
  float determinant() const { return xx * yy * zz; }
  float area(const Vector3f& w) const { return length(transposed_times(w)); }
};

/// D(h) / (4 σ(wo)), where D(h) = 1 / (π |S|^½ (hᵀ S⁻¹ h)²): equations 2, 9 and 14 of the paper.
float reflected_density(const Factor& m, const Vector3f& wo, const Vector3f& h) {
  const float q = length_squared(m.solve(h));
  const float denominator = 4 * kPi * m.determinant() * q * q * m.area(wo);
  return denominator > 0 ? 1 / denominator : 0.0f;
}

}  // namespace

Sggx::Sggx(const MatrixVolume& matrix) : matrix_(matrix) {
  // No direction sees more than the trace of S allows.
  double most = 0;
  const auto consider = [&](const float* s) {
    most = std::max(most, double(s[0]) + double(s[1]) + double(s[2]));
  };
  if (matrix.grid) {
    const VolumeGrid& grid = matrix.grid->grid();
    for (size_t i = 0; i < grid.node_count(); ++i) consider(&grid.values[6 * i]);
  } else {
    consider(matrix.constant.data());
  }
  max_extinction_ = float(std::sqrt(most));
}

float Sggx::extinction(const Point3f& p, const Vector3f& w) const {
  return std::sqrt(squared_area(matrix_(p), w));
}

PdfW Sggx::eval(const Point3f& p, const Vector3f& wo, const Vector3f& wi) const {
  const Vector3f h = wo + wi;
  const float l2 = length_squared(h);
  if (!(l2 > 0)) return {0};
  return {reflected_density(Factor(matrix_(p)), wo, h / std::sqrt(l2))};
}

/// The ellipsoid is the image of a sphere. A sphere's normals u are seen from the direction Mᵀ wo
/// in proportion to their cosine with it, and M u is a normal of the ellipsoid; all areas scale
/// alike.
PhaseSample Sggx::sample(const Point3f& p, const Vector3f& wo, float, const Point2f& v) const {
  const Factor m(matrix_(p));
  const Frame frame(Normal3f(normalize(m.transposed_times(wo))));
  const Vector3f u = frame.to_world(square_to_cosine_hemisphere(v));
  const Vector3f h = normalize(m.times(u));
  const Vector3f wi = normalize(reflect(wo, h));
  return {wi, {reflected_density(m, wo, h)}};
}

}  // namespace duet
