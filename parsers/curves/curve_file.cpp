#include "curves/curve_file.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

namespace duet {

namespace {

static_assert(std::endian::native == std::endian::little, "the file's byte order is assumed");

void skip_space(std::string_view& text) {
  const size_t n = text.find_first_not_of(" \t\r");
  text.remove_prefix(std::min(n, text.size()));
}

/// The next number of a line.
float next_number(ByteReader& in, std::string_view& text, const char* what) {
  skip_space(text);
  if (text.empty()) in.fail("the line ends before {}", what);
  const char* first = text.data() + (text[0] == '+' ? 1 : 0);
  float value = 0;
  const auto [end, error] = std::from_chars(first, text.data() + text.size(), value);
  if (error == std::errc::invalid_argument)
    in.fail("\"{}\" is not a number ({})", text.substr(0, std::min<size_t>(text.find(' '), 32)),
            what);
  // Too small to be told from zero is zero, too large is an error.
  if (error == std::errc::result_out_of_range) {
    const std::string_view digits(first, size_t(end - first));
    const bool tiny = digits.find("e-") != digits.npos || digits.find("E-") != digits.npos ||
                      digits.find_first_of("123456789") > digits.find('.');
    value = tiny ? 0 : INFINITY;
  }
  if (!std::isfinite(value)) in.fail("{} is not finite", what);
  text.remove_prefix(size_t(end - text.data()));
  return value;
}

Point3f next_position(ByteReader& in, std::string_view& text) {
  Point3f p;
  p.x = next_number(in, text, "x");
  p.y = next_number(in, text, "y");
  p.z = next_number(in, text, "z");
  return p;
}

class Builder {
 public:
  Builder(ByteReader& in, CurveSet& curves) : in_(in), curves_(curves) {}
  void add(const TubePoint& p) {
    if (curves_.points.size() == std::numeric_limits<uint32_t>::max())
      in_.fail("has too many points");
    curves_.points.push_back(p);
  }
  /// The points since the last call are a curve.
  void end_curve(bool may_be_short) {
    const size_t count = curves_.points.size() - first_, need = points_per_segment(curves_.kind);
    if (count == 0) return;
    if (count < need) {
      if (!may_be_short)
        in_.fail("a curve ends here that has {} point{}: it needs at least {}", count,
                 count == 1 ? "" : "s", need);
      curves_.points.resize(first_);
      return;
    }
    for (size_t i = first_; i + need <= curves_.points.size(); ++i)
      curves_.segments.push_back(uint32_t(i));
    first_ = curves_.points.size();
  }

 private:
  ByteReader& in_;
  CurveSet& curves_;
  size_t first_ = 0;
};

/// Calls `add_point` with each line that is not empty and ends curves at the others.
template <class AddPoint>
void read_lines(ByteReader& in, Builder& builder, bool may_be_short, const AddPoint& add_point) {
  std::string_view line;
  while (in.next_line(line)) {
    skip_space(line);
    if (line.empty())
      builder.end_curve(may_be_short);
    else
      add_point(line);
  }
  builder.end_curve(may_be_short);
}

constexpr std::string_view kBinary = "BINARY_HAIR";

void read_binary_hair(ByteReader& in, Builder& builder, float radius) {
  in.end_text();
  in.skip(kBinary.size());
  uint32_t count;
  std::memcpy(&count, in.take(4, "the number of points"), 4);
  for (uint32_t i = 0; i < count; ++i) {
    float p[3];
    std::memcpy(&p[0], in.take(4, "its points"), 4);
    // Infinity says that a new hair begins.
    if (std::isinf(p[0]) && p[0] > 0) {
      builder.end_curve(true);
      std::memcpy(&p[0], in.take(4, "its points"), 4);
    }
    std::memcpy(&p[1], in.take(8, "its points"), 8);
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      in.fail("point {} is not finite", i);
    builder.add({{p[0], p[1], p[2]}, radius});
  }
  builder.end_curve(true);
}

}  // namespace

CurveSet parse_curves(ByteReader& in, CurveKind kind) {
  CurveSet curves;
  curves.kind = kind;
  Builder builder(in, curves);
  read_lines(in, builder, false, [&](std::string_view line) {
    TubePoint p;
    p.position = next_position(in, line);
    p.radius = next_number(in, line, "the radius");
    if (p.radius < 0) in.fail("the radius {:g} is negative", p.radius);
    builder.add(p);
  });
  in.end_text();
  if (curves.segments.empty()) in.fail("has no points");
  return curves;
}

CurveSet parse_hair(ByteReader& in, float radius) {
  CurveSet curves;
  curves.outside_only = false;
  Builder builder(in, curves);
  const std::span<const uint8_t> start = in.peek(kBinary.size());
  if (start.size() == kBinary.size() &&
      std::memcmp(start.data(), kBinary.data(), kBinary.size()) == 0)
    read_binary_hair(in, builder, radius);
  else
    read_lines(in, builder, true, [&](std::string_view line) {
      builder.add({next_position(in, line), radius});
    });
  in.end_text();
  if (curves.segments.empty()) in.fail("has no hair of two points or more");
  return curves;
}

CurveSet read_curves(const std::string& file, CurveKind kind) {
  return parse_file(file, [&](ByteReader& in) { return parse_curves(in, kind); });
}

CurveSet read_hair(const std::string& file, float radius) {
  return parse_file(file, [&](ByteReader& in) { return parse_hair(in, radius); });
}

}  // namespace duet
