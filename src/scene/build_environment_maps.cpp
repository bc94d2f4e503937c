// Builds environment maps: images around the scene, in each of their layouts.
#include "lights/environment.h"
#include "math/equal_area.h"
#include "scene/builder.h"

namespace duet {

std::vector<std::string> EnvironmentMapLight::losses() const {
  std::vector<std::string> lost;
  if (gamma) lost.emplace_back("the gamma value of an environment map is missing");
  if (tint != Spectrum(1.0f)) lost.emplace_back("the tint of an environment map is missing");
  if (illuminance) lost.emplace_back("the illuminance of an environment map is missing");
  if (colors) lost.emplace_back("the colour space of an environment map is missing");
  if (layout == EnvironmentLayout::row_centers)
    lost.emplace_back("the rows of an environment map begin and end at the poles");
  if (layout == EnvironmentLayout::equal_area)
    lost.emplace_back(
        "an environment map of equal areas is taken for one by latitude and longitude");
  return lost;
}

namespace {

LightPointer equal_area_map(SceneBuilder& b, const EnvironmentMapLight& l,
                            const LightDescription& d, const BitmapPixels& image) {
  const int n = image.width();
  if (image.height() != n) {
    b.diagnostics().error(d.where, "an equal-area map must be a square, not {}x{}", n,
                          image.height());
    return nullptr;
  }
  // Light from above, on a plane; all texels are of the same solid angle. pbrt takes the sphere for
  // a hemisphere here, so that its lights are twice as bright as "illuminance" says, and so are
  // these.
  double illuminance = 0;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const Vector3f w =
          square_to_sphere_equal_area({(float(x) + 0.5f) / float(n), (float(y) + 0.5f) / float(n)});
      if (w.z > 0) illuminance += double(w.z) * double(image.color(x, y).luminance());
    }
  illuminance *= 2 * double(kPi) / (double(n) * n);
  Spectrum scale = l.tint * float(l.scale);
  if (l.illuminance && illuminance > 0) scale *= float(*l.illuminance / illuminance);

  // By latitude and longitude, finely enough that the texels keep their edges.
  constexpr int kLargest = 8192;
  const int width = std::clamp(n <= kLargest / 4 ? 4 * n : kLargest, 16, kLargest),
            height = width / 2 + 1;
  constexpr int kSamples = 4;
  std::vector<Spectrum> texels(size_t(width) * size_t(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      Spectrum sum;
      float weight = 0;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const float dx = (float(i % kSamples) + 0.5f) / kSamples,
                    dy = (float(i / kSamples) + 0.5f) / kSamples - 0.5f;
        const float theta = std::clamp((float(y) + dy) / float(height - 1), 0.0f, 1.0f) * kPi;
        const float phi = (float(x) + dx) / float(width) * 2 * kPi;
        const float share = std::sin(theta) + 1e-6f;
        const Point2f uv = sphere_to_square_equal_area(
            {std::cos(phi) * std::sin(theta), std::sin(phi) * std::sin(theta), std::cos(theta)});
        const auto texel = [&](float t) { return std::clamp(int(t * float(n)), 0, n - 1); };
        sum += image.color(texel(uv.x), texel(uv.y)) * share;
        weight += share;
      }
      texels[size_t(y) * size_t(width) + size_t(x)] = sum / weight * scale;
    }
  return std::make_unique<EnvironmentMap>(width, height, std::move(texels), d.to_world);
}

/// The pixels of a side of the image that those of the enlarged one show.
std::vector<int> nearest_pixels(int size, int enlarged) {
  std::vector<int> pixels;
  for (int64_t i = 0; i < enlarged; ++i)
    pixels.push_back(int((2 * i + 1) * size / (2 * int64_t(enlarged))));
  return pixels;
}

}  // namespace

void EnvironmentMapLight::count(SceneFeatures& f) const {
  f.environment_map = true;
}

LightPointer EnvironmentMapLight::build(SceneBuilder& b, const LightDescription& d) const {
  const BitmapDecoding decoding{.gamma = gamma, .colors = colors};
  const auto image = b.pixels(file, decoding, d.where);
  if (!image) return nullptr;
  if (layout == EnvironmentLayout::equal_area) return equal_area_map(b, *this, d, *image);
  const bool centers = layout == EnvironmentLayout::row_centers;
  // Mitsuba enlarges smaller images to this size, by the nearest pixel.
  const int least_width = centers ? 1 : 2, least_height = centers ? 1 : 3;
  const int width = std::max(image->width(), least_width);
  const int height = std::max(image->height(), least_height);
  if (width >= BilinearDistribution::kMaxWidth) {
    b.diagnostics().error(d.where,
                          "an environment map of {}x{} pixels; it needs fewer than {} columns",
                          image->width(), image->height(), BilinearDistribution::kMaxWidth);
    return nullptr;
  }
  const std::vector<int> columns = nearest_pixels(image->width(), width),
                         lines = nearest_pixels(image->height(), height);
  const auto color = [&](int x, int y) {
    return image->color(columns[size_t(x)], lines[size_t(std::clamp(y, 0, height - 1))]) *
           (tint * float(scale));
  };
  // Between the centres of rows there are their means, so that what is linear between rows at the
  // poles and halfway is linear between the centres.
  const int rows = centers ? 2 * height + 1 : height;
  std::vector<Spectrum> texels(size_t(width) * size_t(rows));
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < width; ++x) {
      Spectrum& texel = texels[size_t(y) * size_t(width) + size_t(x)];
      if (!centers)
        texel = color(x, y);
      else
        texel = (color(x, (y + 1) / 2 - 1) + color(x, y / 2)) * 0.5f;
    }
  // Room for the light's own copy.
  b.drop_pixels(file, decoding);
  return std::make_unique<EnvironmentMap>(width, rows, std::move(texels), d.to_world);
}

}  // namespace duet
