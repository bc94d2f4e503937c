#include "pbrt/light_values.h"

#include <algorithm>
#include <cmath>

#include "math/angles.h"

namespace duet::pbrt {

Spectrum scale_of(Values& v) {
  v.drop_others_in_v3("scale", kColor);
  const Parameter* p = v.given("scale");
  if (!p || p->type == Type::number) return Spectrum(float(v.number("scale")));
  if (v.reader().version() == Version::v3)
    return v.reader().constant_color(*p, ColorMeaning::emission);
  v.reader().report().error(p->where, "parameter \"scale\" must be of type float, not {}",
                            type_name(p->type));
  return Spectrum(1.0f);
}

std::optional<double> positive_of(Values& v, std::string_view name) {
  if (!v.has(name) || !(v.number(name) > 0)) return std::nullopt;
  return v.number(name);
}

void scale_to_power(Values& v, Spectrum& scale, const BitmapTexture& image,
                    const std::function<double(const TextureTexels&)>& power) {
  const auto wanted = positive_of(v, "power");
  if (!wanted) return;
  const auto texels =
      v.reader().report().from_file(v.where("filename"), [&] { return read_texels(image); });
  const double own = texels ? power(*texels) : 0;
  if (own > 0) scale *= float(*wanted / own);
}

double mean_number(const TextureTexels& image) {
  const Spectrum c = image.mean();
  return (double(c.r) + double(c.g) + double(c.b)) / 3;
}

double projected_power(const TextureTexels& image, double fov) {
  const int width = image.width, height = image.height;
  const double shorter = std::min(width, height), half = std::tan(0.5 * fov * kRadians);
  double sum = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double sx = (2 * (x + 0.5) - width) / shorter * half,
                   sy = (2 * (y + 0.5) - height) / shorter * half;
      // The solid angle of a piece of the plane at distance one is cos³ of its area.
      sum += double(image.colors[size_t(y) * size_t(width) + size_t(x)].luminance()) *
             std::pow(1 + sx * sx + sy * sy, -1.5);
    }
  const double pixel = 2 * half / shorter;
  return sum * pixel * pixel;
}

}  // namespace duet::pbrt
