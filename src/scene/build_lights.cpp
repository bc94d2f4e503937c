// Builds lights from their descriptions and prepares the choice among them.
#include "lights/area.h"
#include "lights/beam.h"
#include "lights/delta.h"
#include "lights/sky.h"
#include "math/angles.h"
#include "math/equal_area.h"
#include "scene/builder.h"

namespace duet {

void SceneBuilder::add_light(std::unique_ptr<Light> light, double sampling_weight) {
  scene_->lights.push_back(std::move(light));
  sampling_weights_.push_back(sampling_weight);
}

void SceneBuilder::lights() {
  Scene& scene = *scene_;
  for (const Emission& e : emissions_) {
    Shape& shape = scene.shapes[e.shape];
    if (!(surface_area(shape) > 0)) {
      diagnostics_.error(e.where, "this light's shape has no area");
      continue;
    }
    if (e.directional && !ShapePoints::is_even(shape)) {
      diagnostics_.error(e.where, "this light's shape must not be stretched");
      continue;
    }
    // No ray finds light along the normals only: for those that meet the shape it is dark.
    if (!e.directional) shape.light = uint32_t(scene.lights.size());
    add_light(make(e, shape), e.sampling_weight);
  }
  for (const LightDescription& d : description_.lights) {
    if (!check_transform(d.to_world, d.where)) continue;
    shape_textures_.clear();
    auto light = std::visit([&](const auto& l) { return make(l, d); }, d.model);
    if (!shape_textures_.empty())
      diagnostics_.error(d.where, "this light has no shape, which a texture of it reads");
    if (!light) continue;
    if (light->kind() == LightKind::environment) {
      scene.environment = static_cast<const EnvironmentLight*>(light.get());
      scene.environment_index = uint32_t(scene.lights.size());
    }
    add_light(std::move(light), d.sampling_weight);
  }
}

std::unique_ptr<Light> SceneBuilder::make(const Emission& e, const Shape& shape) {
  if (e.directional) return std::make_unique<DirectionalArea>(shape, e.radiance);
  return std::make_unique<AreaLight>(shape, e.radiance, e.two_sided);
}

std::unique_ptr<Light> SceneBuilder::make(const PointLight& l, const LightDescription& d) {
  return std::make_unique<PointEmitter>(Transform(d.to_world)(Point3f(0, 0, 0)), l.intensity);
}

std::unique_ptr<Light> SceneBuilder::make(const SpotLight& l, const LightDescription& d) {
  const Texture* image = l.texture ? texture(*l.texture) : nullptr;
  return std::make_unique<SpotEmitter>(Transform(d.to_world), l.intensity,
                                       l.cutoff_angle * kRadians, l.beam_width * kRadians, image,
                                       l.falloff == SpotFalloff::smooth);
}

std::unique_ptr<Light> SceneBuilder::make(const ProjectorLight& l, const LightDescription& d) {
  const ColorSlot irradiance = slot(l.irradiance);
  const Point2i size = irradiance.texture ? irradiance.texture->resolution() : Point2i{1, 1};
  const double aspect = double(size.x) / size.y;
  return std::make_unique<ProjectorEmitter>(Transform(d.to_world), irradiance, float(l.scale),
                                            horizontal_fov(l.fov, l.fov_axis, aspect), aspect,
                                            l.is_intensity);
}

std::unique_ptr<Light> SceneBuilder::make(const GoniometricLight& l, const LightDescription& d) {
  const auto image = pixels(l.file, {}, d.where);
  if (!image) return nullptr;
  const int n = image->width();
  if (image->height() != n) {
    diagnostics_.error(d.where, "an equal-area map must be a square, not {}x{}", n,
                       image->height());
    return nullptr;
  }
  std::vector<Spectrum> texels;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) texels.push_back(image->color(x, y) * l.scale);
  return std::make_unique<GoniometricEmitter>(Transform(d.to_world), n, std::move(texels));
}

std::unique_ptr<Light> SceneBuilder::make(const DirectionalLight& l, const LightDescription& d) {
  return std::make_unique<DirectionalEmitter>(Transform(d.to_world), l.irradiance);
}

std::unique_ptr<Light> SceneBuilder::make(const ConstantLight& l, const LightDescription&) {
  return std::make_unique<ConstantEnvironment>(l.radiance);
}

std::unique_ptr<Light> SceneBuilder::make(const SkyLight& l, const LightDescription& d) {
  SkyOptions o;
  o.turbidity = l.turbidity;
  o.albedo = l.albedo;
  o.sun = {float(l.sun[0]), float(l.sun[1]), float(l.sun[2])};
  o.sky_scale = l.sky_scale;
  o.sun_scale = l.sun_scale;
  o.sun_aperture = l.sun_aperture;
  if (l.disk) {
    const auto& to = l.disk->direction;
    o.disk = {{float(to[0]), float(to[1]), float(to[2])}, l.disk->irradiance};
  }
  o.stretch = l.stretch;
  o.extend = l.extend;
  return std::make_unique<Sky>(o, d.to_world);
}

std::unique_ptr<Light> SceneBuilder::make(const CollimatedLight& l, const LightDescription& d) {
  return std::make_unique<CollimatedBeam>(Transform(d.to_world), l.power);
}

std::unique_ptr<Light> SceneBuilder::equal_area_map(const EnvironmentMapLight& l,
                                                    const LightDescription& d,
                                                    const BitmapPixels& image) {
  const int n = image.width();
  if (image.height() != n) {
    diagnostics_.error(d.where, "an equal-area map must be a square, not {}x{}", n, image.height());
    return nullptr;
  }
  // Light from above, on a plane; all texels are of the same solid angle.
  double illuminance = 0;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const Vector3f w =
          square_to_sphere_equal_area({(float(x) + 0.5f) / float(n), (float(y) + 0.5f) / float(n)});
      if (w.z > 0) illuminance += double(w.z) * double(image.color(x, y).luminance());
    }
  illuminance *= 4 * double(kPi) / (double(n) * n);
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

std::unique_ptr<Light> SceneBuilder::make(const EnvironmentMapLight& l, const LightDescription& d) {
  const auto image = pixels(l.file, {.gamma = l.gamma}, d.where);
  if (!image) return nullptr;
  if (l.layout == EnvironmentLayout::equal_area) return equal_area_map(l, d, *image);
  const int width = image->width(), height = image->height();
  if (height < 2 || width >= BilinearDistribution::kMaxWidth) {
    diagnostics_.error(d.where,
                       "an environment map of {}x{} pixels; it needs two rows and fewer than {} "
                       "columns",
                       width, height, BilinearDistribution::kMaxWidth);
    return nullptr;
  }
  std::vector<Spectrum> texels(size_t(width) * size_t(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      texels[size_t(y) * size_t(width) + size_t(x)] =
          image->color(x, y) * (l.tint * float(l.scale));
  // Nobody else reads it as a texture in this form: room for the light's own copy.
  pixels_.clear();
  return std::make_unique<EnvironmentMap>(width, height, std::move(texels), d.to_world);
}

}  // namespace duet
