#include <cmath>

#include "math/orthogonal.h"
#include "values/text.h"
#include "xml/value_elements.h"

namespace duet {

namespace {

/// Numbers are printed with few digits; the last row is exactly affine or not meant to be so.
constexpr double kFewDigits = 1e-6;

/// One step of a <transform>: its matrix, or nothing after an error.
class StepReader {
 public:
  StepReader(const ElementContext& context, pugi::xml_node element, TransformSpace space)
      : c_(context),
        tag_(element.name()),
        a_(c_.xml, element, c_.substitution, c_.report),
        space_(space) {}

  std::optional<Matrix4> read() {
    if (tag_ == "translate") return translate();
    if (tag_ == "scale") return scale();
    if (tag_ == "rotate") return rotate();
    if (tag_ == "lookat" || tag_ == "lookAt") return look_at();
    if (tag_ == "matrix") return matrix();
    c_.report.error(a_.where(), "<{}> cannot stand in a <transform>{}", tag_,
                    did_you_mean(tag_, {"translate", "scale", "rotate", "lookat", "matrix"}));
    return std::nullopt;
  }

 private:
  std::optional<double> number(std::string_view name, double preset) {
    if (!a_.has(name)) return preset;
    const auto value = parse_number(a_[name]);
    if (!value) c_.report.error(a_.where(name), "{} is not a finite number", in_quotes(a_[name]));
    return value;
  }

  /// From x= y= z= or from value= with one number (for all) or three.
  std::optional<Triple> components(double preset) {
    if (a_.has("value")) {
      if (a_.has("x") || a_.has("y") || a_.has("z")) {
        c_.report.error(a_.where("value"), "<{}> has both \"value\" and \"x\", \"y\", \"z\"", tag_);
        return std::nullopt;
      }
      return list("value", true);
    }
    const auto x = number("x", preset), y = number("y", preset), z = number("z", preset);
    if (!x || !y || !z) return std::nullopt;
    return Triple{*x, *y, *z};
  }

  std::optional<Triple> list(std::string_view name, bool one_for_all) {
    const auto n = parse_numbers(a_[name]);
    if (n && n->size() == 3) return Triple{(*n)[0], (*n)[1], (*n)[2]};
    if (n && n->size() == 1 && one_for_all) return Triple{(*n)[0], (*n)[0], (*n)[0]};
    c_.report.error(a_.where(name), "{} is not a list of three numbers", in_quotes(a_[name]));
    return std::nullopt;
  }

  std::optional<Matrix4> translate() {
    if (!a_.check({"x", "y", "z", "value"})) return std::nullopt;
    const auto v = components(0);
    if (!v) return std::nullopt;
    return Matrix4::translate((*v)[0], (*v)[1], (*v)[2]);
  }

  std::optional<Matrix4> scale() {
    if (!a_.check({"x", "y", "z", "value"})) return std::nullopt;
    const auto v = components(1);
    if (!v) return std::nullopt;
    if ((*v)[0] == 0 || (*v)[1] == 0 || ((*v)[2] == 0 && space_ == TransformSpace::world)) {
      c_.report.error(a_.where_all(), "a scale of zero cannot be inverted");
      return std::nullopt;
    }
    return Matrix4::scale((*v)[0], (*v)[1], (*v)[2]);
  }

  std::optional<Matrix4> rotate() {
    if (!a_.check({"!angle", "x", "y", "z", "value"})) return std::nullopt;
    const auto axis = components(0);
    const auto angle = number("angle", 0);
    if (!axis || !angle) return std::nullopt;
    const auto [x, y, z] = *axis;
    const double length = std::sqrt(x * x + y * y + z * z);
    if (!(length > 0)) {
      c_.report.error(a_.where_all(), "the axis of a rotation cannot be zero");
      return std::nullopt;
    }
    if (c_.version.is_0x() || std::abs(length - 1) < 1e-5) return Matrix4::rotate(*angle, x, y, z);
    // Mitsuba 2 and 3 put the axis into Rodrigues' formula as it is.
    c_.report.warning(a_.where(),
                      "Mitsuba 3 does not normalise the axis of a rotation: one of length {} also "
                      "stretches",
                      length);
    return Matrix4::rotate_by_formula(*angle, x, y, z);
  }

  std::optional<Matrix4> look_at() {
    if (!a_.check({"!origin", "!target", "up"})) return std::nullopt;
    const auto origin = list("origin", false), target = list("target", false);
    auto up = trim(a_["up"]).empty() ? std::optional<Triple>(Triple{}) : list("up", false);
    if (!origin || !target || !up) return std::nullopt;
    if (*up == Triple{}) {
      Triple d{};
      double length = 0;
      for (int i = 0; i < 3; ++i) d[i] = (*target)[i] - (*origin)[i], length += d[i] * d[i];
      for (double& v : d) v /= std::sqrt(length);
      if (length > 0) up = orthogonal_vector(d, c_.version);
    }
    auto m = Matrix4::look_at(*origin, *target, *up);
    if (!m)
      c_.report.error(
          a_.where_all(), "<{}> has no direction: {}", tag_,
          *origin == *target ? "origin and target are the same" : "\"up\" is parallel to the view");
    return m;
  }

  std::optional<Matrix4> matrix() {
    if (!a_.check({"!value"})) return std::nullopt;
    const auto n = parse_numbers(a_["value"]);
    if (!n || (n->size() != 9 && n->size() != 16)) {
      c_.report.error(a_.where("value"), "{}",
                      n ? fmt::format("a matrix has 9 or 16 numbers, not {}", n->size())
                        : in_quotes(a_["value"]) + " is not a list of finite numbers");
      return std::nullopt;
    }
    const size_t size = n->size() == 9 ? 3 : 4;
    Matrix4 m;
    for (size_t i = 0; i < n->size(); ++i) m[int(i / size)][i % size] = (*n)[i];
    if (!c_.version.is_0x() && !m.is_affine(kFewDigits)) {
      c_.report.warning(a_.where("value"),
                        "the last row {} {} {} {} of the matrix has no effect in Mitsuba 3: it is "
                        "taken to be 0 0 0 1",
                        m[3][0], m[3][1], m[3][2], m[3][3]);
      m[3] = {0, 0, 0, 1};
    }
    return m;
  }

  const ElementContext& c_;
  std::string tag_;
  Attributes a_;
  TransformSpace space_;
};

}  // namespace

PropertyValue read_transform(const ElementContext& c, pugi::xml_node element,
                             TransformSpace space) {
  Matrix4 product;
  bool good = true;
  for (pugi::xml_node child : element.children()) {
    if (child.type() != pugi::node_element) continue;
    if (const auto step = StepReader(c, child, space).read())
      product = *step * product;
    else
      good = false;
  }
  if (!good) return Broken{};
  const SourceLocation where = c.xml.where(element);
  if (!product.is_affine(kFewDigits)) {
    const auto& last = product[3];
    c.report.error(where, "the transform is not affine: its last row is {} {} {} {}, not 0 0 0 1",
                   last[0], last[1], last[2], last[3]);
    return Broken{};
  }
  product[3] = {0, 0, 0, 1};
  if (space == TransformSpace::uv && product.is_finite()) {
    product[2] = {0, 0, 1, 0};
    return product;
  }
  const auto inverse = product.is_finite() ? product.inverse() : std::nullopt;
  if (!inverse) {
    c.report.error(where, "the transform cannot be inverted");
    return Broken{};
  }
  // Single precision must hold it as well.
  if (product.fits_floats() && inverse->fits_floats()) return product;
  c.report.error(where, "the transform or its inverse has numbers that are too large");
  return Broken{};
}

Triple orthogonal_vector(const Triple& d, FileVersion version) {
  return version.is_0x() ? axis_orthogonal(d) : duff_orthogonal(d);
}

}  // namespace duet
