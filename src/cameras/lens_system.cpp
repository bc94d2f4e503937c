#include "cameras/lens_system.h"

#include <cmath>

#include "math/vector.h"

namespace duet {

LensSystem::LensSystem(std::vector<LensSurface> surfaces, LensStop stop)
    : surfaces_(std::move(surfaces)), stop_(std::move(stop)) {
  place();
}

void LensSystem::place() {
  meetings_.clear();
  double z = 0;
  for (size_t i = surfaces_.size(); i-- > 0;) {
    const LensSurface& s = surfaces_[i];
    z += s.thickness;
    const double before = i > 0 ? surfaces_[i - 1].ior : 1;
    const double rim = s.radius == 0 ? s.aperture * stop_.reach() : s.aperture;
    meetings_.push_back({z, s.radius, rim * rim, s.ior / before, 1 / s.aperture});
  }
}

void LensSystem::set_film_distance(double distance) {
  surfaces_.back().thickness = distance;
  place();
}

std::optional<double> LensSystem::film_distance_for(double distance) const {
  // (height, angle) behind the last surface is (a b; c d) times that before the first one.
  double a = 1, b = 0, c = 0, d = 1, length = 0, before = 1;
  for (size_t i = 0; i < surfaces_.size(); ++i) {
    const LensSurface& s = surfaces_[i];
    if (s.radius != 0) {
      const double bend = (before - s.ior) / (s.radius * s.ior), shrink = before / s.ior;
      c = bend * a + shrink * c, d = bend * b + shrink * d;
    }
    before = s.ior;
    if (i + 1 == surfaces_.size()) break;
    a += s.thickness * c, b += s.thickness * d;
    length += s.thickness;
  }
  const double focal_length = -1 / c;
  if (!(focal_length > 0 && std::isfinite(focal_length))) return std::nullopt;
  // From the object to the front principal plane and from the rear one to the film.
  const double both = distance - length + (a + d - 2) / c;
  const double root2 = both * (both - 4 * focal_length);
  if (!(both > 0 && root2 >= 0)) return std::nullopt;
  const double image = 0.5 * (both - std::sqrt(root2)), behind = image + (1 - a) / c;
  return behind > 0 ? std::optional(behind) : std::nullopt;
}

inline bool LensSystem::meet_stop(const Meeting& m, LensRay& ray) {
  const double t = (m.z - ray.origin[2]) / ray.direction[2];
  if (!(t >= 0)) return false;
  for (size_t k = 0; k < 3; ++k) ray.origin[k] += t * ray.direction[k];
  return sqr(ray.origin[0]) + sqr(ray.origin[1]) <= m.rim2;
}

inline bool LensSystem::refract_at(const Meeting& m, LensRay& ray) {
  auto& o = ray.origin;
  auto& w = ray.direction;
  const double z = o[2] - (m.z - m.radius);  // from the sphere's centre
  const double half_b = o[0] * w[0] + o[1] * w[1] + z * w[2];
  const double discriminant =
      half_b * half_b - (o[0] * o[0] + o[1] * o[1] + z * z - m.radius * m.radius);
  if (!(discriminant >= 0)) return false;
  // Where the sphere comes nearest to its vertex.
  const double root = std::sqrt(discriminant);
  const double t = (m.radius > 0) == (w[2] > 0) ? root - half_b : -root - half_b;
  if (!(t >= 0)) return false;
  for (size_t k = 0; k < 3; ++k) o[k] += t * w[k];
  if (!(o[0] * o[0] + o[1] * o[1] <= m.rim2)) return false;
  std::array<double, 3> n{o[0] / m.radius, o[1] / m.radius, (o[2] - m.z) / m.radius + 1};
  double cosine = -(n[0] * w[0] + n[1] * w[1] + n[2] * w[2]);
  if (cosine < 0) {
    cosine = -cosine;
    for (double& x : n) x = -x;
  }
  const double beyond2 = 1 - m.ratio * m.ratio * (1 - cosine * cosine);
  if (!(beyond2 >= 0)) return false;
  const double along = m.ratio * cosine - std::sqrt(beyond2);
  for (size_t k = 0; k < 3; ++k) w[k] = m.ratio * w[k] + along * n[k];
  return true;
}

double LensSystem::trace(LensRay& ray) const {
  double passed = 1;
  for (const Meeting& m : meetings_) {
    if (m.radius != 0) {
      if (!refract_at(m, ray)) return 0;
      continue;
    }
    if (!meet_stop(m, ray)) return 0;
    // To the right of the image is -x here.
    passed *= stop_.transmission(-ray.origin[0] * m.unit, ray.origin[1] * m.unit);
    if (passed == 0) return 0;
  }
  return passed;
}

bool LensSystem::passes_rims(LensRay ray) const {
  for (const Meeting& m : meetings_)
    if (!(m.radius == 0 ? meet_stop(m, ray) : refract_at(m, ray))) return false;
  return true;
}

namespace {

using Box = ExitPupil::Box;

/// Film points at several distances from the centre, and which points of the rear plane light from
/// them passes.
class PupilSearch {
 public:
  PupilSearch(const LensSystem& lens, double film0, double film1)
      : lens_(lens), film0_(film0), film1_(film1) {}

  bool passes(double film, double x, double y) const {
    const double dx = x - film, l = std::sqrt(dx * dx + y * y + sqr(lens_.film_distance()));
    return lens_.passes_rims({{film, 0, 0}, {dx / l, y / l, lens_.film_distance() / l}});
  }

  /// The bounds of those points of a grid over `where` that light passes.
  Box find(const Box& where) const {
    Box found{INFINITY, -INFINITY, 0};
    for (int f = 0; f < kFilmPoints; ++f) {
      const double film = film0_ + (film1_ - film0_) * f / (kFilmPoints - 1);
      for (int j = 0; j <= kRows; ++j)
        for (int i = 0; i <= kColumns; ++i) {
          const double x = where.x0 + (where.x1 - where.x0) * i / kColumns, y = where.y * j / kRows;
          if (x >= found.x0 && x <= found.x1 && y <= found.y) continue;
          if (!passes(film, x, y)) continue;
          found.x0 = std::min(found.x0, x), found.x1 = std::max(found.x1, x);
          found.y = std::max(found.y, y);
        }
    }
    return found;
  }

  /// The bounds of the pupil near `start`, with a margin as wide as what a grid may miss; `tight`
  /// becomes those without. Empty if there is none.
  Box bound(const Box& start, Box& tight) const {
    const double side = 1.5 * lens_.rear_aperture();
    const Box all{-side, side, side};
    Box where = start.empty() ? all : start;
    for (int round = 0; round < kRounds; ++round) {
      const double dx = (where.x1 - where.x0) / kColumns, dy = where.y / kRows;
      const Box found = find(where);
      const bool nothing = !(found.x1 >= found.x0);
      if (nothing && where.y >= side) return tight = {};
      const double width = std::max(found.x1 - found.x0, dx), height = std::max(found.y, dy);
      const bool cut = found.x0 <= where.x0 || found.x1 >= where.x1 || found.y >= where.y;
      const bool coarse = width < kFine * (where.x1 - where.x0) || height < kFine * where.y;
      tight = found;
      if (!nothing && !cut && !coarse) return {found.x0 - dx, found.x1 + dx, found.y + dy};
      where = nothing
                  ? all
                  : Box{found.x0 - 0.25 * width, found.x1 + 0.25 * width, found.y + 0.25 * height};
    }
    // Something stranger than one opening: all of the rear surface.
    return all;
  }

 private:
  static constexpr int kFilmPoints = 5, kColumns = 64, kRows = 32, kRounds = 32;
  /// The least share of the grid that the pupil is to have along both axes.
  static constexpr double kFine = 0.4;

  const LensSystem& lens_;
  double film0_, film1_;
};

}  // namespace

ExitPupil::ExitPupil(const LensSystem& lens, double film_radius) : film_radius_(film_radius) {
  // Light from the film's centre passes inside a disk: its radius by bisection.
  const PupilSearch axis(lens, 0, 0);
  double inside = 0, outside = 1.5 * lens.rear_aperture();
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (inside + outside);
    (axis.passes(0, middle, 0) ? inside : outside) = middle;
  }
  axis_ = {-inside, inside, inside};
  Box tight = axis_;
  for (int i = 0; i < kBoxes; ++i) {
    const PupilSearch search(lens, film_radius * i / kBoxes, film_radius * (i + 1) / kBoxes);
    const double width = 0.25 * (tight.x1 - tight.x0), height = 0.25 * tight.y;
    const Box start =
        tight.empty() ? Box{} : Box{tight.x0 - width, tight.x1 + width, tight.y + height};
    boxes_.push_back(search.bound(start, tight));
  }
}

const ExitPupil::Box& ExitPupil::at(double distance) const {
  return boxes_[std::min(size_t(distance / film_radius_ * kBoxes), boxes_.size() - 1)];
}

bool ExitPupil::empty() const {
  for (const Box& b : boxes_)
    if (!b.empty()) return false;
  return true;
}

}  // namespace duet
