// Curves.
#include <cmath>

#include "pbrt/curves.h"
#include "pbrt/shape_readers.h"
#include "values/text.h"

namespace duet::pbrt {

namespace {

using enum Status;

constexpr Spec kCurve[] = {
    {"P", kPoint3, "", "control points", 0},
    {"type", kString, "flat", "flat, cylinder or ribbon"},
    {"basis", kString, "bezier", "bezier or bspline"},
    {"degree", kInteger, "3", "2 or 3"},
    {"width", kNumber, "1", "across the ribbon"},
    {"width0", kNumber, "", "at the beginning"},
    {"width1", kNumber, "", "at the end"},
    {"N", kNormal, "", "of ribbons", 0, ignored},
    {"splitdepth", kInteger, "3", "", 1, inert},
};

void read_curve(Values& v) {
  Report& report = v.reader().report();
  CurvePoints curve;
  const std::vector<double> p = v.numbers("P");
  for (size_t i = 0; i + 2 < p.size(); i += 3) curve.points.push_back({p[i], p[i + 1], p[i + 2]});
  curve.degree = v.integer("degree");
  const std::string basis = v.string("basis"), type = v.string("type");
  curve.bspline = basis == "bspline";
  if (basis != "bezier" && basis != "bspline")
    report.error(v.where("basis"), "a curve's basis is bezier or bspline, not {}",
                 in_quotes(basis));
  if (type != "flat" && type != "cylinder" && type != "ribbon")
    report.error(v.where("type"), "a curve's type is flat, cylinder or ribbon, not {}",
                 in_quotes(type));
  else if (type == "ribbon")
    v.reader().approximate(v.where("type"),
                           "ribbons with a side of their own by such that face "
                           "each ray");
  const double width = v.number("width");
  curve.width0 = v.has("width0") ? v.number("width0") : width;
  curve.width1 = v.has("width1") ? v.number("width1") : width;
  if (const std::string why = check_curve(curve); !why.empty()) {
    report.error(v.where("P"), "{}", why);
    return;
  }
  CurveSet tubes = make_tubes(curve);
  // Tubes keep their radii under transforms, and pbrt's widths stretch.
  const double scale = std::cbrt(std::abs(v.reader().state().ctm[0].determinant3()));
  for (TubePoint& t : tubes.points) t.radius *= float(scale);
  tubes.profile = type == "cylinder" ? CurveProfile::round_ribbon : CurveProfile::ribbon;
  v.reader().add_shape(v.plugin(), {.geometry = CurvesShape{
                                        std::make_shared<const CurveSet>(std::move(tubes)), ""}});
}

constexpr Record<ReadShape> kCurves[] = {
    {"curve", Versions::both, done, "of hair: tubes, which scatter light as its ribbons do", kCurve,
     read_curve},
};

}  // namespace

std::span<const Record<ReadShape>> curve_shapes() {
  return kCurves;
}

}  // namespace duet::pbrt
