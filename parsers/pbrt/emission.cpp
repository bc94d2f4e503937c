#include "pbrt/emission.h"

namespace duet::pbrt {

Spectrum emitted_color(Values& v, std::string_view name) {
  const Parameter* p = v.given(name);
  if (!p) {
    Parameter one;
    one.type = Type::rgb;
    one.numbers = {1, 1, 1};
    one.color_space = v.reader().state().color_space;
    return color_from_triple(one, ColorMeaning::emission, v.reader().film_color_space);
  }
  const Spectrum color = v.reader().constant_color(*p, ColorMeaning::emission);
  if (v.reader().version() == Version::v3 || p->type == Type::rgb || p->type == Type::xyz)
    return color;
  const Matrix3 to_srgb = to_linear_srgb(v.reader().film_color_space);
  const auto& rows = to_srgb;
  const auto channel = [&](size_t i) {
    return float(rows[i][0] * double(color.r) + rows[i][1] * double(color.g) +
                 rows[i][2] * double(color.b));
  };
  const float luminance = Spectrum(channel(0), channel(1), channel(2)).luminance();
  if (luminance > 0) return color / luminance;
  v.reader().report().error(p->where, "a light's spectrum must have a luminance above zero");
  return color;
}

}  // namespace duet::pbrt
