#include "lights/environment_guide.h"

#include <algorithm>

#include "math/square_tree.h"

namespace duet {

namespace {

/// Shares of directions that the environment may choose by itself: many where its radiance differs
/// more than what the walls let through.
constexpr std::array<float, 3> kPlainShares = {0.25f, 0.5f, 0.75f};
/// Of a wall's density, while it is learned; what is not at least twice that is not chosen.
constexpr float kUniformShare = 0.02f, kLeastDensity = 2 * kUniformShare;

}  // namespace

EnvironmentGuide::EnvironmentGuide(const BoxWalls& walls, std::span<const Record> records)
    : walls_(walls), probability_(BoxWalls::kCells) {
  std::array<std::vector<SquareTree::Record>, BoxWalls::kWalls> by_wall;
  std::array<double, BoxWalls::kWalls> mass{};
  double all = 0;
  for (const Record& r : records) {
    const BoxWalls::Exit e = walls.exit(r.at, r.wi);
    by_wall[size_t(e.wall)].push_back({e.at, r.use / r.pdf.value});
    mass[size_t(e.wall)] += double(r.use / r.pdf.value);
    all += double(r.use / r.pdf.value);
  }
  std::vector<float> weights;
  for (uint32_t wall = 0; wall < BoxWalls::kWalls; ++wall) {
    const SquareTree tree(by_wall[wall], kUniformShare);
    for (uint32_t i = 0; i < BoxWalls::kCellsOfWall; ++i) {
      const Point2f middle{(float(i % BoxWalls::kSide) + 0.5f) / BoxWalls::kSide,
                           (float(i / BoxWalls::kSide) + 0.5f) / BoxWalls::kSide};
      const float density = tree.density(middle, BoxWalls::kDivisions);
      if (!(density > kLeastDensity && mass[wall] > 0)) continue;
      cells_.push_back(wall * BoxWalls::kCellsOfWall + i);
      weights.push_back(density * float(mass[wall] / all));
    }
  }
  choice_ = DiscreteDistribution(weights);
  for (uint32_t i = 0; i < cells_.size(); ++i) probability_[cells_[i]] = choice_.probability(i);
  const auto moment_with = [&](float share) {
    plain_share_ = share;
    return moment(records);
  };
  std::array<double, kPlainShares.size()> moments;
  std::transform(kPlainShares.begin(), kPlainShares.end(), moments.begin(), moment_with);
  plain_share_ =
      kPlainShares[size_t(std::min_element(moments.begin(), moments.end()) - moments.begin())];
}

PdfW EnvironmentGuide::mixed(PdfW plain, PdfW wall) const {
  return {lerp(wall.value, plain.value, plain_share_)};
}

PdfW EnvironmentGuide::wall_pdf(const Point3f& from, const Vector3f& wi) const {
  const BoxWalls::Exit e = walls_.exit(from, wi);
  return {probability_[e.cell()] * e.pdf_of_cell};
}

std::optional<LightSample> EnvironmentGuide::sample_direct(const EnvironmentLight& light,
                                                           const Point3f& from,
                                                           const Point2f& u) const {
  if (!walls_.holds(from)) return light.sample_direct(from, u);
  LightSample s;
  PdfW wall;
  if (u.x < plain_share_) {
    const auto plain = light.sample_direct(from, {std::min(u.x / plain_share_, kBelowOne), u.y});
    if (!plain) return std::nullopt;
    s.wi = plain->wi;
    wall = wall_pdf(from, s.wi);
  } else {
    const float x = std::min((u.x - plain_share_) / (1 - plain_share_), kBelowOne);
    const DiscreteDistribution::Pick pick = choice_.sample(x, u);
    const uint32_t cell = cells_[pick.index];
    const Vector3f d = walls_.point(cell, {pick.remapped, u.y}) - from;
    const float d2 = length_squared(d);
    s.wi = d * (1 / std::sqrt(d2));
    const int axis = BoxWalls::axis_of(cell);
    wall.value = pick.probability * walls_.pdf_of_cell(axis, d2, std::abs(s.wi[axis]));
  }
  const PdfW plain = light.pdf_direct(from, s.wi);
  s.pdf = mixed(plain, wall);
  s.weight = light.emitted(from, s.wi) / s.pdf.value;
  s.emission = plain.value * light.entered_sphere()->density();
  s.finite = false;
  return s;
}

PdfW EnvironmentGuide::pdf(const EnvironmentLight& light, const Point3f& from,
                           const Vector3f& wi) const {
  const PdfW plain = light.pdf_direct(from, wi);
  return walls_.holds(from) ? mixed(plain, wall_pdf(from, wi)) : plain;
}

double EnvironmentGuide::moment(std::span<const Record> records) const {
  double plain = 0, guided = 0;
  for (const Record& r : records) {
    const double use2 = sqr(double(r.use)) / double(r.pdf.value);
    plain += use2 / double(r.plain_pdf.value);
    guided += use2 / double(mixed(r.plain_pdf, wall_pdf(r.at, r.wi)).value);
  }
  return guided / plain;
}

}  // namespace duet
