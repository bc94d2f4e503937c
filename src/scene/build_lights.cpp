// Builds lights from their descriptions and prepares the choice among them.
#include <cassert>

#include "lights/area.h"
#include "lights/beam.h"
#include "lights/delta.h"
#include "lights/portal.h"
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
  // Lights look up what their textures read.
  if (lacks_texture_data_) emissions_.clear();
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
  std::vector<std::unique_ptr<EnvironmentLight>> environments;
  double environment_weight = 0;
  bool has_portal = false;
  for (const LightDescription& d : description_.lights) {
    described_lights_.push_back({nullptr, uint32_t(scene.lights.size())});
    if (!check_transform(d.to_world, d.where)) continue;
    shape_textures_.clear();
    auto light = make(d);
    if (!shape_textures_.empty())
      diagnostics_.error(d.where, "this light has no shape, which a texture of it reads");
    if (!light) continue;
    described_lights_.back().light = light.get();
    if (light->kind() != LightKind::environment) {
      add_light(std::move(light), d.sampling_weight);
      continue;
    }
    environments.emplace_back(static_cast<EnvironmentLight*>(light.release()));
    environment_weight = std::max(environment_weight, d.sampling_weight);
    has_portal |= d.portal.has_value();
    if (environments.size() > 1) {
      if (has_portal)
        diagnostics_.error(d.where, "an environment behind a portal must be the only one");
      continue;
    }
    scene.environment_index = uint32_t(scene.lights.size());
    add_light(nullptr, d.sampling_weight);
  }
  if (environments.empty()) return;
  std::unique_ptr<EnvironmentLight> all =
      environments.size() == 1 ? std::move(environments.front())
                               : std::make_unique<EnvironmentSum>(std::move(environments));
  scene.environment = all.get();
  scene.lights[scene.environment_index] = std::move(all);
  sampling_weights_[scene.environment_index] = environment_weight;
}

std::unique_ptr<Light> SceneBuilder::make(const LightDescription& d) {
  auto light = std::visit([&](const auto& l) { return l.build(*this, d); }, d.model);
  if (!light || !d.portal) return light;
  assert(light->kind() == LightKind::environment);
  std::array<Point3f, 4> corners;
  for (size_t i = 0; i < corners.size(); ++i) {
    const auto& p = d.portal->corners[i];
    corners[i] = {float(p[0]), float(p[1]), float(p[2])};
  }
  // There is nothing to choose among directions of equal radiance.
  const float share = std::holds_alternative<ConstantLight>(d.model) ? 0 : 0.5f;
  return std::make_unique<PortalEnvironment>(
      std::unique_ptr<EnvironmentLight>(static_cast<EnvironmentLight*>(light.release())), corners,
      share);
}

std::unique_ptr<Light> SceneBuilder::make(const Emission& e, const Shape& shape) {
  if (e.directional) return std::make_unique<DirectionalArea>(shape, e.radiance);
  return std::make_unique<AreaLight>(shape, e.radiance, e.side,
                                     light_selection(description_.integrator));
}

void PointLight::count(SceneFeatures& f) const {
  ++f.point_lights;
}

LightPointer PointLight::build(SceneBuilder&, const LightDescription& d) const {
  return std::make_unique<PointEmitter>(Transform(d.to_world)(Point3f(0, 0, 0)), intensity);
}

std::vector<std::string> SpotLight::losses() const {
  if (falloff == SpotFalloff::linear) return {};
  return {"the edge of a spot light is linear in the angle"};
}

void SpotLight::count(SceneFeatures& f) const {
  ++f.spot_lights;
}

LightPointer SpotLight::build(SceneBuilder& b, const LightDescription& d) const {
  const Texture* image = texture ? b.texture(*texture) : nullptr;
  return std::make_unique<SpotEmitter>(Transform(d.to_world), intensity, cutoff_angle * kRadians,
                                       beam_width * kRadians, image, falloff);
}

void ProjectorLight::count(SceneFeatures& f) const {
  ++f.projectors;
}

LightPointer ProjectorLight::build(SceneBuilder& b, const LightDescription& d) const {
  const ColorSlot slot = b.slot(irradiance);
  const Point2i size = slot.texture ? slot.texture->resolution() : Point2i{1, 1};
  const double aspect = double(size.x) / size.y;
  return std::make_unique<ProjectorEmitter>(Transform(d.to_world), slot, float(scale),
                                            horizontal_fov(fov, fov_axis, aspect), aspect,
                                            is_intensity);
}

std::vector<std::string> ProjectorLight::losses() const {
  if (!is_intensity) return {};
  return {"the projector's image is irradiance, not intensity"};
}

void DirectionalLight::count(SceneFeatures& f) const {
  ++f.directional_lights;
}

LightPointer DirectionalLight::build(SceneBuilder&, const LightDescription& d) const {
  return std::make_unique<DirectionalEmitter>(Transform(d.to_world), irradiance);
}

void ConstantLight::count(SceneFeatures& f) const {
  f.constant_environment = true;
}

LightPointer ConstantLight::build(SceneBuilder&, const LightDescription&) const {
  return std::make_unique<ConstantEnvironment>(radiance);
}

std::vector<std::string> SkyLight::losses() const {
  std::vector<std::string> lost;
  if (stretch != 1 || extend) lost.emplace_back("the sky ends at the horizon");
  if (disk && sun_scale != 0)
    lost.emplace_back(
        "the sun has the brightness of Hosek and Wilkie's model, and sets with the horizon");
  return lost;
}

void SkyLight::count(SceneFeatures& f) const {
  f.sky = true;
}

LightPointer SkyLight::build(SceneBuilder&, const LightDescription& d) const {
  SkyOptions o;
  o.turbidity = turbidity;
  o.albedo = albedo;
  o.sun = {float(sun[0]), float(sun[1]), float(sun[2])};
  o.sky_scale = sky_scale;
  o.sun_scale = sun_scale;
  o.sun_aperture = sun_aperture;
  if (disk) {
    const auto& to = disk->direction;
    o.disk = {{float(to[0]), float(to[1]), float(to[2])}, disk->irradiance};
  }
  o.stretch = stretch;
  o.extend = extend;
  return std::make_unique<Sky>(o, d.to_world);
}

void CollimatedLight::count(SceneFeatures& f) const {
  ++f.beams;
}

LightPointer CollimatedLight::build(SceneBuilder&, const LightDescription& d) const {
  return std::make_unique<CollimatedBeam>(Transform(d.to_world), power);
}

void GoniometricLight::count(SceneFeatures& f) const {
  ++f.point_lights;
}

namespace {

/// Colours of a square of equal areas, each that of an image by latitude and longitude in its
/// direction, bilinearly between centres of texels; the image goes on beyond all its edges.
std::vector<Spectrum> equal_areas(const BitmapPixels& image, int n) {
  const int width = image.width(), height = image.height();
  const auto texel = [&](int x, int y) {
    return image.color((x % width + width) % width, (y % height + height) % height);
  };
  std::vector<Spectrum> texels;
  texels.reserve(size_t(n) * size_t(n));
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const Vector3f w =
          square_to_sphere_equal_area({(float(x) + 0.5f) / float(n), (float(y) + 0.5f) / float(n)});
      const float phi = std::atan2(w.y, w.x), turn = phi < 0 ? phi + 2 * kPi : phi;
      const float s = turn / (2 * kPi) * float(width) - 0.5f,
                  t = std::acos(std::clamp(w.z, -1.0f, 1.0f)) / kPi * float(height) - 0.5f;
      const int i = int(std::floor(s)), j = int(std::floor(t));
      const float ds = s - float(i), dt = t - float(j);
      texels.push_back(lerp(lerp(texel(i, j), texel(i + 1, j), ds),
                            lerp(texel(i, j + 1), texel(i + 1, j + 1), ds), dt));
    }
  return texels;
}

}  // namespace

LightPointer GoniometricLight::build(SceneBuilder& b, const LightDescription& d) const {
  // pbrt-v3 takes the numbers of all files as they are.
  BitmapDecoding decoding;
  if (latitude_longitude) decoding.gamma = 1;
  const auto image = b.pixels(file, decoding, d.where);
  if (!image) return nullptr;
  if (latitude_longitude) {
    // So finely that steps between texels are small beside those of images of up to 512 rows.
    const int fine = std::clamp(std::max(4 * image->height(), 2 * image->width()), 512, 2048);
    std::vector<Spectrum> texels = equal_areas(*image, fine);
    for (Spectrum& t : texels) t *= scale;
    return std::make_unique<GoniometricEmitter>(Transform(d.to_world), fine, std::move(texels));
  }
  const int n = image->width();
  if (image->height() != n) {
    b.diagnostics().error(d.where, "an equal-area map must be a square, not {}x{}", n,
                          image->height());
    return nullptr;
  }
  std::vector<Spectrum> texels;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const Spectrum c = image->color(x, y);
      texels.push_back(scale * c.mean());
    }
  return std::make_unique<GoniometricEmitter>(Transform(d.to_world), n, std::move(texels));
}

LightPointer ForeignLight::build(SceneBuilder& b, const LightDescription& d) const {
  return operations().build(data(), b, d);
}

}  // namespace duet
