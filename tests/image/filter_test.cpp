// Reconstruction filters against Mitsuba's.
#include "image/filter.h"

#include <doctest/doctest.h>

#include "support/tables.h"

using namespace duet;

namespace {

FilterDescription to_filter(const test::Json& f) {
  const std::string kind = f["kind"];
  FilterDescription d;
  d.kind = kind == "box"          ? FilterKind::box
           : kind == "tent"       ? FilterKind::tent
           : kind == "gaussian"   ? FilterKind::gaussian
           : kind == "mitchell"   ? FilterKind::mitchell
           : kind == "catmullrom" ? FilterKind::catmullrom
                                  : FilterKind::lanczos;
  const test::Json& p = f["parameters"];
  d.radius = p.value("radius", kind == "tent" ? 1.0 : 0.5);
  d.stddev = p.value("stddev", d.stddev);
  d.b = p.value("B", d.b);
  d.c = p.value("C", d.c);
  d.lobes = p.value("lobes", d.lobes);
  return d;
}

}  // namespace

TEST_CASE("filters have the values and radii of Mitsuba's") {
  const test::Json table = test::read_table("filters");
  for (const test::Json& f : table["filters"]) {
    const FilterDescription description = to_filter(f);
    const ReconstructionFilter filter(description);
    const FilterProfile& profile = filter.along_x();
    INFO(f["kind"].dump() << f["parameters"].dump());
    CHECK(filter_radius(description) == doctest::Approx(f["radius"].get<double>()).epsilon(1e-6));
    CHECK(filter.border() == f["border"].get<int>());
    CHECK(filter.is_unit_box() == (f["kind"] == "box"));
    for (const test::Json& row : f["values"]) {
      const double x = row[0], weight = row[1];
      INFO(x);
      // Mitsuba's own rounding shows in its Gaussian.
      CHECK(std::abs(evaluate_filter(description, x) - weight) <
            (f["kind"] == "gaussian" ? 2e-5 : 1e-5));
      CHECK(evaluate_filter(description, -x) == evaluate_filter(description, x));
      // The table interpolates.
      CHECK(std::abs(profile.weight(float(x)) - weight) < 3e-5);
      CHECK(std::abs(profile.weight(float(-x)) - weight) < 3e-5);
    }
    CHECK(profile.weight(profile.radius()) == 0);
    CHECK(profile.weight(profile.radius() * 1.5f) == 0);
  }
}
