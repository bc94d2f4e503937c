// The statistics of the stability table: what is measured, and when it holds.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "evaluate/stability/catalogue.h"
#include "evaluate/stability/laboratory.h"
#include "evaluate/stability/power.h"
#include "math/statistics.h"

namespace duet::stability {

/// Level of significance of the whole table: the chance that any cell fails by bad luck.
inline constexpr double kTableLevel = 0.01;

struct Measurement {
  double value = 0;
  double error = 0;  ///< standard error of the value, where there is one
  bool holds = true;
  Power power;
  std::string detail;  ///< for people: further figures
};

/// A cell of the table about to be measured.
struct Cell {
  const Row& row;
  const std::string& method;
  Laboratory& laboratory;
  double level;   ///< of significance, for this cell alone
  double limit;   ///< of the statistic
  double margin;  ///< share of a mean that merging may be off by
  /// By how much coarser than in the whole run the bounds of the power are.
  double coarser = 1;
  bool known_to_fail = false;
};

enum class Unit { percent, number, count };

struct Check {
  const char* name;
  Unit unit;
  const char* summary;  ///< what the value is
  const char* power;    ///< what the deviation is that would have been noticed
  /// How the limit reads, with "{}" for the number; null if there is none.
  const char* limit_text;
  double limit;  ///< unless the row has one of its own
  /// For comparisons of means: by how much those of methods that merge may be off.
  std::optional<double> margin;
  bool needs_reference;
  Measurement (*measure)(const Cell& cell);
};
/// All statistics, for catalogue files and for the documentation.
std::span<const Check> checks();
const Check& find_check(const std::string& name);

// The checks, by the file that they are in.
// checks_mean.cpp: whether means are right.
Measurement measure_tiles(const Cell& cell);
Measurement measure_pixels(const Cell& cell);
Measurement measure_energy(const Cell& cell);
Measurement measure_region(const Cell& cell);
Measurement measure_paired(const Cell& cell);
Measurement measure_shrinking(const Cell& cell);
// checks_noise.cpp: how noise behaves.
Measurement measure_fireflies(const Cell& cell);
Measurement measure_spike(const Cell& cell);
Measurement measure_noise(const Cell& cell);
Measurement measure_jump(const Cell& cell);
Measurement measure_efficiency(const Cell& cell);
Measurement measure_variance(const Cell& cell);
// check_slope.cpp: how fast errors shrink.
Measurement measure_slope(const Cell& cell);
Measurement measure_slope_debiasing(const Cell& cell);
// checks_exact.cpp: what has no noise.
Measurement measure_bits(const Cell& cell);
Measurement measure_finite(const Cell& cell);
Measurement measure_crowding(const Cell& cell);
Measurement measure_stops(const Cell& cell);

// What checks share.
/// Measures every variant of the row: the result is that of the worst one, and holds if all hold.
/// Its power is that of the weakest.
Measurement worst_variant(const Cell& cell,
                          const std::function<Measurement(const Variant&)>& measure);
/// Measures with growing numbers of images, until what has to be noticed would be. A failure that
/// is known needs no more than it takes to see it.
Measurement measure_resolved(const Cell& cell, const std::function<Measurement(int)>& measure);
/// Both: of every variant as many images as it takes.
Measurement worst_resolved_variant(const Cell& cell,
                                   const std::function<Measurement(const Variant&, int)>& measure);
/// The series of the method under test, with so many images.
Series render_subject(const Cell& cell, const Variant& variant, int batches);
/// Pixels that are not finite or negative, and more than a millionth of dropped samples, fail
/// whatever is measured.
void require_finite(const Series& series, Measurement& m);
/// Of each image, the means of grid × grid tiles.
std::vector<std::vector<double>> tile_means(const Series& series, int grid_x, int grid_y);
/// The mean of the image over a region, of each image.
std::vector<double> region_means(const Series& series, const Region& region);
/// The mean of the row's region, in images made in some way, against that of the reference.
Measurement compare_energy(const Cell& cell, const Series& subject, const Variant& variant);
/// The mean of all images, pixel by pixel.
std::vector<double> mean_image(const Series& series);
/// Groups of images that jackknives leave out in turn.
int jackknife_groups(size_t images);

}  // namespace duet::stability
