// Reconstruction filters against Mitsuba's.
#include "image/filter.h"

#include <doctest/doctest.h>

#include <cmath>

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
      for (const FilterProfile* along : {&filter.along_x(), &filter.along_y()}) {
        CHECK(std::abs(along->weight(float(x)) - weight) < 3e-5);
        CHECK(std::abs(along->weight(float(-x)) - weight) < 3e-5);
      }
    }
    const FilterProfile& along = filter.along_x();
    CHECK(along.weight(along.radius()) == 0);
    CHECK(along.weight(along.radius() * 1.5f) == 0);
  }
}

TEST_CASE("filters that reach as far as they are told, along x and y") {
  FilterDescription box{.kind = FilterKind::box};
  box.reach_x = 1.5, box.reach_y = 1;
  const ReconstructionFilter wide(box);
  CHECK(wide.along_x().weight(1.4f) == 1);
  CHECK(wide.along_y().weight(1.1f) == 0);
  CHECK(wide.border() == 1);
  CHECK(!wide.is_unit_box());
  FilterDescription gaussian{.kind = FilterKind::gaussian};
  CHECK(evaluate_filter(gaussian, 0.5, 1.5) == doctest::Approx(std::exp(-0.5) - std::exp(-4.5)));
  CHECK(evaluate_filter(gaussian, 1.5, 1.5) == 0);
  FilterDescription mitchell{.kind = FilterKind::mitchell};
  CHECK(evaluate_filter(mitchell, 1.0, 4.0) == doctest::Approx(evaluate_filter(mitchell, 0.5)));
  FilterDescription sinc{.kind = FilterKind::lanczos};
  CHECK(evaluate_filter(sinc, 3.5, 4.0) != 0);
  CHECK(evaluate_filter(sinc, 3.5) == 0);
}
