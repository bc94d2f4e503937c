// Environments of any kind as images.
#include <cmath>
#include <stdexcept>

#include "evaluate/convert/new_files.h"
#include "image/image_io.h"
#include "lights/light.h"
#include "math/angles.h"
#include "math/equal_area.h"
#include "scene/build.h"

namespace duet {

namespace {

/// The direction of a point of the image, whose size is that of the unit square.
Vector3f direction(EnvironmentForm form, double x, double y) {
  if (form == EnvironmentForm::equal_area) {
    const Vector3f w = square_to_sphere_equal_area({float(x), float(y)});
    // pbrt's +z is up.
    return {w.y, w.z, -w.x};
  }
  const double theta = kPi * y, phi = 2 * kPi * x;
  return {float(std::sin(theta) * std::sin(phi)), float(std::cos(theta)),
          float(-std::sin(theta) * std::cos(phi))};
}

}  // namespace

int environment_width(const LightDescription& light) {
  const auto* map = std::get_if<EnvironmentMapLight>(&light.model);
  return map ? read_image(map->file).image.width : 0;
}

Image environment_image(const SceneDescription& scene, const LightDescription& light,
                        EnvironmentForm form, int width) {
  SceneDescription alone;
  alone.file = scene.file;
  alone.textures = scene.textures;
  alone.sensors.emplace_back();
  alone.lights.push_back(light);
  alone.lights[0].to_world = {};
  alone.lights[0].motion = {};
  alone.lights[0].medium.reset();
  alone.lights[0].portal.reset();
  Diagnostics diagnostics;
  const auto built = build_scene(std::move(alone), {}, diagnostics);
  if (!built || !built->environment)
    throw std::runtime_error(diagnostics.all().empty() ? "the environment cannot be built"
                                                       : diagnostics.all().front().to_string());
  // Rows by latitude lie on the poles, too.
  const bool square = form == EnvironmentForm::equal_area;
  const int height = square ? width : width / 2 + 1;
  const double rows = square ? height : height - 1, shift = square ? 0 : -0.5;
  // In the form that it has already, pixels stay what they are.
  const auto* map = std::get_if<EnvironmentMapLight>(&light.model);
  const bool same = map && map->layout == (square ? EnvironmentLayout::equal_area
                                                  : EnvironmentLayout::latitude_longitude);
  const int steps = same ? 1 : 4;
  Image image(width, height, {"R", "G", "B"});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      Spectrum sum(0.0f);
      int count = 0;
      for (int j = 0; j < steps; ++j)
        for (int i = 0; i < steps; ++i) {
          const double v = (y + shift + (j + 0.5) / steps) / rows;
          if (v < 0 || v > 1) continue;
          sum += built->environment->emitted(Point3f(0),
                                             direction(form, (x + (i + 0.5) / steps) / width, v));
          ++count;
        }
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = sum[c] / float(count);
    }
  return image;
}

}  // namespace duet
