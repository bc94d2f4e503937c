#include "evaluate/stability/compare_means.h"

#include <algorithm>
#include <cmath>

namespace duet::stability {

namespace {

/// Tiles darker than this share of the mean of the image are judged relative to that much of it: of
/// what is nearly black nobody needs a hundredth.
constexpr double kDark = 0.25;
/// A reference is made with so many images that its own noise is no more than this share of what
/// the comparison may have.
constexpr double kReferenceNoise = 0.5;

std::optional<double> exact_value(const Row& row, const Variant& variant) {
  return variant.value ? variant.value : row.reference.value;
}

double mean_of(const std::vector<MeanEstimate>& estimates) {
  double sum = 0;
  for (const MeanEstimate& e : estimates) sum += e.mean;
  return sum / double(estimates.size());
}

/// What the images of a series are compared with.
std::vector<MeanEstimate> reference_means(const Cell& cell, const Variant& v, const Series& like,
                                          const Means& means, Rule rule, Measurement& m) {
  if (const auto value = exact_value(cell.row, v))
    return std::vector<MeanEstimate>(means(like.first(1)).front().size(), {*value, 0, 0});
  std::vector<MeanEstimate> estimates;
  Series reference;
  // Whatever the method, so that all methods have the same.
  rule.margin = 0;
  const SeriesPlan plan = reference_plan(cell.row, cell.method, v);
  grow_images(plan.batches, std::max(plan.batches, cell.row.most_batches), [&](int batches) {
    reference = render_reference(cell.laboratory, cell.row, cell.method, v, batches);
    estimates = estimate_each(means(reference));
    std::vector<MeanEstimate> exact = estimates;
    for (MeanEstimate& e : exact) e = {e.mean, 0, 0};
    return compare(estimates, exact, rule).power.noise / kReferenceNoise;
  });
  if (reference.width != like.width || reference.height != like.height)
    throw CatalogueError(cell.row.name + ": the reference has another size");
  require_finite(reference, m);
  return estimates;
}

/// Whether the images of the reference are made of the same random numbers as those of the subject.
bool is_paired(const Cell& cell, const Variant& v) {
  const SeriesPlan a = subject_plan(cell.row, cell.method, v),
                   b = reference_plan(cell.row, cell.method, v);
  return !exact_value(cell.row, v) && cell.row.reference.sum.empty() && a.seed == b.seed &&
         a.spp == b.spp && a.independent == b.independent;
}

/// Images made of the same random numbers differ much less than they vary: what counts is the
/// error of their differences.
Sides paired_sides(const Cell& cell, const Variant& v, const Series& subject, const Means& means,
                   Measurement& m) {
  const Series reference =
      render_reference(cell.laboratory, cell.row, cell.method, v, int(subject.pictures.size()));
  require_finite(reference, m);
  const auto b = means(reference);
  auto a = means(subject);
  Sides sides{{}, estimate_each(b)};
  for (size_t n = 0; n < a.size(); ++n)
    for (size_t i = 0; i < a[n].size(); ++i) a[n][i] += sides.reference[i].mean - b[n][i];
  sides.subject = estimate_each(a);
  for (MeanEstimate& e : sides.reference) e = {e.mean, 0, 0};
  return sides;
}

}  // namespace

std::vector<MeanEstimate> estimate_each(const std::vector<std::vector<double>>& batches) {
  std::vector<MeanEstimate> estimates;
  std::vector<double> values(batches.size());
  for (size_t i = 0; i < batches.front().size(); ++i) {
    for (size_t b = 0; b < batches.size(); ++b) values[b] = batches[b][i];
    estimates.push_back(estimate_mean(values));
  }
  return estimates;
}

GridComparison compare(const std::vector<MeanEstimate>& a, const std::vector<MeanEstimate>& b,
                       const Rule& rule) {
  GridComparison c;
  const double n = double(a.size()), mean = std::abs(mean_of(b));
  double square = 0;
  int noisy = 0;
  c.power.required = rule.margin + rule.allowed_noise();
  for (size_t i = 0; i < a.size(); ++i) {
    const double error2 = a[i].error2 + b[i].error2, d = a[i].mean - b[i].mean;
    square += d * d - error2;
    c.error2 += error2 / n / (mean * mean);
    c.error4 += error2 * error2 / n / std::pow(mean, 4);
    const double slack = rule.margin * std::abs(b[i].mean);
    // Rounding is no deviation.
    const WelchTest test = welch_test(a[i], b[i], slack + 1e-5 * std::abs(b[i].mean));
    c.least_p = std::min(c.least_p, test.p);
    const double scale = std::max(std::abs(b[i].mean), kDark * mean);
    const double noise = noticed_difference(test.error, test.dof, rule.level) / scale;
    c.power.noticed = std::max(c.power.noticed, slack / scale + noise);
    c.power.noise = std::max(c.power.noise, noise / rule.allowed_noise());
    if (!(error2 > 0)) continue;
    ++noisy;
    const double z = normal_of_student(test.t, test.dof);
    c.mean_z2 += z * z;
  }
  if (noisy > 0) c.mean_z2 /= noisy;
  c.ratio = mean_of(a) / mean_of(b);
  c.rms = std::sqrt(std::max(0.0, square / n)) / mean;
  return c;
}

Sides both_sides(const Cell& cell, const Variant& v, const Series& subject, const Means& means,
                 const Rule& rule, Measurement& m) {
  if (is_paired(cell, v)) return paired_sides(cell, v, subject, means, m);
  return {estimate_each(means(subject)), reference_means(cell, v, subject, means, rule, m)};
}

Rule rule_of(const Cell& cell, const Series& subject, double means, double resolution) {
  return {sidak(cell.level, double(cell.row.variants.size()) * means),
          merges(subject.method) ? cell.margin : 0, resolution, cell.coarser};
}

}  // namespace duet::stability
